// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"
#include "procs/supervisor/procman/name_claim.hpp"
#include "procs/supervisor/supervisor.hpp"

namespace adit {

/// In:  PM_ORDERS (orders_t), if the configuration allows; PM_INFO (deputy_info_t) and PM_OUTPUT
///      (output_t) of other deputies; PM_DISCOVER (discovery_t); the channels that its list
///      names.
/// Out: PM_INFO (deputy_info_t) at 1 Hz and on change; PM_OUTPUT (output_t); if in charge,
/// PM_ORDERS
///      (orders_t) for other deputies at 1 Hz and on change.
///      PM_DISCOVER (discovery_t) before it starts.
/// Before anything else it listens for another supervisor of its name (NameClaim); if there is one,
/// a handler of the bus throws std::runtime_error, which ends the program.
/// Uses wall clock time even if bus time is simulated. The destructor stops the processes and waits
/// until they have ended.
class SupervisorNode {
 public:
  using Params = SupervisorParams;

  /// Throws as the constructor of Supervisor.
  SupervisorNode(Bus& bus, const Params& params);

  /// Fault if a process has failed; degraded for other problems, such as a process that pauses
  /// before its restart or a failed script.
  [[nodiscard]] Health health() const;

 private:
  void subscribe_to_procman();
  void subscribe_to_liveness();
  void claim_name();
  void advance();
  void publish_each_second();
  void publish_info();
  void publish_orders();
  void publish_output();

  Bus& bus_;
  Supervisor supervisor_;
  NameClaim claim_;
  std::set<std::string> liveness_channels_;  // subscribed
};

}  // namespace adit
