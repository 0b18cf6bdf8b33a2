// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "common/geometry/pose2.hpp"

namespace adit {

/// A line, an arc and a line, tangent to each other: the curve of the point of the vehicle that
/// moves along the vehicle's x axis.
struct LineArcLine {
  double line_in_m = 0.0;
  double radius_m = 0.0;  ///< of the arc; 0 without an arc
  double turn_rad = 0.0;  ///< positive to the left
  double line_out_m = 0.0;

  [[nodiscard]] double arc_m() const;
  [[nodiscard]] double length_m() const { return line_in_m + arc_m() + line_out_m; }
  /// The pose at an arc length, relative to the start of the curve.
  [[nodiscard]] Pose2 pose_at(double distance_m) const;
  /// Curvature to the right of an arc length, positive to the left [1/m].
  [[nodiscard]] double curvature_at(double distance_m) const;
};

/// The shortest line-arc-line from the origin to `end` with a radius of at least `radius_min_m`.
/// The absolute heading of `end` must be in (0, π). Nothing if there is none.
std::optional<LineArcLine> line_arc_line_to(const Pose2& end, double radius_min_m);

}  // namespace adit
