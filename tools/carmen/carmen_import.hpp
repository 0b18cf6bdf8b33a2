// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>

#include "common/bus/log/lcm_log.hpp"
#include "tools/carmen/carmen_reader.hpp"

namespace adit {

/// Appends a reading to a log as the driver would have published it: a scan on LASER_FRONT, wheel
/// odometry on WHEEL_ODOMETRY, both with their time of measurement.
void write_reading(LogWriter& log, const LaserScan& scan);
void write_reading(LogWriter& log, const WheelOdometry& odometry);

/// Turns a CARMEN log into an LCM log of this project and says what was in it. `progress` is called
/// now and then with the share that is done. Throws std::runtime_error if a file cannot be read or
/// written, or if there is no reading in the log; then no log is left behind.
CarmenReport import_carmen(const std::filesystem::path& carmen_log,
                           const std::filesystem::path& lcm_log,
                           const std::function<void(double)>& progress);

}  // namespace adit
