// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ros/import/imported_laser.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "common/geometry/pose2.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr double kTiltedRad = 1.0 * std::numbers::pi / 180.0;
constexpr double kMovedM = 0.02;

double inclination(const Eigen::Isometry3d& T_body_laser) {
  return std::acos(std::clamp(std::abs(T_body_laser.linear()(2, 2)), 0.0, 1.0));
}

void use_ranges(const SurveyedTopic& topic, LaserMount& mount) {
  const double max = topic.range_max_m.value_or(0.0);
  const double min = topic.range_min_m.value_or(0.0);
  if (std::isfinite(max) && max > 0.0) mount.range_max_m = max;
  if (std::isfinite(min) && min > 0.0 && min < mount.range_max_m) mount.range_min_m = min;
}

/// T_body_laser.
Eigen::Isometry3d mount_of(const SurveyedTopic& topic, const BagSurvey& survey,
                           const TopicChoice& choice, std::vector<std::string>& warnings) {
  const std::string& base = choice.base_frame;
  auto T = survey.frames.lookup(base, topic.frame, 0);
  const SurveyedTopic* const odometry = survey.find(choice.odometry);
  const bool body_is_laser = base == topic.frame && odometry && odometry->child_frame != base;
  if (!T || body_is_laser) {
    warnings.push_back(fmt::format(
        "tf does not connect {} with {}: the laser of {} is taken at the origin of the body",
        quote(body_is_laser ? odometry->child_frame : base), quote(topic.frame), topic.topic.name));
    return Eigen::Isometry3d::Identity();
  }
  for (const std::int64_t utime : survey.frames.times_of(base, topic.frame)) {
    const auto other = survey.frames.lookup(base, topic.frame, utime);
    if (other && inclination(*other) < inclination(*T) - 1e-6) T = other;
  }
  return *T;
}

}  // namespace

ImportedLaser ImportedLaser::of(LaserId id, const std::string& topic, const BagSurvey& survey,
                                const TopicChoice& choice, std::vector<std::string>& warnings) {
  ImportedLaser laser;
  laser.id = id;
  laser.topic = survey.find(topic);
  laser.base_frame = choice.base_frame;
  laser.T_body_laser = mount_of(*laser.topic, survey, choice, warnings);
  laser.moves = survey.frames.moves(choice.base_frame, laser.topic->frame);
  const Eigen::Vector3d& p_body_laser = laser.T_body_laser.translation();
  if (laser.is_cloud()) {
    laser.level.mount.T_body_laser = {p_body_laser.x(), p_body_laser.y(), 0.0};
    laser.level.mount.height_m = p_body_laser.z();
  } else if (const auto level = LevelMount::of(laser.T_body_laser)) {
    laser.level = *level;
  } else {
    throw std::runtime_error(
        fmt::format("{}: by tf the laser is inclined by {:.0f}° in {}, and is no level laser",
                    topic, rad_to_deg(inclination(laser.T_body_laser)), quote(choice.base_frame)));
  }
  use_ranges(*laser.topic, laser.level.mount);
  if (laser.topic->timing) {
    laser.level.mount.timing = *laser.topic->timing;
    laser.level.mount.timing.clockwise = laser.topic->timing->clockwise != laser.level.upside_down;
  }
  return laser;
}

bool ImportedLaser::is_elsewhere(const FrameTree& frames, std::int64_t utime) const {
  if (!moves) return false;
  const auto T = frames.lookup(base_frame, topic->frame, utime);
  if (!T) return true;
  const Eigen::Isometry3d moved = T_body_laser.inverse() * *T;
  return moved.translation().norm() > kMovedM ||
         Eigen::AngleAxisd(moved.linear()).angle() > kTiltedRad;
}

}  // namespace adit
