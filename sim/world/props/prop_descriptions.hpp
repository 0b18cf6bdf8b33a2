// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/config/bounds.hpp"

namespace adit {

// Objects and hazards in a mine. Positions along a tunnel are distances from its first point;
// positions across it are to the left of its centre line [m]. The bounds are wide for a mine and
// prevent a typing error from becoming millions of posts or triangles.

/// Two rails on sleepers, along the centre line of a section of a tunnel.
struct RailsDescription {
  std::string tunnel;
  double from_m = 0.0;
  double to_m = 0.0;
  double across_m = 0.0;
  double gauge_m = 0.6;   ///< between the rails; fits between the wheels of Groundhog
  double height_m = 0.1;  ///< of their top above the floor
  double sleeper_every_m = 0.7;

  template <class V>
  void visit(V& v) {
    v("tunnel", tunnel);
    v("from_m", from_m);
    v("to_m", to_m);
    v("across_m", across_m, within(-50.0, 50.0));
    v("gauge_m", gauge_m, within(0.1, 5.0));
    v("height_m", height_m, within(0.01, 1.0));
    v("sleeper_every_m", sleeper_every_m, above(0.1));
  }
};

/// Timber posts from floor to roof: one at `from_m`, or a row up to `to_m`.
struct PostsDescription {
  std::string tunnel;
  double from_m = 0.0;
  double to_m = 0.0;
  double every_m = 3.0;
  double across_m = 1.2;
  bool both_sides = false;  ///< at −across_m as well
  double radius_m = 0.1;
  double lean_rad = 0.03;  ///< maximum random lean

  template <class V>
  void visit(V& v) {
    v("tunnel", tunnel);
    v("from_m", from_m);
    v("to_m", to_m);
    v("every_m", every_m, at_least(0.3));
    v("across_m", across_m, within(-50.0, 50.0));
    v("both_sides", both_sides);
    v("radius_m", radius_m, within(0.01, 5.0));
    v("lean_rad", lean_rad, within(0.0, 0.5));
  }
};

/// A stack of crossed timbers from floor to roof.
struct CribDescription {
  std::string tunnel;
  double at_m = 0.0;
  double across_m = 0.0;
  double side_m = 0.9;

  template <class V>
  void visit(V& v) {
    v("tunnel", tunnel);
    v("at_m", at_m);
    v("across_m", across_m, within(-50.0, 50.0));
    v("side_m", side_m, above_up_to(0.1, 20.0));
  }
};

/// A roof fall: a cone of rubble with stones on it, and a cavity in the roof above.
struct RubbleDescription {
  std::string tunnel;
  double at_m = 0.0;
  double across_m = 0.0;
  double radius_m = 1.2;
  double height_m = 0.6;

  template <class V>
  void visit(V& v) {
    v("tunnel", tunnel);
    v("at_m", at_m);
    v("across_m", across_m, within(-50.0, 50.0));
    v("radius_m", radius_m, within(0.05, 20.0));
    v("height_m", height_m, within(0.05, 20.0));
  }
};

/// A broken beam, one end at the roof and one on the floor, slanting across the tunnel, with roof
/// cables pulled down beside it.
struct BeamDescription {
  std::string tunnel;
  double at_m = 0.0;
  double thickness_m = 0.25;
  double yaw_rad = 0.3;     ///< of the beam, relative to the normal of the tunnel
  double high_end_m = 1.6;  ///< of its upper end above the floor
  int cables = 2;
  double cable_diameter_m = 0.03;
  double cable_sag_m = 0.9;  ///< distance of the middle of a cable below the roof

  template <class V>
  void visit(V& v) {
    v("tunnel", tunnel);
    v("at_m", at_m);
    v("thickness_m", thickness_m, within(0.01, 5.0));
    v("yaw_rad", yaw_rad, within(-1.5, 1.5));
    v("high_end_m", high_end_m, above_up_to(0.0, 50.0));
    v("cables", cables, within(0, 8));
    v("cable_diameter_m", cable_diameter_m, within(0.001, 1.0));
    v("cable_sag_m", cable_sag_m, within(0.0, 50.0));
  }
};

/// An abandoned mine car.
struct CarDescription {
  std::string tunnel;
  double at_m = 0.0;
  double across_m = 0.0;
  double length_m = 2.2;
  double width_m = 1.1;
  double height_m = 0.9;

  template <class V>
  void visit(V& v) {
    v("tunnel", tunnel);
    v("at_m", at_m);
    v("across_m", across_m, within(-50.0, 50.0));
    v("length_m", length_m, within(0.1, 50.0));
    v("width_m", width_m, within(0.1, 20.0));
    v("height_m", height_m, within(0.1, 20.0));
  }
};

/// A section with the roof only `clearance_m` above the floor.
struct LowRoofDescription {
  std::string name;
  std::string tunnel;
  double from_m = 0.0;
  double to_m = 0.0;
  double clearance_m = 0.8;

  template <class V>
  void visit(V& v) {
    v("name", name);
    v("tunnel", tunnel);
    v("from_m", from_m);
    v("to_m", to_m);
    v("clearance_m", clearance_m, above_up_to(0.1, 50.0));
  }
};

/// A hole in the floor with steep sides.
struct PitDescription {
  std::string name;
  std::string tunnel;
  double at_m = 0.0;
  double across_m = 0.0;
  double radius_m = 0.8;
  double depth_m = 1.0;

  template <class V>
  void visit(V& v) {
    v("name", name);
    v("tunnel", tunnel);
    v("at_m", at_m);
    v("across_m", across_m, within(-50.0, 50.0));
    v("radius_m", radius_m, within(0.05, 50.0));
    v("depth_m", depth_m, above_up_to(0.0, 50.0));
  }
};

/// Standing water in a section of a tunnel, over its full width.
struct WaterDescription {
  std::string name;
  std::string tunnel;
  double from_m = 0.0;
  double to_m = 0.0;
  double depth_m =
      0.5;              ///< in the middle of the stretch; the floor is lowered for it towards there
  bool mirror = false;  ///< whether the surface reflects a laser to the roof, or gives no return

  template <class V>
  void visit(V& v) {
    v("name", name);
    v("tunnel", tunnel);
    v("from_m", from_m);
    v("to_m", to_m);
    v("depth_m", depth_m, above_up_to(0.0, 50.0));
    v("mirror", mirror);
  }
};

/// Ground into which wheels sink.
struct MudDescription {
  std::string name;
  std::string tunnel;
  double at_m = 0.0;
  double across_m = 0.0;
  double radius_m = 2.0;
  double depth_m = 0.15;  ///< sinkage of a wheel in the centre

  template <class V>
  void visit(V& v) {
    v("name", name);
    v("tunnel", tunnel);
    v("at_m", at_m);
    v("across_m", across_m, within(-50.0, 50.0));
    v("radius_m", radius_m, within(0.05, 50.0));
    v("depth_m", depth_m, above_up_to(0.0, 5.0));
  }
};

/// A pocket of gas.
struct GasDescription {
  std::string name;
  std::string tunnel;
  double at_m = 0.0;
  double radius_m = 5.0;        ///< one standard deviation
  double methane_share = 0.02;  ///< fraction of the air in the centre

  template <class V>
  void visit(V& v) {
    v("name", name);
    v("tunnel", tunnel);
    v("at_m", at_m);
    v("radius_m", radius_m, within(0.05, 1000.0));
    v("methane_share", methane_share, within(0.0, 1.0));
  }
};

/// All props of a world.
struct PropDescriptions {
  std::vector<RailsDescription> rails;
  std::vector<PostsDescription> posts;
  std::vector<CribDescription> cribs;
  std::vector<RubbleDescription> rubble;
  std::vector<BeamDescription> beams;
  std::vector<CarDescription> cars;
  std::vector<LowRoofDescription> low_roofs;
  std::vector<PitDescription> pits;
  std::vector<WaterDescription> water;
  std::vector<MudDescription> mud;
  std::vector<GasDescription> gas;

  template <class V>
  void visit(V& v) {
    v("rails", rails);
    v("posts", posts);
    v("cribs", cribs);
    v("rubble", rubble);
    v("beams", beams);
    v("cars", cars);
    v("low_roofs", low_roofs);
    v("pits", pits);
    v("water", water);
    v("mud", mud);
    v("gas", gas);
  }
};

}  // namespace adit
