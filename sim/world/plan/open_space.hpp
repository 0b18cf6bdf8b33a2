// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sim/world/plan/plan_shapes.hpp"
#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/relief.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// Rooms or pillars, which `kind` names in messages. Throws std::invalid_argument for odd lists of
/// points.
std::vector<PlanPolygon> polygons_of(const std::vector<PolygonDescription>& descriptions,
                                     const std::string& kind);

/// The open space of a mine in plan as a signed distance function: tunnels and rooms without
/// pillars. In front of an entrance there is an apron of ground under the open sky. Frame world.
class OpenSpace {
 public:
  /// Length of the apron in front of an entrance.
  static constexpr double kApronLength = 4.0;

  /// Throws std::invalid_argument for a plan without tunnel and room or beyond kExtentMax, and for
  /// odd lists of points.
  OpenSpace(const WorldDescription& description, const std::vector<TunnelLine>& tunnels);
  /// One of several levels, whose buckets all cover the same rectangle.
  OpenSpace(const WorldDescription& description, const std::vector<TunnelLine>& tunnels,
            const Eigen::AlignedBox2d& all);
  /// Bounding rectangle of the shapes.
  [[nodiscard]] Eigen::AlignedBox2d bounds() const { return adit::bounds(shapes_.all); }
  static constexpr double kExtentMax = 5000.0;  ///< from the origin along each axis [m]

  /// Distance to the planned walls, negative in rock. Exact near a wall; a lower bound where shapes
  /// overlap. In rock clamped to minus the reach of the walls.
  [[nodiscard]] double planned_depth_m(const Eigen::Vector2d& p_world) const;
  /// The same with the relief of the walls in plan: zero on the line where they meet the floor.
  [[nodiscard]] double depth_m(const Eigen::Vector2d& p_world) const;
  /// Recess of a wall at a point of it, in addition to `depth_m`.
  [[nodiscard]] double bulge_m(const Eigen::Vector3d& p_world) const {
    return relief_in_height_.in_space(p_world);
  }
  /// Whether a point is in front of an entrance.
  [[nodiscard]] bool on_apron(const Eigen::Vector2d& p_world) const;

  /// Largest distance of the walls from their plan, and of the mesh from the walls.
  [[nodiscard]] double reach_m() const { return reach_m_; }
  /// Buckets whose sides are a multiple of the grid's edges.
  [[nodiscard]] const PlanBuckets& buckets() const { return buckets_; }

 private:
  struct Shapes {
    std::vector<PlanShape> all;         ///< open shapes, then the pillars
    std::size_t open = 0;               ///< number of open shapes
    std::vector<TunnelSegment> aprons;  ///< along x outwards
  };
  static Shapes shapes_of(const PlanDescription& plan, const std::vector<TunnelLine>& tunnels);
  static PlanBuckets buckets_of(const Shapes& shapes, double grid_m, double reach_m,
                                const Eigen::AlignedBox2d& all);

  Shapes shapes_;
  double reach_m_;
  PlanBuckets buckets_;
  Relief relief_in_plan_;
  Relief relief_in_height_;
};

}  // namespace adit
