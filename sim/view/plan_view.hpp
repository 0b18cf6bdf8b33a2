// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/picture/canvas.hpp"
#include "common/picture/rgb_image.hpp"
#include "sim/mesh/ray_scene.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// A rectangle of the plan and its scale, x of world to the right, y up.
struct PlanWindow {
  Eigen::Vector2d low{0.0, 0.0};  ///< p_world [m]
  Eigen::Vector2d high{0.0, 0.0};
  double pixels_per_metre = 1.0;

  [[nodiscard]] int width() const;   ///< [pixels]
  [[nodiscard]] int height() const;  ///< [pixels]
  /// (u, v) as in Camera.
  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector2d& p_world) const;
  [[nodiscard]] Eigen::Vector2d p_world(const Eigen::Vector2d& uv) const;
};

/// Renders a mine from above without its roof.
class PlanView {
 public:
  static constexpr unsigned kRock = 0x57524c;  ///< colour of cut rock, RGB

  /// `world` must outlive this.
  explicit PlanView(const World& world);
  PlanView(const PlanView&) = delete;
  PlanView& operator=(const PlanView&) = delete;

  /// Windows for the complete mine at the largest scale that fits. A long mine is split into up to
  /// four windows, from left to right, placed below each other with a distance of `gap`. Sizes in
  /// pixels.
  [[nodiscard]] std::vector<PlanWindow> windows(int width, int height_max, int gap) const;

  /// The floor is lit from the upper left, with exaggerated relief.
  [[nodiscard]] RgbImage draw(const PlanWindow& window) const;

 private:
  [[nodiscard]] bool is_open(const Eigen::Vector3f& p_world, PartKind kind) const;

  const World& world_;
  TriangleMesh mesh_;  // without the roof
  RayScene scene_;
  Eigen::Vector3d low_{0.0, 0.0, 0.0};  // of the mesh
  Eigen::Vector3d high_{0.0, 0.0, 0.0};
};

/// Draws the items without a surface over a window of the plan with its upper left corner at
/// `corner` on the sheet: gas, the start and the camera.
void draw_plan_overlay(const Canvas& canvas, const PlanWindow& window,
                       const Eigen::Vector2i& corner, const World& world,
                       const Pose2& T_world_camera);

}  // namespace adit
