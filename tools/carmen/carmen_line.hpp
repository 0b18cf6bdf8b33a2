// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "common/geometry/pose2.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/vehicle_readings.hpp"

namespace adit {

/// A FLASER or ROBOTLASER1 line. Times are those of the log's first stamp (that of the process
/// that published the reading); poses are in the frame that the log was written in.
struct CarmenScan {
  LaserScan scan;
  Pose2 T_log_laser;       ///< what the line says of the laser; corrected by somebody, in some logs
  WheelOdometry odometry;  ///< of the robot, at the time of the scan
};

/// A line of another kind (a comment, a parameter, another sensor) or an empty one.
struct CarmenIgnored {};

/// A line of a kind that is read here, but wrong. The reason is one of a few fixed texts.
struct CarmenError {
  std::string_view reason;
};

using CarmenLine = std::variant<CarmenScan, WheelOdometry, CarmenIgnored, CarmenError>;

/// Reads one line of a CARMEN log, whatever it holds; it never throws on bad contents.
///   FLASER n r₁…rₙ x y θ  odom_x odom_y odom_θ  time host time
///   ROBOTLASER1 type start fov step range_max accuracy remission_mode n r₁…rₙ m e₁…eₘ
///               laser_x laser_y laser_θ  x y θ  tv rv forward side turn  time host time
///   ODOM x y θ tv rv accel  time host time
/// in metres, radians and seconds. FLASER says nothing of its angles: they are a half circle that
/// starts at −90°, of n steps of 180°/n where n is even and n − 1 steps where n is odd.
CarmenLine parse_carmen_line(std::string_view line);

/// A scan as a FLASER line, without the end of the line. Ranges are written to the centimetre,
/// which is what planar lasers resolve; the angles are not written, and are the reader's half
/// circle.
std::string flaser_line(const CarmenScan& scan);

}  // namespace adit
