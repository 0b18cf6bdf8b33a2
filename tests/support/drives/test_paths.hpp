// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/types/planned_path.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// A path by hand, of lines and arcs that join without a corner, as planning makes them: line and
/// arc of the point that moves along the body's x axis.
class TestPathBuilder {
 public:
  explicit TestPathBuilder(const Vehicle& vehicle, const Pose2& T_odom_start = {},
                           double spacing_m = 0.15);

  /// On along an arc of the body's origin, positive to the left of x; curvature 0 is a line.
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

/// Shapes to try controllers on, from the pose where they begin; the tightest bends have
/// `radius_m`.
struct PathShape {
  std::string name;
  PlannedPath path;
};
std::vector<PathShape> path_shapes(const Vehicle& vehicle, double radius_m,
                                   const Pose2& T_odom_start = {});

/// The same path, driven the other way round: from where each run ends, in reverse.
PlannedPath driven_in_reverse(PlannedPath path);

/// What planning finds through a random corridor, for a robot that stands anywhere between the
/// poses of the lattice; in the frame of that robot.
PlannedPath random_corridor_path(std::uint32_t seed, const Vehicle& vehicle);

}  // namespace adit
