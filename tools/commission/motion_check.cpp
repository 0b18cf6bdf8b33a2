// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/commission/motion_check.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace adit {
namespace {

using Verdict = CheckResult::Verdict;

constexpr double kShare = 0.15;   // of a length
constexpr double kTurnRad = 0.2;  // of an angle
constexpr double kMovesM_S = 0.02;
constexpr double kMovedM = 0.1;  // from which a motion counts
constexpr double kMovedRad = 0.2;
constexpr double kRestS = 1.0;
constexpr double kGapS = 0.5;  // of VEHICLE_STATE, over which speed is not integrated

CheckResult verdict(bool good, const char* property, const std::string& text, const char* remedy) {
  if (good) return {Verdict::kGood, property, text};
  return {Verdict::kBad, property, text + ": " + remedy};
}

}  // namespace

void MotionCheck::add_pose(const Pose2& T_odom_body, std::int64_t utime) {
  utime_ = std::max(utime_, utime);
  if (!T_odom_first_) T_odom_first_ = T_odom_body;
  T_odom_last_ = T_odom_body;
  const Pose2 moved = between(*T_odom_first_, T_odom_body);
  moved_ = moved_ || moved.translation().norm() > kMovedM || std::abs(moved.theta) > kMovedRad;
}

void MotionCheck::add_speed(double speed_m_s, std::int64_t utime) {
  utime_ = std::max(utime_, utime);
  if (speed_utime_) {
    const double seconds = 1e-6 * static_cast<double>(utime - *speed_utime_);
    if (seconds > 0.0 && seconds < kGapS) rolled_m_ += speed_m_s * seconds;
  }
  speed_utime_ = utime;
  if (std::abs(speed_m_s) > kMovesM_S) moved_utime_ = utime;
}

bool MotionCheck::is_over() const {
  return moved_ && moved_utime_ > 0 && 1e-6 * static_cast<double>(utime_ - moved_utime_) > kRestS;
}

CheckResults MotionCheck::results() const {
  if (!T_odom_first_)
    return {{Verdict::kBad, "pose", "no POSE arrived: scan_matching does not run; adit ps"}};
  const Pose2 moved = between(*T_odom_first_, T_odom_last_);
  CheckResults results;
  if (motion_ == Motion::kLeft) {
    results.push_back(verdict(
        std::abs(moved.theta - amount_) <= kTurnRad, "yaw",
        fmt::format("POSE turned by {:.2f} rad, driven {:.2f} to the left", moved.theta, amount_),
        moved.theta < 0.0
            ? "to the other side: a laser is upside down or its beams are in the wrong order; adit "
              "check-driver"
            : "theta_rad of a laser, its field_of_view_rad or timing are wrong; adit check "
              "CONFIG"));
    return results;
  }
  results.push_back(
      verdict(std::abs(moved.x - amount_) <= kShare * amount_, "x",
              fmt::format("POSE moved {:.2f} m forwards, driven {:.2f}", moved.x, amount_),
              moved.x < 0.0
                  ? "backwards: front and rear lasers are exchanged, or theta_rad is off by half a "
                    "turn"
                  : "theta_rad of a laser is wrong, or the ranges are in another unit"));
  results.push_back(verdict(std::abs(moved.y) <= kShare * amount_, "y",
                            fmt::format("POSE moved {:.2f} m to the left", moved.y),
                            "theta_rad of a laser is wrong, or the robot drove a bend"));
  results.push_back(verdict(
      std::abs(rolled_m_ - amount_) <= kShare * amount_, "wheels",
      fmt::format("the wheels rolled {:.2f} m by VEHICLE_STATE", rolled_m_),
      rolled_m_ < 0.0 ? "the sign of the speed is wrong in the driver of the vehicle"
                      : "the driver of the vehicle has another wheel radius or gear ratio"));
  return results;
}

}  // namespace adit
