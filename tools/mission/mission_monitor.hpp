// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/bus/bus.hpp"
#include "tools/mission/mission_progress.hpp"

namespace adit {

/// What can be heard of a simulated mission of which each stage is a process: how it stands, when
/// it is over, and who has fallen silent. Wall time is any that goes on steadily [µs].
class MissionMonitor {
 public:
  static constexpr std::int64_t kStageTimeoutUs = 10'000'000;  ///< of wall time
  static constexpr double kAfterEndS = 2.0;                    ///< that the log goes on

  /// `bus` must outlive this. `p_world_start` is where the robot once began.
  MissionMonitor(Bus& bus, const std::filesystem::path& trace,
                 const Eigen::Vector2d& p_world_start);

  [[nodiscard]] MissionProgress progress() const;
  [[nodiscard]] double farthest_m() const { return farthest_m_; }
  [[nodiscard]] bool has_ended() const;
  /// Why the simulated run failed: a collision; empty if it did not.
  [[nodiscard]] const std::string& failure() const { return failure_; }

  /// Simulated time [µs since the epoch]; 0 before there is any.
  [[nodiscard]] std::int64_t utime() const { return utime_; }
  /// Stages that hold up the simulator for longer than our patience, each told once until it
  /// answers again. Nobody while the simulator itself says nothing.
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
  MissionPhase phase_;
  double ended_s_ = 0.0;
  int local_maps_ = 0;
  Eigen::Vector2d p_world_start_;
  double from_start_m_ = 0.0;
  double farthest_m_ = 0.0;
  std::string failure_;
  std::map<std::string, StageResponse> responses_;
  PhaseTrace trace_;
};

}  // namespace adit
