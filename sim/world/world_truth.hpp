// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// A node of the centre-line graph: a junction or an end of tunnels.
struct TunnelNode {
  Eigen::Vector2d p_world{0.0, 0.0};  ///< [m]
  bool entrance = false;              ///< open to the outside
  int level = 0;                      ///< the lower number where levels meet
};

/// A section of a tunnel between two nodes.
struct TunnelEdge {
  int from = 0;
  int to = 0;
  std::vector<Eigen::Vector2d> points;  ///< p_world, from node to node [m]
  double length_m = 0.0;                ///< along the points
  double width_m = 0.0;                 ///< as planned, without the relief of the walls
  std::string tunnel;                   ///< name of its tunnel
  int level = 0;                        ///< of its tunnel
};

/// The centre lines of all tunnels. Empty for an imported mesh.
struct TunnelGraph {
  std::vector<TunnelNode> nodes;
  std::vector<TunnelEdge> edges;

  [[nodiscard]] double length_m() const;
};

/// A closed outline of rock in the plan at the height of the lasers; the first point is not
/// repeated. The outer ring runs counter-clockwise, a pillar clockwise, so that open space is on
/// the left. Where levels meet, their outlines overlap by some metres, and run straight across.
struct PlanRing {
  std::vector<Eigen::Vector2d> points;  ///< p_world [m]
  int level = 0;                        ///< of the tunnels that it encloses

  [[nodiscard]] bool is_pillar() const;
  [[nodiscard]] double signed_area_m2() const;  ///< negative for a pillar
};

/// An obstacle for the vehicle: an object or a hole.
struct Obstacle {
  PartKind kind = PartKind::kOther;
  std::string name;                      ///< of its part in the mesh, if it has one
  std::vector<Eigen::Vector2d> outline;  ///< convex, counter-clockwise, p_world [m]
  double z_low_m = 0.0;                  ///< lowest point, in world
  double z_high_m = 0.0;                 ///< highest point, in world
  int level = 0;                         ///< of its tunnel
};

/// Ground truth of a world, for tests and scores. Frame `world`.
struct WorldTruth {
  TunnelGraph tunnels;
  std::vector<PlanRing> plan;
  std::vector<Obstacle> obstacles;

  /// Height of the floor without props [m]; empty outside of the mine. Not set if unknown. Of
  /// several levels, the first one with a floor there, beginning with that of the start.
  std::function<std::optional<double>(const Eigen::Vector2d& p_world)> floor_height;

  /// The same for one level of several, which is continued by some metres where levels meet. Not
  /// set for a world of one level.
  std::function<std::optional<double>(const Eigen::Vector2d& p_world, int level)>
      level_floor_height = {};
  std::vector<int> levels{0};  ///< ascending

  /// As floor_height; also empty where that is not set.
  [[nodiscard]] std::optional<double> floor_at(const Eigen::Vector2d& p_world) const;
  /// The floor of one level.
  [[nodiscard]] std::optional<double> floor_at(const Eigen::Vector2d& p_world, int level) const;
  /// The level whose floor is nearest to a height; the first level where there is none.
  [[nodiscard]] int level_at(const Eigen::Vector3d& p_world) const;
};

}  // namespace adit
