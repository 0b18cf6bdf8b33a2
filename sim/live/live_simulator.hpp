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
#include "common/bus/log/recording.hpp"
#include "common/bus/node/node_host.hpp"
#include "sim/live/live_run.hpp"
#include "sim/live/pacing.hpp"
#include "sim/live/process_faults.hpp"
#include "sim/sim_node.hpp"
#include "sim/simulation/simulation.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// Records all channels in an LCM log, stamped with the time of handling, except the answers to the
/// simulator (SIM_TIME_DONE), which say nothing of the mission. No message is lost if the bus waits
/// for its handlers.
class BusRecorder {
 public:
  using Clock = std::function<std::int64_t()>;  ///< [µs since the epoch], monotonic

  /// A recording that stops (Recording) publishes HEARTBEAT with the reason each second.
  BusRecorder(Bus& bus, const std::filesystem::path& path, double free_min_mb, Clock clock);
  BusRecorder(const BusRecorder&) = delete;
  BusRecorder& operator=(const BusRecorder&) = delete;

  /// Closes the log.
  void close() { log_.close(); }

  /// Why the recording has stopped, in one line; empty while it runs.
  [[nodiscard]] const std::string& stopped() const { return log_.stopped(); }

 private:
  Recording log_;
  Clock clock_;
};

/// `83.4 s simulated, 7.9 x real time, 31.2 m, driving`.
std::string progress_line(double elapsed_s, double factor, const RunState& run,
                          const VehicleState& vehicle);

/// Reports the progress of a run on standard error: a line every kPeriodUs of wall time, and one
/// when the run fails.
class ProgressReporter {
 public:
  static constexpr std::int64_t kPeriodUs = 5'000'000;

  explicit ProgressReporter(std::string program) : program_(std::move(program)) {}

  /// `wall_us` is any monotonic time [µs].
  void update(const Simulation& simulation, std::int64_t start_utime, std::int64_t wall_us);

  /// Prints one line immediately.
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

/// The simulator on a bus with other processes: steps at its pace, publishes the status messages of
/// every stage, injects process faults and reports progress on standard error.
class LiveSimulator {
 public:
  /// `bus` and `site` must outlive this.
  LiveSimulator(Bus& bus, const Site& site, const WorldDescription& description,
                const SimulationParams& params, const LiveRunOptions& options,
                std::int64_t start_utime);
  LiveSimulator(const LiveSimulator&) = delete;
  LiveSimulator& operator=(const LiveSimulator&) = delete;

  /// Steps if a step is due. Returns how long to handle messages before the next call [µs]; an
  /// answer of a stage may shorten that. `wall_us` is any monotonic time.
  std::int64_t advance(std::int64_t wall_us);

  /// Whether the requested duration is over.
  [[nodiscard]] bool done() const;

  /// Closes the recording, if there is one. Throws FileError if it is incomplete.
  void close_record();

 private:
  void step();
  void report_record();
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
  bool record_stopped_ = false;
};

}  // namespace adit
