// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "tools/check_driver/check_result.hpp"
#include "tools/check_robot/robot_config.hpp"

namespace adit {

/// Whether the relations between the keys of a robot hold, each with its arithmetic; a bad one says
/// what to correct. Last, what the stages themselves reject.
CheckResults check_robot(const RobotConfig& given);

/// The robot with the rectangle of its length and width in place of a footprint that body_outline()
/// rejects: the rest of it can be checked and drawn.
RobotConfig with_usable_footprint(RobotConfig robot);

inline constexpr double kRoundingM = 1e-6;  ///< of sums of lengths that are equal

/// Adds a result: `arithmetic` in any case, and `remedy` if the relation does not hold.
void add_relation(CheckResults& results, bool holds, std::string_view property,
                  const std::string& arithmetic, std::string_view remedy);

/// Dimensions and limits of the body, its wheels and its steering.
void check_body(const RobotConfig& robot, CheckResults& results);
/// Poses, fields of view and ranges of the lasers, and the sweep of a tilting one.
void check_lasers(const RobotConfig& robot, CheckResults& results);
/// The level view of a spinning lidar, and what its rings show of the ground.
void check_lidar(const RobotConfig& robot, CheckResults& results);
/// Speeds, braking, and limits that must be reached in order: first mission, then guard.
void check_motion(const RobotConfig& robot, CheckResults& results);

/// All results as text, one line each, and a line with the verdict on `name`.
std::string text_of_robot(std::string_view name, const CheckResults& results);

}  // namespace adit
