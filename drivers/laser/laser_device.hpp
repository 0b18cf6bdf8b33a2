// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drivers/device/device_protocol.hpp"

#include "common/sensing/laser_scan.hpp"

namespace adit {

/// The protocol of one laser: scans, each stamped with the time of its first beam.
using LaserDevice = ReadingDevice<LaserScan>;

}  // namespace adit
