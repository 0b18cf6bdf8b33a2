// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "sim/mesh/mesh_builder.hpp"
#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/props/prop_descriptions.hpp"
#include "sim/world/surface/heights.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// Context for adding one prop to the world.
struct PropSite {
  const std::vector<TunnelLine>& tunnels;
  const Heights& heights;
  MeshBuilder& builder;
  World& world;
  std::string what;        ///< which prop it is, for messages: `props.posts[2]`
  std::mt19937_64 random;  ///< a separate stream, so that no prop changes another

  /// Uniformly random.
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
};

/// The tunnel of a prop. Throws std::invalid_argument, starting with `what`, if there is no such
/// tunnel or `at_m` is not along it.
const TunnelLine& tunnel_with(const std::vector<TunnelLine>& tunnels, const std::string& name,
                              double at_m, const std::string& what);

/// The same for a section, whose end must not be before its start.
const TunnelLine& tunnel_with(const std::vector<TunnelLine>& tunnels, const std::string& name,
                              double from_m, double to_m, const std::string& what);

/// Positions along a section, including its ends, at most `step_m` apart [m].
std::vector<double> places_between(double from_m, double to_m, double step_m);

/// A point on the floor beside the centre line of a tunnel, in world.
Eigen::Vector3d on_floor(const PropSite& site, const TunnelLine& tunnel, double s_m,
                         double across_m);

/// Frame at a position of a tunnel: x along it, y to its left, z up; origin at `p_world`.
Eigen::Isometry3d tunnel_axes(const TunnelLine& tunnel, double s_m, const Eigen::Vector3d& p_world);

/// Begins a part of the mesh that is an obstacle. Returns the argument of `end_obstacle`.
std::size_t begin_obstacle(PropSite& site, PartKind kind, Material material,
                           const std::string& name);

/// Adds the vertices since `begin_obstacle` to the ground truth as one obstacle.
void end_obstacle(PropSite& site, std::size_t first_vertex);

// Changes of floor or roof by a prop of `tunnel`. `bare` has the floor without pits and hollows.
HeightChange pit_in_floor(const PitDescription& pit, const TunnelLine& tunnel);
/// The hollow under the water. It starts at the floor at both ends of the section and has the
/// described depth below the surface of the water at half its length.
HeightChange hollow_under(const WaterDescription& water, const TunnelLine& tunnel,
                          const Heights& bare);
/// The clearance refers to the bare floor.
HeightChange lowered_roof(const LowRoofDescription& low, const TunnelLine& tunnel,
                          const std::shared_ptr<const Heights>& bare);
/// A paraboloid above the cone of rubble.
HeightChange cavity_above(const RubbleDescription& rubble, const TunnelLine& tunnel);

/// Adds a convex block of twenty facets with a random orientation, within `radius_m` of `middle`
/// (world).
void add_stone(const Eigen::Vector3d& middle, double radius_m, std::mt19937_64& random,
               MeshBuilder& builder);

// Adds one prop: its surfaces to the mesh, its ground truth to the world. Each throws
// std::invalid_argument with the name of the prop for an unknown tunnel or a position beyond its
// end.
void add_prop(const RailsDescription& rails, PropSite& site);
void add_prop(const PostsDescription& posts, PropSite& site);
void add_prop(const CribDescription& crib, PropSite& site);
void add_prop(const RubbleDescription& rubble, PropSite& site);
void add_prop(const BeamDescription& beam, PropSite& site);
void add_prop(const CarDescription& car, PropSite& site);
void add_prop(const LowRoofDescription& low_roof, PropSite& site);
void add_prop(const PitDescription& pit, PropSite& site);
void add_prop(const WaterDescription& water, PropSite& site);
void add_prop(const MudDescription& mud, PropSite& site);
void add_prop(const GasDescription& gas, PropSite& site);

}  // namespace adit
