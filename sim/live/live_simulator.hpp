// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/node/node_host.hpp"
#include "sim/live/live_run.hpp"
#include "sim/live/pacing.hpp"
#include "sim/live/process_faults.hpp"
#include "sim/sim_node.hpp"
#include "sim/simulation/simulation.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// Writes what comes on every channel there is into an LCM log, stamped with the time at which it
/// is handled. Nothing is lost of a bus whose driver waits for its handlers.
class BusRecorder {
 public:
  using Clock = std::function<std::int64_t()>;  ///< [µs since the epoch], never goes back

  /// Throws as LogWriter does; so does the bus, where a message cannot be written.
  BusRecorder(Bus& bus, const std::filesystem::path& path, Clock clock);
  BusRecorder(const BusRecorder&) = delete;
  BusRecorder& operator=(const BusRecorder&) = delete;

  /// Ends the log.
  void close() { log_.close(); }

 private:
  LogWriter log_;
  Clock clock_;
};

/// Tells on standard error how a run goes: a line every few seconds of wall time, and one when it
/// has failed.
class ProgressReporter {
 public:
  static constexpr std::int64_t kPeriodUs = 5'000'000;

  explicit ProgressReporter(std::string program) : program_(std::move(program)) {}

  /// Wall time is any that goes on steadily [µs].
  void update(const Simulation& simulation, std::int64_t start_utime, std::int64_t wall_us);

  /// One line, whenever.
  void print(const std::string& what) const;

 private:
  struct Sample {
    std::int64_t utime;
    std::int64_t wall_us;
  };

  std::string program_;
  std::optional<Sample> last_;
  bool failed_ = false;
};

/// `83.4 s simulated, 7.9 x real time, 31.2 m, driving`.
std::string progress_line(double elapsed_s, double factor, const RunState& run,
                          const VehicleState& vehicle);

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
  std::int64_t advance(std::int64_t wall_us);

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
  ProgressReporter progress_;
  std::int64_t start_utime_;
  std::optional<double> for_s_;
  std::int64_t next_reminder_us_ = 0;  // wall time
  std::optional<BusRecorder> recorder_;
};

}  // namespace adit
