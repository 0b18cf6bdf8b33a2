// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// Pose of the camera.
struct ViewOptions {
  std::optional<Pose2> from;       ///< T_world_camera in the plan; nothing for behind the start
  double eye_m = 1.2;              ///< height of the camera above the floor
  double pitch_rad = 0.06;         ///< of the camera, positive looks down
  double field_of_view_rad = 1.3;  ///< horizontal
  int width_px = 1800;             ///< of the sheet, at least 600

  /// The line of the section, p_world; with fewer than two points, the tunnel at the start.
  std::vector<Eigen::Vector2d> section;
};

/// Parses the pose of a camera on a command line: `X,Y,HEADING_DEG`, in metres and degrees in
/// world, for example `308,0,180`. Throws std::invalid_argument, one line, for any other text.
Pose2 parse_view_pose(const std::string& text);

}  // namespace adit
