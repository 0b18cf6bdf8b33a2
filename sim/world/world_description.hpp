// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "sim/world/props/prop_descriptions.hpp"

namespace adit {

/// A tunnel along a polyline. Tunnels of one level are one open space where they meet in plan.
/// Those of two levels pass above each other, and meet only where an end of one is an end of the
/// other, in line and with the same width (LevelPlan).
struct TunnelDescription {
  std::string name;
  std::vector<double> points_m;  ///< x, y, x, y, .. of its centre line, in world
  double width_m = 3.0;
  bool entrance = false;  ///< the first point is open to the outside
  /// s, z, s, z, .. : height of its floor above that of `heights` at distance s along its centre
  /// line, ascending in s, constant beyond the ends. Empty: 0. Where tunnels meet, the floor passes
  /// from the one to the other over half of their widths.
  std::vector<double> rise_m = {};
  std::string rise_grade = "smooth";  ///< between the points of rise_m: smooth, or sudden (linear)
  int level = 0;                      ///< a number; heights follow from rise_m

  template <class V>
  void visit(V& v) {
    v("name", name);
    v("points_m", points_m);
    v("width_m", width_m, above_up_to(0.0, 50.0));
    v("entrance", entrance);
    v("rise_m", rise_m);
    v("rise_grade", rise_grade, OneOf({"smooth", "sudden"}));
    v("level", level, within(-100, 100));
  }
};

/// Entries and crosscuts at regular distances, with pillars between them: a panel of
/// room-and-pillar workings. Becomes tunnels named `<name>_entry_<i>` and `<name>_crosscut_<j>`, i
/// and j from 0.
struct PanelDescription {
  std::string name;
  Pose2 T_world_panel;  ///< start of the centre line of entry 0; entries run along x, the next ones
                        ///< towards y
  int entries = 2;
  int crosscuts = 2;
  double entry_spacing_m = 12.0;     ///< between centre lines
  double crosscut_spacing_m = 20.0;  ///< along the entries
  double first_crosscut_m = 10.0;    ///< along the entries
  double entry_width_m = 3.0;
  double crosscut_width_m = 3.0;
  double length_m = 60.0;  ///< of the entries
  double slant_rad = 0.0;  ///< of the crosscuts, relative to the normal of the entries

  template <class V>
  void visit(V& v) {
    v("name", name);
    v("T_world_panel", T_world_panel);
    v("entries", entries, within(1, 100));
    v("crosscuts", crosscuts, within(0, 100));
    v("entry_spacing_m", entry_spacing_m, above(0.0));
    v("crosscut_spacing_m", crosscut_spacing_m, above(0.0));
    v("first_crosscut_m", first_crosscut_m, at_least(0.0));
    v("entry_width_m", entry_width_m, above_up_to(0.0, 50.0));
    v("crosscut_width_m", crosscut_width_m, above_up_to(0.0, 50.0));
    v("length_m", length_m, above(0.0));
    v("slant_rad", slant_rad, within(-1.0, 1.0));
  }
};

/// A room, or a pillar in one.
struct PolygonDescription {
  std::string name;
  std::vector<double> points_m;  ///< x, y, x, y, .. of its corners in order, in world

  template <class V>
  void visit(V& v) {
    v("name", name);
    v("points_m", points_m);
  }
};

/// The open space in plan.
struct PlanDescription {
  std::vector<TunnelDescription> tunnels;
  std::vector<PanelDescription> panels;
  std::vector<PolygonDescription> rooms;
  std::vector<PolygonDescription> pillars;  ///< rock, subtracted from rooms and tunnels

  template <class V>
  void visit(V& v) {
    v("tunnels", tunnels);
    v("panels", panels);
    v("rooms", rooms);
    v("pillars", pillars);
  }
};

/// Smooth random relief of a surface.
struct ReliefDescription {
  double height_m = 0.03;  ///< amplitude, to either side
  double length_m = 2.0;   ///< correlation length
  int octaves = 3;         ///< each of half the length and half the height of the one before
  double repeat_y_m =
      0.0;  ///< period along y, which gives parallel tunnels the same walls; 0: none

  template <class V>
  void visit(V& v) {
    v("height_m", height_m, within(0.0, 2.0));
    v("length_m", length_m, within(0.1, 1000.0));
    v("octaves", octaves, within(1, 8));
    v("repeat_y_m", repeat_y_m, at_least(0.0));
  }
};

/// Heights of floor and roof.
struct HeightsDescription {
  /// s, z, s, z, .. : height of the floor without relief at distance s along `heading_rad` from the
  /// origin, ascending in s, level beyond the ends. Empty: level at 0.
  std::vector<double> profile_m;
  double heading_rad = 0.0;
  std::string grade = "smooth";  ///< between the points of the profile: smooth, or sudden (linear)
  double clearance_m = 2.0;      ///< from floor to roof
  ReliefDescription rolls{.height_m = 0.0, .length_m = 20.0, .octaves = 1};  ///< of the seam
  ReliefDescription floor_relief{.height_m = 0.03, .length_m = 2.0};
  ReliefDescription roof_relief{.height_m = 0.08, .length_m = 2.0};

  template <class V>
  void visit(V& v) {
    v("profile_m", profile_m);
    v("heading_rad", heading_rad);
    v("grade", grade, OneOf({"smooth", "sudden"}));
    v("clearance_m", clearance_m, above_up_to(0.3, 50.0));
    v("rolls", rolls);
    v("floor_relief", floor_relief);
    v("roof_relief", roof_relief);
  }
};

/// A mesh file instead of a plan.
struct MeshDescription {
  std::string file;      ///< OBJ, PLY, DAE or another format of Assimp; empty for none
  double scale = 1.0;    ///< metres per unit of the file
  std::string up = "z";  ///< axis of the file that points up: x, y or z
  bool flat_floor = false;
  double floor_m = 0.0;  ///< z of a flat floor to add, after scale and axes
  bool flat_roof = false;
  double roof_m = 2.0;

  template <class V>
  void visit(V& v) {
    v("file", file);
    v("scale", scale, above(0.0));
    v("up", up, OneOf({"x", "y", "z"}));
    v("flat_floor", flat_floor);
    v("floor_m", floor_m, within(-5000.0, 5000.0));
    v("flat_roof", flat_roof);
    v("roof_m", roof_m, within(-5000.0, 5000.0));
  }
};

/// Description of a world: the only section, `world`, of a world file (sim/worlds/*.yaml).
struct WorldDescription {
  static constexpr const char* kSection = "world";

  std::string name;
  int seed = 1;         ///< of everything random in the world
  double grid_m = 0.2;  ///< approximate edge length of the mesh
  Pose2 T_world_start;
  int start_level = 0;  ///< of the tunnels at the start
  MeshDescription mesh;
  PlanDescription plan;
  HeightsDescription heights;
  ReliefDescription wall_relief{.height_m = 0.12, .length_m = 1.5};
  PropDescriptions props;

  template <class V>
  void visit(V& v) {
    v("name", name);
    v("seed", seed, at_least(0));
    v("grid_m", grid_m, within(0.05, 1.0));
    v("T_world_start", T_world_start);
    v("start_level", start_level, within(-100, 100));
    v("mesh", mesh);
    v("plan", plan);
    v("heights", heights);
    v("wall_relief", wall_relief);
    v("props", props);
  }
};

}  // namespace adit
