// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "common/geometry/pose2.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/vehicle_readings.hpp"
#include "tools/log_times/time_choice.hpp"

namespace adit {

/// A FLASER or ROBOTLASER1 line. Times of scan and odometry are the first timestamp of the line,
/// which the publisher of the reading sets, 0 if it is not positive; poses are in the frame of the
/// log.
struct CarmenScan {
  LaserScan scan;
  Pose2 T_log_laser;         ///< laser pose in the line; some public logs contain corrected poses
  WheelOdometry odometry;    ///< pose of the robot at the time of the scan
  RecordedTimes times = {};  ///< both timestamps of the line
};

/// An ODOM line, with the first timestamp.
struct CarmenOdometry {
  WheelOdometry odometry;
  RecordedTimes times;
};

/// An empty line or one of another kind: a comment, a parameter, another sensor.
struct CarmenIgnored {};

/// A malformed line of a supported kind. The reason is one of a few fixed texts.
struct CarmenError {
  std::string_view reason;
  bool scan = false;  ///< a line of a laser
};

using CarmenLine = std::variant<CarmenScan, CarmenOdometry, CarmenIgnored, CarmenError>;

/// Parses one line of a CARMEN log. Malformed lines give CarmenError; the function does not throw.
///   FLASER n r₁…rₙ x y θ  odom_x odom_y odom_θ  time host time
///   ROBOTLASER1 type start fov step range_max accuracy remission_mode n r₁…rₙ m e₁…eₘ
///               laser_x laser_y laser_θ  x y θ  tv rv forward side turn  time host time
///   ODOM x y θ tv rv accel  time host time
/// in metres, radians and seconds. FLASER does not specify the beam angles: they start at −90° and
/// cover 180°, in n steps if n is even and n − 1 steps if n is odd.
CarmenLine parse_carmen_line(std::string_view line);

/// Formats a scan as a FLASER line without line end. Ranges are rounded to 1 cm, the resolution of
/// planar lasers. The format has no beam angles; they must be those above.
std::string flaser_line(const CarmenScan& scan);

}  // namespace adit
