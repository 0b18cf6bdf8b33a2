// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// Poses within a short distance.
struct PoseGroup {
  Pose2 T_odom_first;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();  ///< of the poses relative to the first one
  int count = 0;

  void add(const Pose2& T_odom_steered);
  [[nodiscard]] Pose2 mean() const;
};

/// The angle from the heading to the direction in which the steered point moves along the body's x
/// axis [rad], positive to the left: side slip on a cross slope or of worn tyres, or an error of
/// the steering (sideslip angle, ISO 8855). Without it PD control keeps an error of twice the angle
/// times `LateralParams::response_m` from the path. It is the slope of a line through the lateral
/// motion that the heading does not explain, over the last `kWindowM` of travel; all poses count,
/// so that it is the more accurate the slower the robot is.
class DriftAngle {
 public:
  static constexpr double kWindowM = 0.4;
  static constexpr double kMaxRad = 0.1;  ///< more is an error of the poses

  void add(const Pose2& T_odom_steered);

  /// 0 after a step of the pose or a change of direction, then less than measured until `kWindowM`
  /// is travelled.
  [[nodiscard]] double angle_rad() const { return angle_rad_; }

 private:
  void begin(const Pose2& T_odom_steered);
  void end_group();
  void update_angle();

  std::optional<PoseGroup> group_;      ///< the newest
  std::optional<Pose2> T_odom_before_;  ///< mean of the one before
  double direction_ = 0.0;              ///< of travel: 1, −1 in reverse, 0 unknown
  std::deque<Eigen::Vector2d> p_;       ///< of each group: travelled along the heading, and across
  double angle_rad_ = 0.0;
};

}  // namespace adit
