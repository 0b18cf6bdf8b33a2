// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/vehicle.hpp"
#include "sim/laser/laser_params.hpp"
#include "sim/laser/mount_error_params.hpp"
#include "sim/laser/spinning_lidar_params.hpp"
#include "sim/laser/tilt_actuator.hpp"
#include "sim/vehicle/vehicle_params.hpp"

namespace adit {

/// A fault injected at a time of the run.
struct FaultDescription {
  /// laser_dies, laser_recovers: `target` is front or rear. time_jump: the clock of the sensors
  /// jumps ahead by `amount` seconds. packet_loss: from then on, the fraction `amount` of all
  /// messages is lost. kill, suspend: the process `adit-<target>` receives SIGKILL or SIGSTOP.
  std::string kind;
  double at_s = 0.0;  ///< after the start of the run
  std::string target;
  double amount = 0.0;

  template <class V>
  void visit(V& v) {
    v("kind", kind,
      OneOf({"laser_dies", "laser_recovers", "time_jump", "packet_loss", "kill", "suspend"}));
    v("at_s", at_s, within(0.0, 1e9));
    v("target", target);
    v("amount", amount, within(-1e9, 1e9));
  }
};

/// The lasers of Groundhog, one at each end.
inline Lasers groundhog_lasers() {
  LaserMount front;
  front.T_body_laser = {1.05, 0.0, 0.0};
  front.height_m = 0.62;
  front.lever_x_m = 0.06;
  front.lever_z_m = 0.08;
  front.range_min_m = 0.2;
  front.range_max_m = 80.0;  // no return reads 81.91 m
  LaserMount rear = front;
  rear.T_body_laser = {-1.05, 0.0, std::numbers::pi};
  return {front, rear};
}

/// All parameters of a simulated robot: the section `sim` of the configuration.
struct SimulationParams {
  Lasers lasers = groundhog_lasers();
  Vehicle vehicle;
  LaserParams laser;
  SpinningLidarParams lidar;  ///< if lasers.lidar is present
  TiltParams tilt;
  MountErrorParams front_mount_error;
  VehicleModelParams motion;
  WheelOdometryParams wheel_odometry;
  ImuParams imu;
  std::vector<FaultDescription> faults;
  int noise_seed = -1;                ///< of the errors of all sensors; −1: the seed of the world
  double record_free_min_mb = 500.0;  ///< on its disk, below which a recording stops

  template <class V>
  void visit(V& v) {
    v.shared(Lasers::kSection, lasers);
    v.shared(Vehicle::kSection, vehicle);
    v("laser", laser);
    v("lidar", lidar);
    v("tilt", tilt);
    v("front_mount_error", front_mount_error);
    v("motion", motion);
    v("wheel_odometry", wheel_odometry);
    v("imu", imu);
    v("faults", faults);
    v("noise_seed", noise_seed, at_least(-1));
    v("record_free_min_mb", record_free_min_mb, at_least(0.0));
  }
};

}  // namespace adit
