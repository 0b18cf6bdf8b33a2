// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>

#include "common/bus/log/lcm_log.hpp"
#include "tools/carmen/carmen_reader.hpp"

namespace adit {

/// Appends a reading to a log in the form in which a driver publishes it: a scan on LASER_FRONT,
/// wheel odometry on WHEEL_ODOMETRY, with the time of measurement.
void write_reading(LogWriter& log, const LaserScan& scan);
void write_reading(LogWriter& log, const WheelOdometry& odometry);

/// Converts a CARMEN log to an LCM log of this project, in order of time, and reports its contents.
/// `progress` receives the completed fraction after each record. Throws std::runtime_error if a
/// file cannot be read or written, or if the log has no valid reading; in that case no output
/// remains.
CarmenReport import_carmen(const std::filesystem::path& carmen_log,
                           const std::filesystem::path& lcm_log,
                           const std::function<void(double)>& progress);

}  // namespace adit
