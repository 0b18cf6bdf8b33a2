// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/config/bounds.hpp"
#include "common/vehicle/vehicle.hpp"
#include "procs/driving/lateral_control.hpp"
#include "procs/driving/pose_trust.hpp"
#include "procs/driving/pure_pursuit.hpp"
#include "procs/driving/speed_profile.hpp"

namespace adit {

struct SteeringParams {
  double rate_1_m_s = 0.4;  ///< greatest change of the curvature per second
  double blend_m = 0.5;     ///< way over which a jump of the path's curvature is steered

  template <class V>
  void visit(V& v) {
    v("rate_1_m_s", rate_1_m_s, above(0.0));
    v("blend_m", blend_m, within(0.0, 2.0));
  }
};

struct DrivingParams {
  Vehicle vehicle;
  std::string controller = "pd";  ///< or "pure_pursuit"
  LateralParams pd;
  PursuitParams pure_pursuit;
  SpeedParams speed;
  SteeringParams steering;
  TrustParams trust;
  double smoothing_s = 0.3;       ///< of poses; longer than their noise, shorter than their drift
  double reaction_s = 0.05;       ///< after which a command takes effect
  double arrival_m = 0.02;        ///< left of a run at its end
  double distance_max_m = 0.35;   ///< off the path; beyond, it needs a new one
  double heading_max_rad = 0.5;   ///< against the path, likewise
  double held_max_s = 10.0;       ///< without way; held for longer, likewise
  double unmeasured_max_m = 5.0;  ///< driven without a sensor that tells how far, likewise
  double wheels_apart_m = 0.2;  ///< way by the wheels beside that by the poses, since a path began
  double wheels_apart_share = 0.08;  ///< and so much of the way; beyond, likewise

  template <class V>
  void visit(V& v) {
    v.shared(Vehicle::kSection, vehicle);
    v("controller", controller, OneOf({"pd", "pure_pursuit"}));
    v("pd", pd);
    v("pure_pursuit", pure_pursuit);
    v("speed", speed);
    v("steering", steering);
    v("trust", trust);
    v("smoothing_s", smoothing_s, above_up_to(0.0, 5.0));
    v("reaction_s", reaction_s, within(0.0, 0.5));
    v("arrival_m", arrival_m, within(0.005, 0.5));
    v("distance_max_m", distance_max_m, above_up_to(0.0, 2.0));
    v("heading_max_rad", heading_max_rad, above_up_to(0.0, 1.2));
    v("held_max_s", held_max_s, within(1.0, 600.0));
    v("unmeasured_max_m", unmeasured_max_m, above(0.0));
    v("wheels_apart_m", wheels_apart_m, above(0.0));
    v("wheels_apart_share", wheels_apart_share, within(0.0, 10.0));
  }
};

}  // namespace adit
