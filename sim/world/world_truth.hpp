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
};

/// A section of a tunnel between two nodes.
struct TunnelEdge {
  int from = 0;
  int to = 0;
  std::vector<Eigen::Vector2d> points;  ///< p_world, from node to node [m]
  double length_m = 0.0;                ///< along the points
  double width_m = 0.0;                 ///< as planned, without the relief of the walls
  std::string tunnel;                   ///< name of its tunnel
};

/// The centre lines of all tunnels. Empty for an imported mesh.
struct TunnelGraph {
  std::vector<TunnelNode> nodes;
  std::vector<TunnelEdge> edges;

  [[nodiscard]] double length_m() const;
};

/// A closed outline of rock in the plan at the height of the lasers; the first point is not
/// repeated. The outer ring runs counter-clockwise, a pillar clockwise, so that open space is on
/// the left.
struct PlanRing {
  std::vector<Eigen::Vector2d> points;  ///< p_world [m]

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
};

/// Ground truth of a world, for tests and scores. Frame `world`.
struct WorldTruth {
  TunnelGraph tunnels;
  std::vector<PlanRing> plan;
  std::vector<Obstacle> obstacles;

  /// Height of the floor without props [m]; empty outside of the mine. Not set if unknown.
  std::function<std::optional<double>(const Eigen::Vector2d& p_world)> floor_height;

  /// The same; also empty where floor_height is not set.
  [[nodiscard]] std::optional<double> floor_at(const Eigen::Vector2d& p_world) const;
};

}  // namespace adit
