// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/level_pose.hpp"
#include "tools/survey/input/cloud_store.hpp"

namespace adit {

/// A 3D scan for LevelCorrection.
struct LeveledScan {
  std::size_t cloud = 0;  ///< position in the CloudStore
  int session = 0;        ///< of its odom frame
  LevelPose T_survey_level;
};

/// The constant error of the attitude of each session, by which the level frames of its 3D scans
/// are inclined alike (procs/mapping/level_error.hpp). It lifts what is ahead of every scan: at 8 m
/// by 4 cm for an accelerometer of common quality. Scans of one place with different headings show
/// it by floor and roof, which they see inclined against each other.
class LevelCorrection {
 public:
  LevelCorrection(const CloudStore& clouds, const std::vector<LeveledScan>& scans);

  /// Turns points of a level frame of a session into the vertical.
  [[nodiscard]] Eigen::Matrix3d rotation(int session) const;
  /// Standard deviation of what remains, of roll and of pitch [rad].
  [[nodiscard]] double sd_rad(int session) const;

 private:
  struct Session {
    Eigen::Vector2d rotation_rad{0.0, 0.0};  ///< about x and y
    double sd_rad = 0.0;
  };
  std::map<int, Session> sessions_;
};

}  // namespace adit
