// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/geometry/pose2.hpp"
#include "tools/check_driver/check_result.hpp"

namespace adit {

/// Compares a motion that a person drove and measured on the ground with what the robot measured.
class MotionCheck {
 public:
  enum class Motion { kForwards, kLeft };

  /// `amount`: how far the person drove or turned [m or rad].
  MotionCheck(Motion motion, double amount) : motion_(motion), amount_(amount) {}

  /// T_odom_body, with the time of reception [µs].
  void add_pose(const Pose2& T_odom_body, std::int64_t utime);
  /// Of the wheels, from VEHICLE_STATE [m/s].
  void add_speed(double speed_m_s, std::int64_t utime);

  /// Whether the robot has moved, and then stood for a second.
  [[nodiscard]] bool is_over() const;
  /// Pass or fail: lengths within 15 %, angles within 0.2 rad.
  [[nodiscard]] CheckResults results() const;

 private:
  Motion motion_;
  double amount_;
  std::optional<Pose2> T_odom_first_;
  Pose2 T_odom_last_;
  bool moved_ = false;
  std::int64_t moved_utime_ = 0;  ///< last motion
  std::int64_t utime_ = 0;
  std::optional<std::int64_t> speed_utime_;
  double rolled_m_ = 0.0;
};

}  // namespace adit
