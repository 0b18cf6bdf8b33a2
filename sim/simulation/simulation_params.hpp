// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/vehicle.hpp"
#include "sim/laser/laser_params.hpp"
#include "sim/laser/tilt_actuator.hpp"
#include "sim/vehicle/vehicle_params.hpp"

namespace adit {

/// Something that goes wrong at a time of the run, on request.
struct FaultDescription {
  /// laser_dies, laser_recovers: `target` is front or rear. time_jump: from then on the clock of
  /// the sensors is `amount` seconds ahead of what it was. packet_loss: from then on this share of
  /// all messages is lost. kill, suspend: the process `adit-<target>` gets SIGKILL or SIGSTOP.
  std::string kind;
  double at_s = 0.0;  ///< after the start of the run
  std::string target;
  double amount = 0.0;

  template <class V>
  void visit(V& v) {
    v("kind", kind,
      OneOf({"laser_dies", "laser_recovers", "time_jump", "packet_loss", "kill", "suspend"}));
    v("at_s", at_s, at_least(0.0));
    v("target", target);
    v("amount", amount);
  }
};

/// The lasers of Groundhog, one at each end.
Lasers groundhog_lasers();

/// Everything about a simulated robot; the section `sim` of the configuration.
struct SimulationParams {
  Lasers lasers = groundhog_lasers();
  Vehicle vehicle;
  LaserParams laser;
  TiltParams tilt;
  VehicleModelParams motion;
  WheelOdometryParams wheel_odometry;
  ImuParams imu;
  std::vector<FaultDescription> faults;

  template <class V>
  void visit(V& v) {
    v.shared(Lasers::kSection, lasers);
    v.shared(Vehicle::kSection, vehicle);
    v("laser", laser);
    v("tilt", tilt);
    v("motion", motion);
    v("wheel_odometry", wheel_odometry);
    v("imu", imu);
    v("faults", faults);
  }
};

}  // namespace adit
