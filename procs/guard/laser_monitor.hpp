// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/laser_tilt.hpp"
#include "common/types/vehicle.hpp"
#include "procs/guard/input_staleness.hpp"

namespace adit {

/// The points of a scan at the height of obstacles.
struct LaserPoints {
  /// In the body frame, one for each beam in their order; NaN for beams without an obstacle.
  std::vector<Eigen::Vector2d> p_body;
  int returns = 0;  ///< number of beams with a valid range
};

/// Projects a scan into the body frame. A point is ground if it is at most one step above the
/// ground, and roof if it is above the vehicle. Heights are taken both above the plane of the
/// wheels, which is right on a slope, and along `up_body`, which is right while a wheel is on a
/// rail: a point is an obstacle if it is one by both.
LaserPoints project_scan(const LaserScan& scan, const LaserMount& mount, double tilt_rad,
                         const Eigen::Vector3d& up_body, const Vehicle& vehicle);

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
