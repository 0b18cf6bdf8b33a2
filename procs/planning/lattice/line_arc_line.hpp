// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "common/geometry/pose2.hpp"

namespace adit {

/// Straight on, an arc, straight on: how the point of the vehicle that moves along the vehicle's x
/// axis gets from a pose to another.
struct LineArcLine {
  double line_in_m = 0.0;
  double radius_m = 0.0;  ///< of the arc; 0 where there is none
  double turn_rad = 0.0;  ///< positive to the left
  double line_out_m = 0.0;

  [[nodiscard]] double arc_m() const;
  [[nodiscard]] double length_m() const { return line_in_m + arc_m() + line_out_m; }
  /// The pose after a way, from the one at its beginning.
  [[nodiscard]] Pose2 pose_at(double distance_m) const;
  /// Of the stretch that begins there, positive to the left.
  [[nodiscard]] double curvature_at(double distance_m) const;
};

/// The manoeuvre that ends at a pose, from the one at its beginning, turning by more than 0 and
/// less than π to either side; of those with a radius of at least `radius_min_m` that of the
/// shortest way. Nothing if there is none.
std::optional<LineArcLine> line_arc_line_to(const Pose2& end, double radius_min_m);

}  // namespace adit
