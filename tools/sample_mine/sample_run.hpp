// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "common/sensing/laser_scan.hpp"
#include "common/sensing/vehicle_readings.hpp"
#include "tools/eval/trajectory.hpp"
#include "tools/sample_mine/sample_site.hpp"
#include "tools/sample_mine/synthetic_laser.hpp"
#include "tools/sample_mine/synthetic_odometry.hpp"
#include "tools/sample_mine/synthetic_world.hpp"

namespace adit {

/// What one moment of the run gave. The laser sits at the origin of the body.
struct SampleReading {
  WheelOdometry odometry;
  LaserScan scan;
};

/// A robot's drive through a made-up mine, five scans a second. The same site and seed give the
/// same run, of which a shorter one is the beginning.
class SampleRun {
 public:
  explicit SampleRun(std::uint64_t seed, const SyntheticLaserModel& laser = {},
                     double length_max_m = std::numeric_limits<double>::infinity());

  /// At another site than the ring. The seed is that of the noise.
  SampleRun(SampleSite site, std::uint64_t seed, const SyntheticLaserModel& laser = {},
            double length_max_m = std::numeric_limits<double>::infinity());

  /// The readings of the next moment, or nothing at the end.
  std::optional<SampleReading> next();

  /// Where the body truly was, at the time of each scan: T_world_body.
  [[nodiscard]] const Trajectory& truth() const { return truth_; }
  [[nodiscard]] const SyntheticWorld& mine() const { return mine_; }
  [[nodiscard]] double fraction_done() const;

 private:
  SyntheticWorld mine_;
  Trajectory truth_;
  SyntheticLaser laser_;
  SyntheticOdometry odometry_;
  std::size_t next_ = 0;
};

}  // namespace adit
