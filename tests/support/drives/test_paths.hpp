// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/types/planned_path.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// Builds a path of lines and arcs with continuous heading, like planned paths: line and arc are
/// those of the point that moves along the x axis of the body.
class TestPathBuilder {
 public:
  explicit TestPathBuilder(const Vehicle& vehicle, const Pose2& T_odom_start = {},
                           double spacing_m = 0.15);

  /// Appends an arc of the body origin, positive curvature to the left; curvature 0 is a line.
  TestPathBuilder& forward(double length_m, double curvature_1_m = 0.0);
  TestPathBuilder& back(double length_m, double curvature_1_m = 0.0);

  [[nodiscard]] PlannedPath path() const;

 private:
  TestPathBuilder& add(double length_m, double curvature_1_m, bool reverse);

  Vehicle vehicle_;
  double spacing_m_;
  Pose2 T_odom_body_;
  std::vector<PathPoint> points_;
};

/// A test path for path-following controllers.
struct PathShape {
  std::string name;
  PlannedPath path;
};

/// All shapes, starting at a pose; the tightest bends have `radius_m`.
std::vector<PathShape> path_shapes(const Vehicle& vehicle, double radius_m,
                                   const Pose2& T_odom_start = {});

/// The same path driven backwards: the points in reverse order with the direction of travel
/// reversed, moved such that it starts at the start pose of `path`.
PlannedPath driven_in_reverse(PlannedPath path);

/// The planned path through a random corridor for a robot at a random offset from the poses of the
/// planning lattice, in the frame of that robot.
PlannedPath random_corridor_path(std::uint32_t seed, const Vehicle& vehicle);

}  // namespace adit
