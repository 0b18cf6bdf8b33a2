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

/// Whose orders from the network are obeyed. The names are not proven by anything: whoever is on
/// the network can take any. What they can do is to start and stop what is in the list.
struct OrderPolicy {
  std::string accepted_sheriff;    ///< the supervisor in charge; empty: none
  bool accepts_everybody = false;  ///< accept_orders
};

/// Each returns why not, as a text of static storage; empty where there is nothing against it.
std::string_view rejection_reason(const OrderPolicy& policy, const ProcmanOrders& orders);

/// `command` is what the list has under the name of the order, null where it has nothing. A command
/// line that comes along must be that of the list, and is not used even then.
std::string_view rejection_reason(const ListedCommand* command, const ProcmanOrder& order);

/// How a process is, in procman's words.
ProcmanStatus procman_status(const ManagedProcess& process);

/// Hands on what processes print, to who shows it elsewhere: of each the newest 8 kB at a time, and
/// how many lines were left out, so that one that floods does not fill the network.
class OutputRelay {
 public:
  /// What is new since the last call, in messages of less than 60 kB. `utime` is wall_utime().
  std::vector<ProcmanOutput> take(const ProcessManager& process_manager, const std::string& deputy,
                                  std::int64_t utime);

 private:
  std::map<std::string, std::int64_t> sent_lines_;  // by process
};

}  // namespace adit
