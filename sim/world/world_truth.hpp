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

/// A place of the centre-line graph where drifts meet, or one ends.
struct TunnelNode {
  Eigen::Vector2d p_world{0.0, 0.0};  ///< [m]
  bool entrance = false;              ///< open to the outside
};

/// A stretch of drift between two nodes.
struct TunnelEdge {
  int from = 0;
  int to = 0;
  std::vector<Eigen::Vector2d> points;  ///< p_world, from node to node [m]
  double length_m = 0.0;                ///< along the points
  double width_m = 0.0;                 ///< as planned, before the roughness of the walls
  std::string tunnel;                   ///< name of the drift that it is part of
};

/// The middle of every drift. Empty for a mesh from elsewhere, of which nobody knows it.
struct TunnelGraph {
  std::vector<TunnelNode> nodes;
  std::vector<TunnelEdge> edges;

  [[nodiscard]] double length_m() const;
};

/// The outline of rock in the plan at the height of the lasers: closed, the first point not
/// repeated. The outer ring runs counter-clockwise, a pillar clockwise, so that open space lies on
/// the left.
struct PlanRing {
  std::vector<Eigen::Vector2d> points;  ///< p_world [m]

  [[nodiscard]] bool is_pillar() const;
  [[nodiscard]] double signed_area_m2() const;  ///< negative for a pillar
};

/// Something that stands, lies, hangs or gapes in the way.
struct Obstacle {
  PartKind kind = PartKind::kOther;
  std::string name;                      ///< that of its part in the mesh, where it has one
  std::vector<Eigen::Vector2d> outline;  ///< convex, counter-clockwise, p_world [m]
  double z_low_m = 0.0;                  ///< lowest point, in world
  double z_high_m = 0.0;                 ///< highest point, in world
};

/// What is true of a world, for tests and scores. Frame `world`.
struct WorldTruth {
  TunnelGraph tunnels;
  std::vector<PlanRing> plan;
  std::vector<Obstacle> obstacles;

  /// Height of the bare floor, without props [m]; nothing outside of the mine.
  std::function<std::optional<double>(const Eigen::Vector2d& p_world)> floor_height;

  /// The same; nothing where nobody knows it, too.
  [[nodiscard]] std::optional<double> floor_at(const Eigen::Vector2d& p_world) const;
};

}  // namespace adit
