// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/config/bounds.hpp"

namespace adit {

/// A corner of the outline of the vehicle from above, in the body frame.
struct FootprintCorner {
  double x_m = 0.0;
  double y_m = 0.0;

  template <class V>
  void visit(V& v) {
    v("x_m", x_m);
    v("y_m", y_m);
  }
};

/// Dimensions and limits of the vehicle. The body's origin is the middle of the vehicle on the
/// ground. Defaults are those of Groundhog, where known (docs/decisions/simulator.md).
struct Vehicle {
  static constexpr const char* kSection = "vehicle";

  double mass_kg = 680.0;
  double length_m = 2.4;  ///< of the footprint, along x
  double width_m = 1.2;   ///< of the footprint, along y
  /// Corners of the footprint where it is no rectangle: see body_outline().
  std::vector<FootprintCorner> footprint = {};
  double height_m = 1.0;           ///< of the highest point above the ground
  double belly_clearance_m = 0.3;  ///< of the lowest point between the wheels above the ground
  double wheelbase_m = 1.5;        ///< axle to axle, centred on the origin
  double track_m = 0.95;           ///< wheel centre to wheel centre
  double wheel_radius_m = 0.3;
  double wheel_width_m = 0.25;
  std::string steering = "four_wheel";  ///< or "ackermann": the front wheels only; or "skid"
  double turning_radius_m = 1.6;        ///< minimum radius of the path of the body's origin
  double speed_max_m_s = 0.5;           ///< forward and in reverse
  double step_max_m = 0.2;              ///< highest step that a wheel can climb
  double sinkage_max_m = 0.2;           ///< up to which the wheels still turn
  double wading_depth_max_m = 0.25;     ///< of water without damage
  double tilt_max_rad = 0.5;            ///< maximum roll or pitch without tipping over

  /// Whether it drives with its rear end ahead as with its front end.
  [[nodiscard]] bool is_symmetric() const { return steering != "ackermann"; }

  template <class V>
  void visit(V& v) {
    v("mass_kg", mass_kg, above(0.0));
    v("length_m", length_m, above(0.0));
    v("width_m", width_m, above(0.0));
    v("footprint", footprint);
    v("height_m", height_m, above(0.0));
    v("belly_clearance_m", belly_clearance_m, above(0.0));
    v("wheelbase_m", wheelbase_m, above(0.0));
    v("track_m", track_m, above(0.0));
    v("wheel_radius_m", wheel_radius_m, above(0.0));
    v("wheel_width_m", wheel_width_m, above(0.0));
    v("steering", steering, OneOf({"four_wheel", "ackermann", "skid"}));
    v("turning_radius_m", turning_radius_m, above(0.0));
    v("speed_max_m_s", speed_max_m_s, above(0.0));
    v("step_max_m", step_max_m, above(0.0));
    v("sinkage_max_m", sinkage_max_m, above(0.0));
    v("wading_depth_max_m", wading_depth_max_m, at_least(0.0));
    v("tilt_max_rad", tilt_max_rad, above(0.0));
  }
};

}  // namespace adit
