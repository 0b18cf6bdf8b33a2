// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "procs/mission/traversed_path.hpp"

namespace adit {

/// What the mission knows of the map.
struct KnownMap {
  std::optional<int> newest_local_map;      ///< id of the newest local map so far
  std::optional<std::string> home_unknown;  ///< why home is not where the map has it
};

/// Where the robot is and how it came there: the odom frame in use, where that lies in map, and the
/// traversed path, across restarts of scan matching and of the mission.
class MissionLocalization {
 public:
  enum class OdomChange {
    kNone,
    kReset,               ///< scan matching restarted: poses in odom of before are invalid
    kResetBeforeRestart,  ///< the same while the mission was not running: all computers were off
  };

  /// Continues a mission after a restart of its process. `last_utime`: of the last stored phase
  /// [µs since the epoch]; `path`: all stored poses, oldest first.
  void restore(std::int64_t last_utime, double distance_travelled_m,
               std::vector<StoredPathPose> path, KnownMap known_map = {});

  /// Returns the pose if it must be stored.
  std::optional<StoredPathPose> add_pose(std::int64_t utime, const Pose2& T_odom_body,
                                         double z_odom_m = 0.0);
  /// `odom_epoch_utime`: of the odom frame of a scan match.
  OdomChange set_odom_epoch(std::int64_t odom_epoch_utime);
  /// Returns how far it moves what was driven long ago, at the place of the body [m].
  double add_correction(const MapCorrection& correction);
  [[nodiscard]] const KnownMap& known_map() const { return known_map_; }
  /// Continues the traversed path into earlier odom frames although the map correction is
  /// uncertain.
  void anchor_to_estimate();

  [[nodiscard]] bool is_restored() const { return restored_utime_.has_value(); }
  [[nodiscard]] const TraversedPath& traversed_path() const { return traversed_path_; }
  /// The newest pose of the present odom frame.
  [[nodiscard]] const std::optional<Pose2>& T_odom_body() const {
    return traversed_path_.T_odom_body();
  }
  [[nodiscard]] bool has_recent_pose(std::int64_t utime) const;
  /// When the present odom frame began [µs since the epoch]; empty before the first scan match.
  [[nodiscard]] const std::optional<std::int64_t>& odom_epoch_utime() const {
    return odom_epoch_utime_;
  }
  /// Whether mapping reported where the present odom frame lies.
  [[nodiscard]] bool has_correction() const { return has_correction_; }
  /// Whether this is not the first odom frame of the mission.
  [[nodiscard]] bool odom_was_reset() const { return odom_was_reset_; }
  /// How far the body may be from where the map has it relative to home, with a probability of
  /// 95 % [m]; empty before the first map correction of the present odom frame.
  [[nodiscard]] std::optional<double> home_uncertainty_m() const;
  /// Distance of the body from home by the map, in space [m]; empty as above.
  [[nodiscard]] std::optional<double> distance_from_home_m() const;
  [[nodiscard]] bool is_waiting_for_correction() const {
    return odom_was_reset_ && !has_correction_;
  }

 private:
  void restore_path();
  void compare_map(const MapCorrection& correction);

  TraversedPath traversed_path_;
  std::optional<std::int64_t> odom_epoch_utime_;
  std::optional<Pose2> T_map_odom_;  ///< of the present odom frame, also from before a restart
  double z_map_odom_m_ = 0.0;        ///< its height in map
  double body_sd_m_ = 0.0;           ///< of the body relative to home, see MapCorrection
  bool has_correction_ = false;      ///< received since the present odom frame began
  bool odom_was_reset_ = false;
  KnownMap known_map_;
  bool map_is_restored_ = false;  ///< after all computers were off; until the first map correction
  std::optional<std::int64_t> restored_utime_;  ///< of the last phase before a restart
  std::vector<StoredPathPose> restored_path_;   ///< until the odom frame is known
};

}  // namespace adit
