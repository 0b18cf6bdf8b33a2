// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "common/geometry/pose2.hpp"
#include "common/sensing/seconds.hpp"
#include "common/vehicle/drive_command.hpp"

namespace adit {

/// How far the way by the wheels and that by the poses are apart since a path began. Where walls
/// are smooth, a tilted laser that looks at the floor may say that the robot stands while it goes
/// on: then the end of its path comes too late, and what is behind the end nobody has looked at.
/// Or the wheels spin: then it does not get where it believes. Which of the two is wrong does not
/// matter, since another look helps against both.
class WheelDisagreement {
 public:
  void begin_anew() { *this = {}; }

  /// By the wheels. Where they were silent for long, all begins anew.
  void add_state(const VehicleState& state) {
    if (state_) {
      const double dt_s = seconds(state.utime - state_->utime);
      if (dt_s <= 0.0) return;
      const double way_m = 0.5 * (state.speed_m_s + state_->speed_m_s) * dt_s;
      if (dt_s > kGapMaxS || !std::isfinite(way_m)) return begin_anew();
      wheels_m_ += way_m;
      driven_m_ += std::abs(way_m);
    }
    state_ = state;
  }
  /// Where the wheels have fallen silent, all begins anew when they speak again.
  void add_pose(std::int64_t utime, const Pose2& T_odom_body) {
    if (state_ && seconds(utime - state_->utime) > kGapMaxS) begin_anew();
    if (T_odom_body_ && state_) {
      const Pose2 step = between(*T_odom_body_, T_odom_body);
      pose_m_ += (Pose2{0.0, 0.0, -0.5 * step.theta} * step.translation()).x();
    }
    T_odom_body_ = T_odom_body;
  }

  /// Positive where the wheels have gone farther [m].
  [[nodiscard]] double apart_m() const { return wheels_m_ - pose_m_; }
  /// By the wheels, to and fro [m].
  [[nodiscard]] double driven_m() const { return driven_m_; }

 private:
  static constexpr double kGapMaxS = 0.5;

  std::optional<VehicleState> state_;
  std::optional<Pose2> T_odom_body_;
  double wheels_m_ = 0.0;
  double pose_m_ = 0.0;
  double driven_m_ = 0.0;
};

}  // namespace adit
