// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view/camera.hpp"

#include <cmath>

namespace adit {

Camera::Camera(const Eigen::Isometry3d& T_world_camera, double field_of_view_rad, int width,
               int height)
    : T_world_camera_(T_world_camera),
      width_(width),
      height_(height),
      focal_length_px_(width / 2.0 / std::tan(field_of_view_rad / 2.0)) {}

Ray Camera::ray(const Eigen::Vector2d& uv) const {
  const Eigen::Vector3d d_camera(focal_length_px_, width_ / 2.0 - uv.x(), height_ / 2.0 - uv.y());
  const Eigen::Vector3d d_world = T_world_camera_.linear() * d_camera.normalized();
  return {eye().cast<float>(), d_world.cast<float>()};
}

std::optional<Eigen::Vector2d> Camera::pixel(const Eigen::Vector3d& p_world) const {
  const Eigen::Vector3d p_camera = T_world_camera_.inverse() * p_world;
  if (p_camera.x() <= 0.0) return std::nullopt;
  const double scale = focal_length_px_ / p_camera.x();
  return Eigen::Vector2d(width_ / 2.0 - scale * p_camera.y(), height_ / 2.0 - scale * p_camera.z());
}

}  // namespace adit
