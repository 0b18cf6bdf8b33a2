// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "common/geometry/pose2.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/sensing/seconds.hpp"
#include "common/types/vehicle_state.hpp"

namespace adit {

/// Says when a vehicle has been held for so long that this will not end by itself. What holds it
/// may let it go a centimetre and hold it again, and so it is the way that counts.
class HoldTimeout {
 public:
  static constexpr double kProgressM = 0.05;  ///< that begins the time anew

  explicit HoldTimeout(double seconds_max) : seconds_max_(seconds_max) {}

  /// The way so far, on any path, while the vehicle drives or is held.
  void update(std::int64_t utime, double distance_m, bool held);
  void begin_reset() { since_utime_.reset(); }

  [[nodiscard]] bool is_reached() const { return reached_; }

 private:
  double seconds_max_;
  std::optional<std::int64_t> since_utime_;  ///< when it was held first after the way below
  double distance_m_ = 0.0;
  bool reached_ = false;
};

/// How far was driven since a scan, or wheels or a gyro in its place, last told the motion in every
/// direction. Where nothing tells it the pose stands still, and the end of a path never comes.
class UnobservedMotion {
 public:
  /// A scan that is lost says neither.
  void add_match(const ScanMatch& match) {
    if (match.status != ScanMatch::Status::kMatched) return;
    unobserved_ = has_unobserved_direction(match);
    if (!unobserved_) distance_m_ = 0.0;
  }
  /// By command [m], either way.
  void drive(double distance_m) {
    if (unobserved_) distance_m_ += std::abs(distance_m);
  }
  void begin_reset() { distance_m_ = 0.0; }

  [[nodiscard]] double distance_m() const { return distance_m_; }

 private:
  bool unobserved_ = false;
  double distance_m_ = 0.0;
};

/// How far the way by the wheels and that by the poses are apart since a path began. Where walls
/// are smooth, a tilted laser that looks at the floor may say that the robot stands while it goes
/// on: then the end of its path comes too late, and what is behind the end nobody has looked at.
/// Or the wheels spin: then it does not get where it believes. Which of the two is wrong does not
/// matter, since another look helps against both.
class OdometryMismatch {
 public:
  void begin_reset() { *this = {}; }

  /// By the wheels. Where they were silent for long, all begins anew.
  void add_state(const VehicleState& state) {
    if (state_) {
      const double dt_s = seconds(state.utime - state_->utime);
      if (dt_s <= 0.0) return;
      const double distance_m = 0.5 * (state.speed_m_s + state_->speed_m_s) * dt_s;
      if (dt_s > kGapMaxS || !std::isfinite(distance_m)) return begin_reset();
      wheels_m_ += distance_m;
      distance_travelled_m_ += std::abs(distance_m);
    }
    state_ = state;
  }
  /// Where the wheels have fallen silent, all begins anew when they speak again.
  void add_pose(std::int64_t utime, const Pose2& T_odom_body) {
    if (state_ && seconds(utime - state_->utime) > kGapMaxS) begin_reset();
    if (T_odom_body_ && state_) {
      const Pose2 step = between(*T_odom_body_, T_odom_body);
      pose_m_ += (Pose2{0.0, 0.0, -0.5 * step.theta} * step.translation()).x();
    }
    T_odom_body_ = T_odom_body;
  }

  /// Positive where the wheels have gone farther [m].
  [[nodiscard]] double difference_m() const { return wheels_m_ - pose_m_; }
  /// By the wheels, to and fro [m].
  [[nodiscard]] double distance_travelled_m() const { return distance_travelled_m_; }

 private:
  static constexpr double kGapMaxS = 0.5;

  std::optional<VehicleState> state_;
  std::optional<Pose2> T_odom_body_;
  double wheels_m_ = 0.0;
  double pose_m_ = 0.0;
  double distance_travelled_m_ = 0.0;
};

}  // namespace adit
