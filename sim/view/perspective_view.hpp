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

/// A pinhole camera: x along its axis, y left, z up. Picture coordinates (u, v) are in pixels from
/// the upper left corner, to the right and down: the centre of the first pixel is (0.5, 0.5).
class Camera {
 public:
  /// `field_of_view_rad` is the horizontal field of view, less than π.
  Camera(const Eigen::Isometry3d& T_world_camera, double field_of_view_rad, int width, int height);

  [[nodiscard]] const Eigen::Isometry3d& T_world_camera() const { return T_world_camera_; }
  [[nodiscard]] Eigen::Vector3d eye() const { return T_world_camera_.translation(); }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  [[nodiscard]] Ray ray(const Eigen::Vector2d& uv) const;
  /// Projection of a point, which may be outside of the picture; empty for a point behind the
  /// camera.
  [[nodiscard]] std::optional<Eigen::Vector2d> pixel(const Eigen::Vector3d& p_world) const;

 private:
  Eigen::Isometry3d T_world_camera_;
  int width_;
  int height_;
  double focal_length_px_;
};

/// The camera of the options. Without a pose in them, it is up to 2 m behind the start, as far as
/// there is free space, and has the heading of the start.
Camera camera_of(const Site& site, const ViewOptions& options, int width, int height);

/// Renders the perspective of a person with a lamp beside the head in the dark. Rays without a hit
/// show the sky.
RgbImage perspective_view(const RayScene& scene, const Camera& camera);

}  // namespace adit
