// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/bus/bus.hpp"
#include "tools/mission/mission_progress.hpp"

namespace adit {

/// Monitors a simulated mission whose stages are processes: its progress, its end, and stages that
/// do not respond. Wall time is from any monotonic clock [µs].
class MissionMonitor {
 public:
  static constexpr std::int64_t kStageTimeoutUs = 10'000'000;  ///< of wall time
  /// Simulated time in which the volume map may still store 3D scans, as after its restart.
  static constexpr double kStoringMaxS = 30.0;

  /// `bus` must outlive this.
  MissionMonitor(Bus& bus, const std::filesystem::path& trace, const MissionStart& start);

  [[nodiscard]] MissionProgress progress() const { return follower_.progress(); }
  /// Why phases.tsv could not be written; empty if it was.
  [[nodiscard]] std::string trace_failure() const { return follower_.failure(); }
  [[nodiscard]] double farthest_m() const { return follower_.farthest_m(); }
  /// For long enough to record it and, if possible, until the volume map has all 3D scans.
  [[nodiscard]] bool has_ended() const;
  /// Published 3D scans that the volume map has not reported as received.
  [[nodiscard]] std::size_t scans_to_store() const { return scans_to_store_.size(); }
  /// Failure of the simulated run, a collision; empty without.
  [[nodiscard]] const std::string& failure() const { return failure_; }

  /// Simulated time [µs since the epoch]; 0 before there is any.
  [[nodiscard]] std::int64_t utime() const { return utime_; }
  /// Stages that delay the simulator for longer than kStageTimeoutUs. Each is returned once until
  /// it responds again. Empty before the first SIM_TIME.
  std::vector<std::string> newly_timed_out(std::int64_t wall_us);

 private:
  struct StageResponse {
    std::int64_t utime = 0;
    std::optional<std::int64_t> behind_since_us;  // wall time
    bool reported = false;
  };

  void subscribe_all(Bus& bus);
  [[nodiscard]] double simulated_s() const;

  std::int64_t first_utime_ = 0;
  std::int64_t utime_ = 0;
  MissionStart start_;
  std::string failure_;
  std::set<std::int64_t> scans_to_store_;  // Cloud::utime
  std::map<std::string, StageResponse> responses_;
  MissionFollower follower_;
};

}  // namespace adit
