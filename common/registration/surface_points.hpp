// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/attitude.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"

namespace adit {

/// A point of a scan, seen from above, with the local normal of the surface it lies on.
struct SurfacePoint {
  Eigen::Vector2d p = Eigen::Vector2d::Zero();       ///< [m]
  double z_m = 0.0;                                  ///< height
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< unit, towards the laser; zero: unknown
  double normal_variance = 0.0;                      ///< of the direction of the normal [rad²]
  double variance = 0.0;                             ///< of the position along the normal [m²]
  double weight = 1.0;                               ///< lower where beams are dense
  double lean_sd = 0.2;  ///< standard deviation of the surface's distance at another height [m/m]
  /// Unknown inverse grade that it shares with other points; empty: the surface is a wall.
  std::optional<int> grade_group;
  /// For points of such a group: standard deviation of the pitch of the body, if it is not
  /// measured.
  double pitch_sd_rad = 0.0;
  int beam = 0;  ///< of the scan

  [[nodiscard]] bool has_normal() const { return normal.squaredNorm() > 0.5; }
};

struct SurfaceParams {
  /// Neighbours on each side used for the line fit, of beams half a degree apart or more. Finer
  /// beams take more, inversely with the square of their step: their normals would be noisier, and
  /// there are more of them, so that smooth walls seemed to show the motion along them.
  int half_window_beams = 4;
  double window_radius_m = 0.4;   ///< maximum distance of these neighbours
  double gap_m = 0.2;             ///< neighbours closer than this lie on one surface
  double bend_m = 0.05;           ///< as do farther ones that deviate from a line by less than this
  double gap_on_line_m = 1.5;     ///< maximum distance of these
  double residual_max_m = 0.05;   ///< a line fit with a larger residual gives no normal
  double spacing_full_m = 0.05;   ///< denser points share the weight of one
  double range_sd_m = 0.01;       ///< standard deviation of a range
  double bearing_sd_rad = 0.002;  ///< standard deviation of the bearing: the spot is wide

  template <class V>
  void visit(V& v) {
    v("half_window_beams", half_window_beams, within(1, 50));
    v("window_radius_m", window_radius_m, within(0.01, 10.0));
    v("gap_m", gap_m, within(0.001, 10.0));
    v("bend_m", bend_m, within(0.0, 1.0));
    v("gap_on_line_m", gap_on_line_m, within(0.0, 100.0));
    v("residual_max_m", residual_max_m, within(0.001, 1.0));
    v("spacing_full_m", spacing_full_m, above(0.0));
    v("range_sd_m", range_sd_m, within(0.0001, 1.0));
    v("bearing_sd_rad", bearing_sd_rad, within(0.0, 0.1));
  }
};

/// The valid points of a scan, in order of angle, in the level frame of the body: each is projected
/// along the vertical, so that a vertical wall is seen at the same place whatever the attitude.
/// Heights are above the origin of the body frame. Discarded are NaN and infinite readings, those
/// outside the mount's range limits, and isolated points between a near and a far surface (mixed
/// pixels, where the spot of the beam covers both). An empty scan gives an empty vector.
std::vector<SurfacePoint> surface_points(const LaserScan& scan, const LaserMount& mount,
                                         const SurfaceParams& params,
                                         const Attitude& attitude = {});

}  // namespace adit
