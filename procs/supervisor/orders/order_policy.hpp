// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "common/process_list/process_list.hpp"
#include "common/procman/procman_values.hpp"

namespace adit {

/// Whose orders from the network are obeyed. The names are not proven by anything: whoever is on
/// the network can take any. What they can do is to start and stop what is in the list.
struct OrderPolicy {
  std::string obeyed_sheriff;    ///< the supervisor in charge; empty: none
  bool obeys_everybody = false;  ///< accept_orders
};

/// Each returns why not, as a text of static storage; empty where there is nothing against it.
std::string_view reason_to_refuse(const OrderPolicy& policy, const ProcmanOrders& orders);

/// `command` is what the list has under the name of the order, null where it has nothing. A command
/// line that comes along must be that of the list, and is not used even then.
std::string_view reason_to_refuse(const ListedCommand* command, const ProcmanOrder& order);

}  // namespace adit
