// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "common/sensing/laser_scan.hpp"
#include "common/sensing/vehicle_readings.hpp"
#include "sim/drive/waypoint_driver.hpp"
#include "sim/simulation/simulation.hpp"
#include "sim/world/world.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// A simulated drive through a built-in world, reduced to one level laser and wheel odometry.
struct SampleParams {
  std::string world = "sample";  ///< a built-in world that has a drive (sim/worlds/*_drive.txt)
  int seed = 1;                  ///< of the walls and of all noise
  int beams = 181;               ///< 181 at 1°, or 361 at 0.5°
  double bearing_scale = 1.0;    ///< LaserParams::bearing_scale
  /// WheelOdometryParams::turn_bias_rad_per_m; that of the world without.
  std::optional<double> turn_bias_rad_per_m = {};
  double length_max_m = std::numeric_limits<double>::infinity();  ///< the drive ends there
};

/// A scan, and the odometry interpolated at its time. The laser is at the origin of the body.
struct SampleReading {
  WheelOdometry odometry;
  LaserScan scan;
};

/// Steps the simulator along the drive of a world, a scan each 0.16 m (0.1 m in the world `grid`)
/// at full speed. The same parameters give the same run; a shorter run is the beginning of a longer
/// one.
class SampleRun {
 public:
  /// Throws std::runtime_error for a world without a drive.
  explicit SampleRun(const SampleParams& params = {});

  /// The next scan, or nothing at the end of the drive. Throws std::runtime_error where the vehicle
  /// collides or the driver aborts.
  std::optional<SampleReading> next();

  /// T_world_body at the time of each scan so far.
  [[nodiscard]] const Trajectory& truth() const { return truth_; }
  [[nodiscard]] double fraction_done() const;

 private:
  void step();

  double length_max_m_;
  std::unique_ptr<const Site> site_;
  Simulation simulation_;
  WaypointDriver driver_;
  Trajectory motion_;              ///< T_world_body, the newest steps
  Trajectory wheel_odometry_;      ///< T_wheel_body, the newest readings
  std::optional<LaserScan> scan_;  ///< waits for the odometry at its time
  Trajectory truth_;
  double length_m_ = 0.0;  ///< of truth_
  bool ended_ = false;
};

/// Writes the rest of a run as an LCM log (.lcmlog) or as CARMEN text (.log), by the extension of
/// the path. Both poses of a CARMEN line are the odometry. `progress` is called with the fraction
/// that is done, 0 to 1. Throws std::runtime_error if the file cannot be written or has another
/// extension.
void write_sample_log(
    SampleRun& run, const std::filesystem::path& path,
    const std::function<void(double)>& progress = [](double) {});

}  // namespace adit
