// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "sim/world/world_file.hpp"
#include "tools/mission/mission_live.hpp"
#include "tools/mission/mission_progress.hpp"

namespace adit {

/// Pose of the simulated body at a time.
struct SimulatedPose {
  std::int64_t utime = 0;  ///< [µs since the epoch]
  Pose2 T_world_body;
  double z_m = 0.0;  ///< of the body in world
};

/// The folder of one mission: the log of each run, run.lcmlog, run_2.lcmlog, .., or the same with
/// .zst, and the journals
/// and configuration files that are required to resume it.
class MissionFolder {
 public:
  /// Creates the folder if it does not exist. Throws std::filesystem::filesystem_error.
  explicit MissionFolder(const std::filesystem::path& path);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// The world with the robot at its first start.
  [[nodiscard]] std::filesystem::path world() const { return path_ / "world.yaml"; }
  /// The world with the robot at the start of the current run.
  [[nodiscard]] std::filesystem::path start() const { return path_ / "start.yaml"; }
  [[nodiscard]] std::filesystem::path config() const { return path_ / "mission.yaml"; }
  [[nodiscard]] std::filesystem::path journal() const { return path_ / "mission.journal"; }
  [[nodiscard]] std::filesystem::path socket() const { return path_ / "supervisor.sock"; }
  /// Locked while the mission runs; has the id of a process on the network of the mission.
  [[nodiscard]] std::filesystem::path lock_file() const { return path_ / "mission.pid"; }

  /// Existing logs, in order of time.
  [[nodiscard]] std::vector<std::filesystem::path> logs() const;
  /// Log of the next run.
  [[nodiscard]] std::filesystem::path next_log(LogForm form = LogForm::kPlain) const;

  [[nodiscard]] bool has_mission() const;
  /// Throws std::runtime_error if the folder has a mission, which a new one would overwrite.
  void require_new() const;
  /// Throws std::runtime_error if the folder has no mission, or one that has ended.
  void require_unfinished() const;

  /// Last pose of the simulated body in the logs. Throws std::runtime_error if no log has one.
  [[nodiscard]] SimulatedPose last_pose() const;
  /// z of the first true pose of the first run; empty if its log has none.
  [[nodiscard]] std::optional<double> start_height_m() const;

 private:
  std::filesystem::path path_;
};

/// Simulated time for which the robot is off when it loses power and its mission is resumed.
inline constexpr std::int64_t kPowerLossDurationUs = 10'000'000;

/// The world with the start at a pose.
WorldDescription with_start_at(WorldDescription world, const SimulatedPose& pose);

/// What to tell a person about the journals of a mission before they are opened: a line for each
/// that is not intact. Throws std::runtime_error if one cannot be read.
std::vector<std::string> journal_reports(const MissionFolder& folder);

/// YAML for all processes of a mission: all keys of all stages with their effective values.
/// Journals have no folder, because the processes run in the folder of the mission. Throws
/// ConfigError.
std::string mission_config(const std::filesystem::path& config);

/// Joins YAML texts. Of sections with the same name the first one is used.
std::string without_repeated_sections(const std::vector<std::string>& yamls);

/// Writes all input files of the processes of a mission into its folder. A resumed mission keeps
/// its configuration, and the simulated robot starts at the last TRUTH. Returns the
/// first start. Throws for invalid options, and as MissionFolder does.
MissionStart prepare_mission(const MissionLiveOptions& options, const MissionFolder& folder);

}  // namespace adit
