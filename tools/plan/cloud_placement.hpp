// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "common/types/cloud.hpp"
#include "tools/cloud/point_cloud.hpp"

namespace adit {

/// What a file of bare points does not say: where the laser was, and where a vehicle is to stand.
struct CloudPlacement {
  /// Axis of the file that points against gravity: x, y, z, -x, -y or -z.
  std::string up = "z";
  std::optional<Eigen::Vector3d> p_file_laser =
      std::nullopt;  ///< [m]; else what the file says, else its origin
  /// Where the vehicle's middle is to be, in the plan of the upright cloud [m]; else below the
  /// laser.
  std::optional<Eigen::Vector2d> p_plan_vehicle = std::nullopt;
  std::optional<double> ground_m =
      std::nullopt;          ///< height of the ground there, upright; else it is looked for
  double heading_rad = 0.0;  ///< of the vehicle, in that plan
  bool level = false;        ///< turn the cloud until the ground near the vehicle is level
};

/// The coordinates of a file as x, y and z of an upright frame: z is what points up. Of an axis
/// that points up, x and y of upright are: z: x, y; y: x, −z; x: y, z; -z: x, −y; -y: z, −x;
/// -x: z, y. Throws std::invalid_argument for what is no axis.
Eigen::Matrix3d upright(const std::string& up);

/// The points in level, with the vehicle on the ground at its origin, as one line of a sweep: all
/// seen from one place, and of beams that met nothing nothing is known. Throws std::runtime_error
/// where the ground is looked for and not found, or the laser is not above it.
Cloud place_cloud(const PointCloud& points, const CloudPlacement& placement);

}  // namespace adit
