// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "common/process_list/process_list.hpp"
#include "common/types/procman.hpp"
#include "procs/supervisor/process_manager.hpp"

namespace adit {

/// The sheriffs whose orders are accepted. Sheriff names are not authenticated: any host of the
/// network can use any name. Orders can only start and stop commands of the list.
struct OrderPolicy {
  std::string accepted_sheriff;  ///< deputy_id of the supervisor in charge; empty: none
  bool accepts_all = false;      ///< parameter accept_orders
};

/// Both return the reason of a rejection, with static storage duration, or an empty string.
std::string_view rejection_reason(const OrderPolicy& policy, const ProcmanOrders& orders);

/// `command` is the local command with the id of the order, or null. The command line of an order
/// must be empty or equal to that of the list, and is never executed.
std::string_view rejection_reason(const ListedCommand* command, const ProcmanOrder& order);

/// State of a process in procman's representation.
ProcmanStatus procman_status(const ManagedProcess& process);

/// Relays the output of processes to other computers: per call and process at most the newest 8 kB
/// and the number of omitted lines, to limit the network load.
class OutputRelay {
 public:
  /// Output since the last call, in messages of less than 60 kB. `utime` is wall_utime().
  std::vector<ProcmanOutput> take(const ProcessManager& process_manager, const std::string& deputy,
                                  std::int64_t utime);

 private:
  std::map<std::string, std::int64_t> sent_lines_;  // by process
};

}  // namespace adit
