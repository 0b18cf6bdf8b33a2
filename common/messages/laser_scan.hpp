// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "adit/planar_lidar_t.hpp"

#include "common/messages/result.hpp"
#include "common/sensing/laser_scan.hpp"

namespace adit {

/// Bearings go onto the wire as floats: they come back within 2e-7 rad.
planar_lidar_t to_message(const LaserScan& scan);

/// Why a scan cannot come from a laser, or nothing; what from_message refuses.
std::string_view reason_to_refuse(const LaserScan& scan);

/// Refused: an implausible time, bearings that are not finite, that do not increase, or that go
/// round more than twice. Ranges are passed on as they are. Intensities are not kept.
Result<LaserScan> from_message(const planar_lidar_t& message);

}  // namespace adit
