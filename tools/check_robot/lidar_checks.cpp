// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "common/sensing/level_view.hpp"
#include "tools/check_robot/abilities.hpp"
#include "tools/check_robot/field_of_view.hpp"
#include "tools/check_robot/lidar_ground.hpp"
#include "tools/check_robot/robot_check.hpp"

namespace adit {
namespace {

constexpr double kScanPeriodMaxS = 0.1;
constexpr double kReachUsefulM = 1.5;  // of ground that is seen before the body

void check_ground(const RobotConfig& robot, CheckResults& results) {
  const auto ahead =
      lidar_ground(robot.lasers, robot.sim.lidar, 0.0, robot.terrain.unseen.gap_max_m);
  const double nose_m = 0.5 * robot.vehicle.length_m - robot.lasers.front.T_body_laser.x;
  const double from_m = ahead ? ahead->from_m - nose_m : std::numeric_limits<double>::infinity();
  const double to_m = ahead ? ahead->to_m - nose_m : 0.0;
  const double assumed_m = robot.planning.c_space.ground.blind_ahead_m;
  add_relation(
      results, from_m <= assumed_m, "lidar",
      fmt::format("the lowest ring meets level ground {:.2f} m before the body, "
                  "planning.c_space.ground.blind_ahead_m = {}",
                  from_m, assumed_m),
      "the ground between is never seen, and no path begins there; pitch the lidar down or "
      "mount it lower or farther ahead");
  add_relation(results, to_m - assumed_m >= kReachUsefulM, "lidar",
               fmt::format("rings at most terrain.unseen.gap_max_m = {} apart up to {:.2f} m "
                           "before the body",
                           robot.terrain.unseen.gap_max_m, to_m),
               "paths end where the ground between two rings is unknown; mount the lidar higher or "
               "pitch it down");
}

}  // namespace

void check_lidar(const RobotConfig& robot, CheckResults& results) {
  const Lasers& lasers = robot.lasers;
  add_relation(results, lasers.count == 1, "lidar",
               fmt::format("lasers.count = {} with lasers.lidar.present", lasers.count),
               "a spinning lidar takes the place of all lasers: state count: 1");
  add_relation(results, std::abs(lasers.front.field_of_view_rad - 2.0 * std::numbers::pi) < 0.05,
               "lidar",
               fmt::format("lasers.front.field_of_view_rad = {} of its level view",
                           lasers.front.field_of_view_rad),
               "it looks all around: 6.283185307179586");
  add_relation(results, looks_over_body(lasers.front, robot.vehicle), "lidar",
               fmt::format("lasers.front.height_m = {} looks over the body, vehicle.height_m = {}",
                           lasers.front.height_m, robot.vehicle.height_m),
               "it is taken to see what is behind the body as well");
  const int blind = LevelView(lasers).beams_without_ring(robot.sim.lidar.revolution(1.0).rings);
  add_relation(results, blind == 0, "lidar",
               fmt::format("{} of {} beams of the level view lie between two rings, with "
                           "lasers.lidar.pitch_rad = {}",
                           lasers.lidar.level_beams - blind, lasers.lidar.level_beams,
                           lasers.lidar.pitch_rad),
               "no ring looks level there: pitch it less than its lowest ring looks down, and "
               "describe its rings in sim.lidar");
  const double period_s = 1.0 / lasers.front.timing.mirror_hz;
  add_relation(results, period_s < kScanPeriodMaxS, "lidar",
               fmt::format("a revolution takes {:.3f} s at lasers.front.timing.mirror_hz = {}",
                           period_s, lasers.front.timing.mirror_hz),
               "poses and scans are too old for driving and guard; let it turn at 20 Hz");
  const double nose_m = 0.5 * robot.vehicle.length_m - lasers.front.T_body_laser.x;
  const double stops_m = nose_m + abilities_of(robot).stopping_m;
  add_relation(results, stops_m <= LevelView::kObstacleReachM, "lidar",
               fmt::format("the robot stops within {:.2f} m of the lidar at "
                           "driving.speed.speed_m_s = {}, and its level view shows obstacles that "
                           "are no walls up to {} m",
                           stops_m, robot.driving.speed.speed_m_s, LevelView::kObstacleReachM),
               "it would see the face of a heap too late: drive slower");
  check_ground(robot, results);
  add_relation(results, !robot.scan_matching.lasers_tilt, "lidar",
               fmt::format("scan_matching.lasers_tilt: {}", robot.scan_matching.lasers_tilt),
               "nothing tilts: scans would be ignored until a TILT message arrives");
}

}  // namespace adit
