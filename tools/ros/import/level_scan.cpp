// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ros/import/level_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/geometry/pose2.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

constexpr double kSlowestHz = 1.0;  // of the turns of a laser
constexpr double kFastestHz = 400.0;
constexpr double kInclinationMaxRad = 10.0 * std::numbers::pi / 180.0;

}  // namespace

std::optional<LevelMount> LevelMount::of(const Eigen::Isometry3d& T_body_laser) {
  const double up = T_body_laser.linear()(2, 2);  // z axis of the laser against that of the body
  if (std::abs(up) < std::cos(kInclinationMaxRad)) return std::nullopt;
  LevelMount level;
  level.mount.T_body_laser = in_plan(T_body_laser);
  level.mount.height_m = T_body_laser.translation().z();
  level.upside_down = up < 0.0;
  return level;
}

std::optional<ScanTiming> timing_of(const RosLaserScan& scan) {
  const double per_turn_s = 2.0 * std::numbers::pi * scan.time_increment_s /
                            scan.angle_step_rad;  // NaN or infinite: none
  const double hz = 1.0 / std::abs(per_turn_s);
  if (!(hz >= kSlowestHz && hz <= kFastestHz)) return std::nullopt;
  return ScanTiming{.mirror_hz = hz, .mirror_turns = 1, .clockwise = per_turn_s < 0.0};
}

std::optional<LaserScan> level_scan(const RosLaserScan& scan, bool upside_down) {
  LaserScan level{scan.utime, scan.ranges_m, scan.angle_min_rad, scan.angle_step_rad};
  if (upside_down) {
    level.angle_min_rad = -level.angle_min_rad;
    level.angle_step_rad = -level.angle_step_rad;
  }
  if (level.angle_step_rad < 0.0) {
    const auto steps = static_cast<double>(level.ranges_m.size()) - 1.0;
    std::ranges::reverse(level.ranges_m);
    level.angle_min_rad += steps * level.angle_step_rad;
    level.angle_step_rad = -level.angle_step_rad;
  }
  if (level.ranges_m.empty() || !rejection_reason(level).empty()) return std::nullopt;
  return level;
}

LaserScan level_scan(const std::vector<Eigen::Vector3f>& points, const LevelSlice& slice) {
  const auto beams = static_cast<int>(std::lround(2.0 * std::numbers::pi / slice.angle_step_rad));
  LaserScan scan;
  scan.angle_step_rad = slice.angle_step_rad;
  // Beams at whole degrees, as most devices have them, lie in the middle of a bin.
  scan.angle_min_rad = -std::numbers::pi;
  scan.ranges_m.assign(static_cast<std::size_t>(beams), std::numeric_limits<float>::quiet_NaN());
  const double slope = std::tan(slice.elevation_rad);
  for (const Eigen::Vector3f& p : points) {
    const auto range = std::hypot(p.x(), p.y());
    if (std::abs(p.z()) > std::max(slice.height_m, slope * range)) continue;
    const double bearing = std::atan2(p.y(), p.x());
    const auto beam =
        static_cast<int>(std::lround((bearing + std::numbers::pi) / slice.angle_step_rad)) % beams;
    float& nearest = scan.ranges_m[static_cast<std::size_t>(beam)];
    if (!(nearest <= range)) nearest = range;
  }
  return scan;
}

}  // namespace adit
