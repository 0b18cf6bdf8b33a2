// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/types/cloud.hpp"
#include "tools/cloud/cloud_file.hpp"

namespace adit {

/// Poses of laser and vehicle that a point cloud file does not specify. The upright frame is the
/// file rotated such that z points up; the plan is its x-y plane.
struct CloudPlacement {
  /// Axis of the file that points up: x, y, z, -x, -y or -z.
  std::string up = "z";
  /// Laser position in the frame of the file [m]; default: PointCloud::sensor, else the origin.
  std::optional<Eigen::Vector3d> p_file_laser = std::nullopt;
  /// Vehicle centre in the plan [m]; default: below the laser.
  std::optional<Eigen::Vector2d> p_plan_vehicle = std::nullopt;
  /// Ground height at the vehicle in the upright frame [m]; default: estimated.
  std::optional<double> ground_m = std::nullopt;
  double heading_rad = 0.0;  ///< of the vehicle in the plan
  bool level = false;        ///< rotate the cloud until the ground near the vehicle is level
};

/// Rotation from the frame of the file to the upright frame. The x and y axes of the upright frame
/// are, for each up axis: z: x, y; y: x, −z; x: y, z; -z: x, −y; -y: z, −x; -x: z, y. Throws
/// std::invalid_argument for any other text.
Eigen::Matrix3d upright(const std::string& up);

/// Transforms the points into level, with the vehicle on the ground at the origin. The result is
/// one line with a single viewpoint and without beams without return. Throws std::runtime_error if
/// the ground must be estimated and is not observed, or if the laser is not above the ground.
Cloud place_cloud(const PointCloud& points, const CloudPlacement& placement);

// Estimates of the ground near `p_plan`, in a frame with z up [m], from the low points of grid
// cells that are below the laser. Both throw std::runtime_error if too few cells have points.

/// Median ground height; up to half of the cells may contain objects.
double estimate_ground_height(const std::vector<Eigen::Vector3d>& points,
                              const Eigen::Vector2d& p_plan, double laser_z_m);

/// Unit normal of the ground plane, upwards, robust to cells with objects.
Eigen::Vector3d estimate_ground_normal(const std::vector<Eigen::Vector3d>& points,
                                       const Eigen::Vector2d& p_plan, double laser_z_m);

}  // namespace adit
