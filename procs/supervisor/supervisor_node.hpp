// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"
#include "procs/supervisor/supervisor.hpp"

namespace adit {

/// In:  PM_ORDERS (orders_t), as far as the configuration allows; PM_INFO (deputy_info_t) of
/// others;
///      PM_DISCOVER (discovery_t); PM_OUTPUT (output_t) of others; whatever channels the process
///      list says show life.
/// Out: PM_INFO (deputy_info_t) each second and on change; PM_OUTPUT (output_t); where it is in
///      charge, PM_ORDERS (orders_t) for others each second and on change.
/// All of it by the time of the world, also where bus time is a simulator's. When it goes, it stops
/// its processes and waits for that.
class SupervisorNode {
 public:
  using Params = SupervisorParams;

  /// Throws as Supervisor does.
  SupervisorNode(Bus& bus, const Params& params);

  /// Fault where a process was given up, degraded where one waits to be started again or a script
  /// has ended before its end.
  [[nodiscard]] Health health() const;

 private:
  void subscribe_to_procman();
  void subscribe_to_liveness();
  void advance();
  void publish_each_second();
  void publish_info();
  void publish_orders();
  void publish_output();

  Bus& bus_;
  Supervisor supervisor_;
  std::set<std::string> liveness_channels_;  // that are listened to
};

}  // namespace adit
