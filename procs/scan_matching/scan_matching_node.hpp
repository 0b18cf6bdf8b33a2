// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/bus/bus.hpp"
#include "common/bus/sensor_clocks.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "common/sensing/laser_tilt.hpp"
#include "procs/scan_matching/scan_matching.hpp"

namespace adit {

/// In:  LASER_FRONT, LASER_REAR (planar_lidar_t); optional TILT_FRONT, TILT_REAR (tilt_t),
///      WHEEL_ODOMETRY (wheel_odometry_t), IMU (imu_t), CLOUD (cloud_t) and TERRAIN (terrain_t), in
///      fragments.
/// Out: SCAN_MATCH (scan_match_t) for every level scan; MATCH_DOUBT (match_doubt_t) for every
/// motion
///      that may be wrong; POSE (pose_t, T_odom_body) for every scan
///      that is not rejected.
class ScanMatchingNode {
 public:
  using Params = ScanMatchingParams;

  ScanMatchingNode(Bus& bus, const Params& params);

  /// Degraded while scans are lost, no sensor observes a direction that they do not constrain, or
  /// the clock of a sensor is off.
  [[nodiscard]] Health health() const;

 private:
  void on_scan(LaserId laser, const std::string& channel, const LaserScan& scan);
  [[nodiscard]] bool is_level(LaserId laser) const;

  Bus& bus_;
  LevelTilt level_tilt_;
  bool lasers_tilt_;
  ScanMatching scan_matching_;
  SensorClocks clocks_{[this] { scan_matching_.restart_time(); }};
  CloudReassembler clouds_;
  TerrainReassembler terrain_;
  std::map<LaserId, TiltReading> tilt_;
  Health health_;
};

}  // namespace adit
