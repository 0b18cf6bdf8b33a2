// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/path/planned_path.hpp"
#include "procs/driving/steered_point.hpp"

namespace adit {

/// A part of a path that is driven in one direction: a line from point to point of the steered
/// point, its places counted in metres from its beginning.
class PathRun {
 public:
  struct Knot {
    double s_m = 0.0;
    Pose2 T_odom_steered;  ///< heading not wrapped, so that it can be interpolated
    double clearance_m = 0.0;
  };

  /// At least one knot, with ways that increase.
  PathRun(std::vector<Knot> knots, bool reverse);

  [[nodiscard]] double length_m() const { return knots_.back().s_m; }
  /// 1, or −1 in reverse.
  [[nodiscard]] double direction() const { return direction_; }
  /// Behind its end it goes on as it bends at last.
  [[nodiscard]] Pose2 at(double s_m) const;
  /// The least that is said of the stretch.
  [[nodiscard]] double clearance_m(double s_m) const;
  /// Mean curvature between two places of the run, positive to the left: how much the heading
  /// changes, and so exact however far apart the points are. What is beyond the run does not count.
  [[nodiscard]] double curvature_1_m(double from_m, double to_m) const;
  /// The place nearest to a point, among those between two places of the run.
  [[nodiscard]] double nearest_m(const Eigen::Vector2d& p_odom, double from_m, double to_m) const;

 private:
  [[nodiscard]] Pose2 behind_end(double way_m) const;
  /// Index of the knot that ends the stretch of a place; 0 with one knot only.
  [[nodiscard]] std::size_t end_of_stretch(double s_m) const;

  std::vector<Knot> knots_;
  double direction_;
};

/// Cut where the direction of travel changes. Points less than a millimetre from the one before are
/// left out. Points must be finite, and at least one.
std::vector<PathRun> runs_of(const std::vector<PathPoint>& points, const SteeredPoint& steered);

}  // namespace adit
