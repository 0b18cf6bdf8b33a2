// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <variant>
#include <vector>

#include "common/sensing/laser_scan.hpp"
#include "common/sensing/wheel_odometry.hpp"
#include "tools/sample_mine/synthetic_laser.hpp"

namespace adit {

/// What a log holds, in memory, so that a benchmark reads nothing while it measures.
using Readings = std::vector<std::variant<WheelOdometry, LaserScan>>;

/// The whole drive through the sample mine.
Readings sample_readings(const SyntheticLaserModel& laser);
/// A CARMEN log.
Readings recorded_readings(const std::filesystem::path& path);

}  // namespace adit
