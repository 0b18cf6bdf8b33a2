// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/orders/order_policy.hpp"

namespace adit {

std::string_view reason_to_refuse(const OrderPolicy& policy, const ProcmanOrders& orders) {
  if (policy.obeys_everybody) return {};
  const bool obeyed = !policy.obeyed_sheriff.empty() && orders.sheriff == policy.obeyed_sheriff;
  return obeyed ? "" : "orders of a foreign sheriff, and accept_orders is off";
}

std::string_view reason_to_refuse(const ListedCommand* command, const ProcmanOrder& order) {
  if (!command) return "order for a command that is not in the list of this computer";
  const std::string& exec = order.command.exec;
  if (!exec.empty() && exec != command->exec) return "order with another command line than listed";
  return {};
}

}  // namespace adit
