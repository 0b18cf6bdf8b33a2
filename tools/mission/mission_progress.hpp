// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/bus/bus.hpp"
#include "common/types/mission.hpp"

namespace adit {

/// Where the robot started first, in world.
struct MissionStart {
  Eigen::Vector2d p_world{0.0, 0.0};  ///< [m]
  std::optional<double> z_m = {};     ///< empty: that of the first true pose
};

/// Progress of a mission.
struct MissionProgress {
  MissionPhase phase;
  double simulated_s = 0.0;
  double distance_from_start_m = 0.0;  ///< straight-line distance of the true pose, in space
  int local_maps = 0;
  /// What the disk has not taken and why, a line each: the recording, or what a stage stores.
  std::vector<std::string> not_stored = {};
};

/// Progress as one line; `factor` is the speed in multiples of real time.
std::string progress_text(const MissionProgress& progress, double factor);

/// Follows the phases of a simulated mission until it has ended. Appends each change of phase and
/// each new stop reason to a file of tab-separated values: time [s], number of the phase, "out" or
/// "home", goal, frontier, laser, distance travelled [m], remaining distance [m], reason.
class MissionFollower {
 public:
  static constexpr double kAfterEndS = 2.0;  ///< recorded after the end

  /// `bus` must outlive this. `simulated_s` returns the simulated time since the start.
  MissionFollower(Bus& bus, const std::filesystem::path& file, std::function<double()> simulated_s);
  MissionFollower(const MissionFollower&) = delete;
  MissionFollower& operator=(const MissionFollower&) = delete;

  /// The disk does not take the recording, or what a stage stores: one line, empty if it does.
  /// Stays.
  void add_not_stored(const std::string& line);
  /// Takes the present straight-line distance of the true pose from the start.
  void set_distance_from_start(double distance_m);

  [[nodiscard]] const MissionPhase& phase() const { return phase_; }
  [[nodiscard]] MissionProgress progress() const;
  /// Largest straight-line distance of the true pose from the start.
  [[nodiscard]] double farthest_m() const { return farthest_m_; }
  /// Why a line of the file could not be written; empty if all were.
  [[nodiscard]] std::string failure() const;
  /// Whether the phase has been ended for a duration.
  [[nodiscard]] bool has_ended(double for_s = kAfterEndS) const;

 private:
  void on_phase(const MissionPhase& phase);
  void write(const MissionPhase& phase);

  std::filesystem::path path_;
  std::ofstream file_;
  std::function<double()> simulated_s_;
  MissionPhase phase_;
  std::int32_t written_sequence_ = 0;
  std::string written_stop_;
  double ended_s_ = 0.0;  ///< when the phase became ended
  int local_maps_ = 0;
  double distance_from_start_m_ = 0.0;
  double farthest_m_ = 0.0;
  std::vector<std::string> not_stored_;
};

}  // namespace adit
