// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include <fmt/format.h>

#include "tools/check_robot/robot_check.hpp"

namespace adit {
namespace {

constexpr double kRounding = 1e-9;

struct Side {
  std::string key;
  double value;
};

/// Checks `low <= high`.
void check_order(CheckResults& results, const char* property, const Side& low, const Side& high,
                 const char* remedy) {
  const bool holds = low.value <= high.value + kRounding;
  add_relation(results, holds, property,
               fmt::format("{} = {:.5g} {} {} = {:.5g}", low.key, low.value, holds ? "<=" : ">",
                           high.key, high.value),
               remedy);
}

/// The robot must turn home before the guard stops it.
void check_limits(const RobotConfig& robot, CheckResults& results) {
  constexpr const char* kFirst =
      "the mission must turn around before the guard stops the robot for good";
  const MissionLimitsParams& mission = robot.mission.limits;
  const AirParams& air = robot.guard.air;
  check_order(results, "limits", {"mission.limits.methane_max_share", mission.methane_max_share},
              {"guard.air.methane_max_share", air.methane_max_share}, kFirst);
  check_order(results, "limits", {"guard.air.oxygen_min_share", air.oxygen_min_share},
              {"mission.limits.oxygen_min_share", mission.oxygen_min_share}, kFirst);
  check_order(results, "limits",
              {"mission.limits.carbon_monoxide_max_share", mission.carbon_monoxide_max_share},
              {"guard.air.carbon_monoxide_max_share", air.carbon_monoxide_max_share}, kFirst);
  check_order(results, "limits", {"mission.limits.sinkage_max_m", mission.sinkage_max_m},
              {"guard.sinkage_share vehicle.sinkage_max_m",
               robot.guard.sinkage_share * robot.vehicle.sinkage_max_m},
              kFirst);
}

}  // namespace

void check_motion(const RobotConfig& robot, CheckResults& results) {
  const SpeedParams& speed = robot.driving.speed;
  check_order(results, "motion", {"driving.speed.speed_m_s", speed.speed_m_s},
              {"vehicle.speed_max_m_s", robot.vehicle.speed_max_m_s},
              "the vehicle cannot follow, and paths take longer than planned");
  check_order(results, "motion", {"driving.speed.creep_m_s", speed.creep_m_s},
              {"driving.speed.speed_m_s", speed.speed_m_s}, "creeping is the slowest motion");
  check_order(results, "motion", {"driving.speed.braking_m_s2", speed.braking_m_s2},
              {"guard.obstacle.braking_m_s2", robot.guard.obstacle.braking_m_s2},
              "driving would brake later than the guard permits, which then stops it");
  if (robot.has_sim) {
    check_order(results, "motion",
                {"guard.obstacle.braking_m_s2", robot.guard.obstacle.braking_m_s2},
                {"sim.motion.braking_m_s2", robot.sim.motion.braking_m_s2},
                "the guard relies on more than the vehicle can");
    check_order(results, "motion",
                {"driving.steering.rate_1_m_s", robot.driving.steering.rate_1_m_s},
                {"sim.motion.steering_rate_1_m_s", robot.sim.motion.steering_rate_1_m_s},
                "the vehicle steers slower than it is commanded, and leaves its path");
  }
  check_order(
      results, "motion",
      {"planning.c_space.ground.slope_max_rad", robot.planning.c_space.ground.slope_max_rad},
      {"vehicle.tilt_max_rad - guard.tilt_margin_rad",
       robot.vehicle.tilt_max_rad - robot.guard.tilt_margin_rad},
      "paths lead where the guard stops the robot; reduce slope_max_rad");
  check_limits(robot, results);
}

}  // namespace adit
