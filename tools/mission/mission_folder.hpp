// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/geometry/pose2.hpp"

namespace adit {

/// Where the body of a simulated mission stands, and when.
struct SimulatedPose {
  std::int64_t utime = 0;  ///< [µs since the epoch]
  Pose2 T_world_body;
};

/// The folder of one mission: the log of each of its lives, run.lcmlog, run_2.lcmlog, .., and what
/// stages need to go on, which are journals and the files that configured them.
class MissionFolder {
 public:
  /// Made where it is not there. Throws std::filesystem::filesystem_error.
  explicit MissionFolder(const std::filesystem::path& path);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// The mine with the robot where it once began.
  [[nodiscard]] std::filesystem::path world() const { return path_ / "world.yaml"; }
  /// The same with the robot where the present life begins.
  [[nodiscard]] std::filesystem::path start() const { return path_ / "start.yaml"; }
  [[nodiscard]] std::filesystem::path config() const { return path_ / "mission.yaml"; }
  [[nodiscard]] std::filesystem::path journal() const { return path_ / "mission.journal"; }
  [[nodiscard]] std::filesystem::path socket() const { return path_ / "supervisor.sock"; }
  /// Locked while a mission runs here; holds the id of the process whose network that is on.
  [[nodiscard]] std::filesystem::path lock_file() const { return path_ / "mission.pid"; }

  /// Those that are there, in order of time.
  [[nodiscard]] std::vector<std::filesystem::path> logs() const;
  /// The one that the next life is to write.
  [[nodiscard]] std::filesystem::path next_log() const;

  [[nodiscard]] bool has_mission() const;
  /// Throws std::runtime_error, with what to do about it, where another mission would be
  /// overwritten.
  void require_new() const;
  /// Throws std::runtime_error where there is none, or one that has ended.
  void require_unfinished() const;

  /// Where the simulated body was last, by the logs. Throws std::runtime_error where none says it.
  [[nodiscard]] SimulatedPose last_pose() const;

 private:
  std::filesystem::path path_;
};

}  // namespace adit
