// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "common/picture/rgb_image.hpp"
#include "sim/mesh/ray_scene.hpp"
#include "sim/view/view_options.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// A pinhole camera: x along its axis, y left, z up. A picture's coordinates (u, v) count in pixels
/// from its upper left corner, to the right and down: the middle of the first pixel is (0.5, 0.5).
class Camera {
 public:
  /// `field_of_view_rad` is that of the width of the picture, less than π.
  Camera(const Eigen::Isometry3d& T_world_camera, double field_of_view_rad, int width, int height);

  [[nodiscard]] const Eigen::Isometry3d& T_world_camera() const { return T_world_camera_; }
  [[nodiscard]] Eigen::Vector3d eye() const { return T_world_camera_.translation(); }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  [[nodiscard]] Ray ray(const Eigen::Vector2d& uv) const;
  /// Where a point is in the picture, or beside it; nothing for one that is not before the camera.
  [[nodiscard]] std::optional<Eigen::Vector2d> pixel(const Eigen::Vector3d& p_world) const;

 private:
  Eigen::Isometry3d T_world_camera_;
  int width_;
  int height_;
  double focal_length_px_;
};

/// The camera of the options. Where they name no place, it stands up to 2 m behind the start, as
/// far as the mine lets it, and looks the way of the start.
Camera camera_of(const Site& site, const ViewOptions& options, int width, int height);

/// What a person sees who stands there in the dark with a lamp beside the head. Where there is no
/// surface, it is day.
RgbImage perspective_view(const RayScene& scene, const Camera& camera);

}  // namespace adit
