// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "common/sensing/laser_scan.hpp"
#include "tools/check_driver/check_result.hpp"

namespace adit {

/// Checks frame, beams, ranges, repetition and the order of beams of the scans of one laser; there
/// is at least one. `range_max_m`: of the configuration.
CheckResults check_scans(const std::vector<LaserScan>& scans, double range_max_m);

/// Rotation of the vehicle about its z axis by another sensor: angle at a time [rad, µs], in order.
using YawHistory = std::vector<std::pair<std::int64_t, double>>;

/// Checks that scans turn as the vehicle does: an object that is seen at a bearing moves to smaller
/// ones when the vehicle turns left. Beams in clockwise order turn against it. Unknown unless the
/// vehicle turned.
CheckResult check_turn(const std::vector<LaserScan>& scans, const YawHistory& yaw);

}  // namespace adit
