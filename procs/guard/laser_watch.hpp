// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/tilt_reading.hpp"
#include "common/vehicle/vehicle.hpp"
#include "procs/guard/laser_points.hpp"
#include "procs/guard/last_heard.hpp"

namespace adit {

/// What one laser says, and whether it still does. All times are by SteadyTime. A laser whose tilt
/// was never heard is level.
class LaserWatch {
 public:
  /// A scan with fewer returns says nothing, as that of a laser whose window is covered.
  static constexpr int kReturnsMin = 10;

  /// `name` is for people, "laser front".
  LaserWatch(std::string name, const LaserMount& mount) : name_(std::move(name)), mount_(mount) {}

  void hear(const TiltReading& reading, std::int64_t at_us);
  /// False for a scan that is older than the last.
  bool hear(const LaserScan& scan, std::int64_t at_us, const Eigen::Vector3d& up_body,
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
  LastHeard scan_;
  LastHeard tilt_;
  double tilt_rad_ = 0.0;
  LaserPoints points_;
};

}  // namespace adit
