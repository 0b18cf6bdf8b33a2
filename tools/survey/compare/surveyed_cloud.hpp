// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/registration/cloud_registration.hpp"

namespace adit {

/// A 3D scan of a survey, thinned.
struct SurveyedScan {
  std::int64_t number = 0;
  Eigen::Vector3d laser{0.0, 0.0, 0.0};  ///< in the frame of the comparison [m]
  std::vector<Eigen::Vector3f> points;   ///< from the laser, along the axes of that frame [m]
  /// Of small motions of the scan about the laser along these axes, (x, y, z [m], rotation
  /// vector [rad]), as the standard deviations of its points state them.
  Matrix6d covariance = Matrix6d::Zero();
  /// The same of the place in plan [m], the heading [rad] and the height [m] relative to the scan
  /// before, standard deviations; 0 of the first scan.
  double step_sd_m = 0.0;
  double step_turn_sd_rad = 0.0;
  double step_z_sd_m = 0.0;
};

/// What `adit survey` wrote of a mine, for a comparison. The frame "comparison" has the axes of the
/// grid and an origin near the mine, the same for both surveys.
struct SurveyedCloud {
  std::vector<SurveyedScan> scans;
  Eigen::Vector3d origin{0.0, 0.0, 0.0};  ///< of the frame comparison, in the grid
  std::string crs_wkt;
  std::string crs_name;

  [[nodiscard]] std::size_t points() const;
};

/// Reads cloud.las and survey.gpkg of a folder of `adit survey`. Points of one scan are thinned to
/// one per `voxel_m`, and those beyond `range_max_m` from the laser are left out, since their
/// spacing exceeds the relief. `origin`: of comparison; nullptr: the first scan is. Throws
/// FileError.
SurveyedCloud read_surveyed_cloud(const std::filesystem::path& folder, double voxel_m,
                                  double range_max_m, const Eigen::Vector3d* origin);

}  // namespace adit
