// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "sim/world/plan/plan_shapes.hpp"
#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/surface/height_profile.hpp"

namespace adit {

/// Height of the floors of tunnels above that of the seam (TunnelDescription::rise_m) as one
/// continuous function of the plan. Frame world.
///
/// Within a straight stretch of a single tunnel it is the profile of that tunnel, constant across
/// the tunnel. Where segments of a tunnel or several tunnels overlap, it is the mean of their
/// profiles, weighted by the square of the depth in each (a partition of unity, Shepard 1968).
/// Rooms have rise 0.
class TunnelRises {
 public:
  /// `reach_m` is the largest distance of the walls from their plan. Null if no tunnel has a rise.
  /// Throws std::invalid_argument with the name of the tunnel for an invalid list.
  static std::shared_ptr<const TunnelRises> of(const std::vector<TunnelLine>& tunnels,
                                               const std::vector<PlanPolygon>& rooms,
                                               double reach_m);

  /// 0 in rock farther than `reach_m` from all tunnels and rooms.
  double operator()(const Eigen::Vector2d& p_world) const;

 private:
  /// What a shape is a stretch of.
  struct Stretch {
    std::size_t line = 0;  ///< index of its profile; kRoom for a room
    double s_m = 0.0;      ///< at the start of the segment
  };
  struct Line {
    HeightProfile rise;
    double length_m = 0.0;
  };

  struct Parts {
    std::vector<Line> lines;
    std::vector<PlanShape> shapes;
    std::vector<Stretch> stretches;  ///< of the shapes
  };

  static Parts parts_of(const std::vector<TunnelLine>& tunnels,
                        const std::vector<PlanPolygon>& rooms);
  TunnelRises(Parts parts, double reach_m);
  [[nodiscard]] double rise_of(std::size_t shape, const Eigen::Vector2d& p_world) const;

  double reach_m_;
  Parts parts_;
  PlanBuckets buckets_;
};

}  // namespace adit
