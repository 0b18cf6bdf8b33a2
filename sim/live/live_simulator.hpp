// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/node_host.hpp"
#include "sim/live/bus_recorder.hpp"
#include "sim/live/live_run.hpp"
#include "sim/live/pacing.hpp"
#include "sim/live/process_faults.hpp"
#include "sim/live/progress_lines.hpp"
#include "sim/sim_node.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// The simulator on a bus with other processes: goes on at its pace, says of itself what every
/// stage does, lets happen to processes what was asked for, and tells on standard error how it
/// goes.
class LiveSimulator {
 public:
  /// `bus` and `site` must outlive this.
  LiveSimulator(Bus& bus, const Site& site, const WorldDescription& description,
                const SimulationParams& params, const LiveRunOptions& options,
                std::int64_t start_utime);
  LiveSimulator(const LiveSimulator&) = delete;
  LiveSimulator& operator=(const LiveSimulator&) = delete;

  /// Takes a step if it is time for one. Returns how long to listen to the bus before the next
  /// call [µs]; an answer of a stage may end that. Wall time is any that goes on steadily.
  std::int64_t go_on(std::int64_t wall_us);

  /// Whether the time that was asked for is up.
  [[nodiscard]] bool done() const;

  /// Ends the record, if there is one.
  void close_record();

 private:
  void step();
  void remind_stages(std::int64_t wall_us);

  NodeHost host_;
  SimNode node_;
  Pacing pacing_;
  ProcessFaults process_faults_;
  ProgressLines progress_;
  std::int64_t start_utime_;
  std::optional<double> for_s_;
  std::int64_t next_reminder_us_ = 0;  // wall time
  std::optional<BusRecorder> recorder_;
};

}  // namespace adit
