// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/bus/bus.hpp"
#include "sim/drive/waypoint_driver.hpp"

namespace adit {

/// Adapter of WaypointDriver to a bus. In: TRUTH (pose_t in world). Out: DRIVE_COMMAND
/// (drive_command_t), one for each TRUTH.
class WaypointDriverNode {
 public:
  /// `bus` must outlive this.
  WaypointDriverNode(Bus& bus, WaypointDriver driver);

  [[nodiscard]] const WaypointDriver& driver() const { return driver_; }

 private:
  void drive(const BodyMotion& motion);

  Bus& bus_;
  WaypointDriver driver_;
};

}  // namespace adit
