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

/// What a scan says of things that the vehicle would run into.
struct LaserPoints {
  /// In the body frame, one for each beam, in their order; NaN where there is nothing to run into.
  std::vector<Eigen::Vector2d> p_body;
  int returns = 0;  ///< beams that came back at all, with a range that is to be believed
};

/// Places a scan on the body. What is at most one step above the ground is ground, and what is
/// above the highest point of the vehicle is roof, by the plane under its wheels or by that which
/// is level
/// (`up_body`): the first is right on a slope, the second while a wheel is on a rail. Where both
/// allow it, a point is an obstacle.
LaserPoints project_scan(const LaserScan& scan, const LaserMount& mount, double tilt_rad,
                         const Eigen::Vector3d& up_body, const Vehicle& vehicle);

/// What one laser says, and whether it still does. All times are by MonotonicTime. A laser whose
/// tilt was never heard is level.
class LaserMonitor {
 public:
  /// A scan with fewer returns says nothing, as that of a laser whose window is covered.
  static constexpr int kReturnsMin = 10;

  /// `name` is for people, "laser front".
  LaserMonitor(std::string name, const LaserMount& mount) : name_(std::move(name)), mount_(mount) {}

  void receive(const TiltReading& reading, std::int64_t at_us);
  /// False for a scan that is older than the last.
  bool receive(const LaserScan& scan, std::int64_t at_us, const Eigen::Vector3d& up_body,
               const Vehicle& vehicle);

  /// Why it is not to be relied on: silent, blind, or its tilt is not known any more.
  [[nodiscard]] std::optional<std::string> fault(std::int64_t now_us, double timeout_s) const;

  /// The newest, and how old they are [s].
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
