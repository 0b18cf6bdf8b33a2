// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/bounds.hpp"
#include "common/sensing/attitude_filter.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/vehicle.hpp"
#include "procs/guard/limit_checks.hpp"
#include "procs/guard/obstacle_check.hpp"

namespace adit {

/// The section `guard` of the configuration. No timeout can be disabled: all are positive and
/// bounded.
struct GuardParams {
  Lasers lasers;
  Vehicle vehicle;
  double timeout_s = 0.25;      ///< of lasers, tilts, pose, commands and the IMU
  double slow_timeout_s = 1.5;  ///< of gas and sinkage, published at 2 Hz or more
  double supervisor_timeout_s = 3.0;
  bool require_supervisor = false;  ///< also before its first heartbeat
  double hold_s = 0.5;              ///< time without a reason before the release
  double tilt_margin_rad = 0.1;     ///< below Vehicle::tilt_max_rad
  double sinkage_share = 0.75;      ///< of Vehicle::sinkage_max_m
  ObstacleParams obstacle;
  AirParams air;
  AttitudeFilterParams attitude;

  template <class V>
  void visit(V& v) {
    v.shared(Lasers::kSection, lasers);
    v.shared(Vehicle::kSection, vehicle);
    v("timeout_s", timeout_s, above_up_to(0.0, 1.0));
    v("slow_timeout_s", slow_timeout_s, above_up_to(0.0, 10.0));
    v("supervisor_timeout_s", supervisor_timeout_s, above_up_to(0.0, 60.0));
    v("require_supervisor", require_supervisor);
    v("hold_s", hold_s, within(0.1, 60.0));
    v("tilt_margin_rad", tilt_margin_rad, at_least(0.0));
    v("sinkage_share", sinkage_share, above_up_to(0.0, 1.0));
    v("obstacle", obstacle);
    v("air", air);
    v("attitude", attitude);
  }
};

}  // namespace adit
