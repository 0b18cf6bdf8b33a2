// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "drivers/device/device_protocol.hpp"

#include "common/sensing/laser_scan.hpp"
#include "common/sensing/spinning_lidar.hpp"

namespace adit {

/// The protocol of one laser: scans, each stamped with the time of its first beam.
class LaserDevice : public ReadingDevice<LaserScan> {
 public:
  /// Revolutions of a spinning lidar that are to be published, in order of time; their level views
  /// are among the scans of the same call of receive().
  virtual std::vector<LidarRevolution> take_revolutions() { return {}; }
};

}  // namespace adit
