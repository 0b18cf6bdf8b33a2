// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "tools/survey/compare/scan_placement.hpp"
#include "tools/survey/compare/surveyed_cloud.hpp"

namespace adit {

struct SurfaceDistanceParams {
  double spacing_m = 0.1;         ///< of core points
  double normal_radius_m = 0.25;  ///< of the points that give a normal
  double cylinder_radius_m = 0.12;
  double depth_m = 1.0;   ///< to either side of the older surface, in which the newer is looked for
  double layer_m = 0.15;  ///< returns farther from the median are of another surface
  int points_min = 6;     ///< in a cylinder
  /// Neighbouring returns share the error of their line and the relief between lines: this number
  /// of them counts as one measurement, as in CloudRegistrationParams.
  double points_per_measurement = 9.0;
  /// Standard deviation of the distance between two scans of one surface beside their poses: what
  /// the ranges of a laser share, and edges seen from two places.
  double scan_sd_m = 0.01;
};

/// How far the surface moved at a point of the older one.
struct SurfaceDistance {
  Eigen::Vector3d p{0.0, 0.0, 0.0};  ///< on the older surface, in comparison [m]
  Eigen::Vector3d n{0.0, 0.0, 0.0};  ///< unit, into the void
  double area_m2 = 0.0;              ///< of the surface that it stands for
  /// Of the newer surface along n [m]: positive where it moved into the void, negative where rock
  /// is gone. NaN where the newer survey shows no surface within reach.
  double distance_m = std::numeric_limits<double>::quiet_NaN();
  double sd_m = 0.0;  ///< of that distance

  [[nodiscard]] bool is_measured() const;
  /// The level of detection at 95 % [m].
  [[nodiscard]] double detection_m() const { return 1.96 * sd_m; }
  [[nodiscard]] bool is_significant() const;
};

/// Distances of two clouds along the normals of the older one (Lague, Brodu, Leroux, "Accurate 3D
/// comparison of complex topography with terrestrial laser scanner: application to the Rangitikei
/// canyon", ISPRS Journal 82, 2013, sections 3.1 to 3.3; M3C2). Core points are its points
/// thinned to `spacing_m`. Of the cylinder along the normal the median of each cloud is taken, of
/// the returns whose laser is on the side of the void. The variance is that of both means (equation
/// 1), and in place of one registration error for all, by place: the covariances of the scans'
/// placements, and the scatter between the scans of a survey.
std::vector<SurfaceDistance> surface_distances(const SurveyedCloud& older,
                                               const std::vector<ScanPlacement>& older_at,
                                               const SurveyedCloud& newer,
                                               const std::vector<ScanPlacement>& newer_at,
                                               const SurfaceDistanceParams& params,
                                               const std::function<void(double done)>& progress);

}  // namespace adit
