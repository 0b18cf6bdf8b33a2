// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tools/check_robot/robot_config.hpp"

namespace adit {

/// What planning lets the robot pass, and how it moves and sees.
struct Abilities {
  double width_min_m = 0.0;   ///< between walls, at creeping speed
  double width_full_m = 0.0;  ///< at full speed
  double height_min_m = 0.0;  ///< below the roof
  double step_max_m = 0.0;    ///< under the wheels
  double bump_max_m = 0.0;    ///< between the wheels
  double slope_max_rad = 0.0;
  double turn_width_m = 0.0;   ///< of a circle driven at the planned radius, with the whole body
  double scan_period_s = 0.0;  ///< of the front laser
  double stopping_m = 0.0;     ///< at full speed, with the margin, by the guard
  double stopping_creep_m = 0.0;
};

Abilities abilities_of(const RobotConfig& robot);

/// The abilities, and where the robot is blind, in sentences with their arithmetic.
std::string text_of_abilities(const RobotConfig& robot);

}  // namespace adit
