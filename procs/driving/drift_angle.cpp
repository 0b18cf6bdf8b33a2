// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/drift_angle.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

namespace adit {
namespace {

constexpr double kGroupM = 0.05;
constexpr double kStepMaxM = 0.5;  // between poses; more, or a turn by more, is no motion
constexpr double kStepMaxRad = 0.5;
constexpr std::size_t kGroups = 9;  // over the window, with both ends
static_assert((kGroups - 1) * kGroupM == DriftAngle::kWindowM);

}  // namespace

void PoseGroup::add(const Pose2& T_odom_steered) {
  if (count == 0) T_odom_first = T_odom_steered;
  sum += between(T_odom_first, T_odom_steered).vector();
  ++count;
}

Pose2 PoseGroup::mean() const {
  const Eigen::Vector3d mean = sum / count;
  return T_odom_first * Pose2{mean.x(), mean.y(), mean.z()};
}

void DriftAngle::add(const Pose2& T_odom_steered) {
  if (!group_) return begin(T_odom_steered);
  const Pose2 T_first_now = between(group_->T_odom_first, T_odom_steered);
  const double distance_m = T_first_now.translation().norm();
  if (distance_m > kStepMaxM || std::abs(T_first_now.theta) > kStepMaxRad)
    return begin(T_odom_steered);
  if (distance_m >= kGroupM) {
    const double direction = std::copysign(1.0, T_first_now.x);
    if (direction != direction_) begin(group_->T_odom_first);
    direction_ = direction;
    end_group();
  }
  group_->add(T_odom_steered);
}

void DriftAngle::begin(const Pose2& T_odom_steered) {
  group_.emplace().add(T_odom_steered);
  T_odom_before_.reset();
  direction_ = 0.0;
  p_.clear();
  angle_rad_ = 0.0;
}

void DriftAngle::end_group() {
  const Pose2 T_odom_now = group_->mean();
  if (T_odom_before_) {
    const Pose2 T_before_now = between(*T_odom_before_, T_odom_now);
    // The chord of an arc without drift has the mean of the headings.
    p_.push_back(p_.back() +
                 Eigen::Rotation2Dd(-0.5 * T_before_now.theta) * T_before_now.translation());
    if (p_.size() > kGroups) p_.pop_front();
    update_angle();
  } else {
    p_.assign(1, Eigen::Vector2d::Zero());
  }
  T_odom_before_ = T_odom_now;
  group_.emplace();
}

void DriftAngle::update_angle() {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : p_) mean += p / static_cast<double>(p_.size());
  double along2 = 0.0;
  double across = 0.0;
  for (const Eigen::Vector2d& p : p_) {
    along2 += (p.x() - mean.x()) * (p.x() - mean.x());
    across += (p.x() - mean.x()) * (p.y() - mean.y());
  }
  const double share = static_cast<double>(p_.size() - 1) / static_cast<double>(kGroups - 1);
  angle_rad_ = share * std::clamp(std::atan(across / along2), -kMaxRad, kMaxRad);
}

}  // namespace adit
