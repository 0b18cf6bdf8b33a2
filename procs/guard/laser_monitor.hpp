// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/laser_tilt.hpp"
#include "common/sensing/obstacle_points.hpp"
#include "common/types/vehicle.hpp"
#include "procs/guard/input_staleness.hpp"

namespace adit {

/// The newest scan of a laser, and whether it can be relied on. Times are in MonotonicTime. A laser
/// without tilt readings is level.
class LaserMonitor {
 public:
  /// A laser with fewer returns counts as blind, such as one with a covered window.
  static constexpr int kReturnsMin = 10;

  /// `name` is used in reasons: "laser front".
  LaserMonitor(std::string name, const LaserMount& mount) : name_(std::move(name)), mount_(mount) {}

  void receive(const TiltReading& reading, std::int64_t at_us);
  /// False for a scan older than the newest.
  bool receive(const LaserScan& scan, std::int64_t at_us, const Eigen::Vector3d& up_body,
               const Vehicle& vehicle);

  /// Why the laser cannot be relied on: its scans are stale, it is blind, or its tilt is stale.
  [[nodiscard]] std::optional<std::string> fault(std::int64_t now_us, double timeout_s) const;

  /// The points of the newest scan, and its age [s].
  [[nodiscard]] const LaserPoints& points() const { return points_; }
  [[nodiscard]] std::optional<double> age_s(std::int64_t now_us) const {
    return scan_.age_s(now_us);
  }

 private:
  std::string name_;
  LaserMount mount_;
  LastReceived scan_;
  LastReceived tilt_;
  double tilt_rad_ = 0.0;
  LaserPoints points_;
};

}  // namespace adit
