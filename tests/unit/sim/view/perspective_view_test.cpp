// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view/perspective_view.hpp"

#include <gtest/gtest.h>

#include "sim/view/render.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {
namespace {

Eigen::Isometry3d level(const Eigen::Vector3d& eye, double heading_rad) {
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.translation() = eye;
  T_world_camera.rotate(Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()));
  return T_world_camera;
}

/// Much more red than blue: only timber in the light of a lamp.
bool is_timber(const RgbImage::Pixel& pixel) { return pixel[0] > pixel[2] + 40; }

TEST(Camera, ProjectionInvertsTheRay) {
  const Camera camera(level({1.0, 2.0, 3.0}, 0.7), 1.2, 640, 480);
  for (const Eigen::Vector2d& uv : {Eigen::Vector2d(320.0, 240.0), {10.5, 20.5}, {600.0, 400.0}}) {
    const Ray ray = camera.ray(uv);
    const auto pixel = camera.pixel((ray.origin + 7.0F * ray.direction).cast<double>());
    ASSERT_TRUE(pixel);
    EXPECT_LT((*pixel - uv).norm(), 1e-3);  // rays are in single precision
  }
  EXPECT_FALSE(camera.pixel(camera.eye() - camera.T_world_camera().linear().col(0)));
}

TEST(Camera, FieldOfViewIsHorizontal) {
  const Camera camera(level({0.0, 0.0, 0.0}, 0.0), 2.0 * std::atan(0.5), 400, 300);
  // At 10 m ahead 5 m to the left is the left edge, 3.75 m up the upper one.
  EXPECT_LT((*camera.pixel({10.0, 5.0, 3.75}) - Eigen::Vector2d(0.0, 0.0)).norm(), 1e-9);
}

TEST(PerspectiveView, APostIsAtItsProjection) {
  const Site site(box_tunnel({40.0, 4.0, 2.0}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kPost, Material::kTimber, "post");
    builder.bar({5.0, 1.0, 0.0}, {5.0, 1.0, 2.0}, 0.1, 24);
  }));
  const Camera camera(level({0.0, 0.0, 1.2}, 0.0), 1.2, 320, 200);
  const RgbImage image = perspective_view(site.scene(), camera);
  const Eigen::Vector2d middle = *camera.pixel({5.0, 1.0, 1.0});
  const int row = static_cast<int>(middle.y());
  EXPECT_TRUE(is_timber(image.at(static_cast<int>(middle.x()), row)));
  // A post of 0.1 m at 5.1 m is 4.6 pixels to either side.
  EXPECT_FALSE(is_timber(image.at(static_cast<int>(middle.x()) - 8, row)));
  EXPECT_FALSE(is_timber(image.at(static_cast<int>(middle.x()) + 8, row)));
}

TEST(PerspectiveView, DistantSurfacesAreDarker) {
  const Site site(box_tunnel({200.0, 4.0, 2.0}));
  const Camera camera(level({0.0, 0.0, 1.2}, 0.0), 1.2, 320, 200);
  const RgbImage image = perspective_view(site.scene(), camera);
  const Eigen::Vector2d near = *camera.pixel({4.0, 0.0, 0.0});
  const Eigen::Vector2d far = *camera.pixel({40.0, 0.0, 0.0});
  EXPECT_GT(image.at(160, static_cast<int>(near.y()))[0],
            2 * image.at(160, static_cast<int>(far.y()))[0]);
}

TEST(PerspectiveView, AnObjectCastsAShadow) {
  const auto seen = [](bool with_board) {
    const Site site(box_tunnel({16.0, 8.0, 3.0}, [&](MeshBuilder& builder) {
      builder.begin_part(PartKind::kCar, Material::kSteel, "board");
      if (with_board) builder.box(level_box({4.0, 0.0, 1.2}, {0.02, 0.4, 0.4}));
    }));
    const Camera camera(level({0.0, 0.0, 1.2}, 0.0), 1.2, 320, 200);
    // The lamp is 0.45 m to the left and 0.3 m above the camera: on the wall, as far behind the
    // board as the board is from the lamp, the shadow is the board twice as large around (−0.45,
    // 0.9). The board itself hides what is up to 0.4 m to the right.
    const Eigen::Vector2d uv = *camera.pixel({8.0, -0.6, 0.9});
    return perspective_view(site.scene(), camera)
        .at(static_cast<int>(uv.x()), static_cast<int>(uv.y()));
  };
  EXPECT_LT(seen(true)[0], 0.8 * seen(false)[0]);
}

TEST(PerspectiveView, TheCameraIsBehindTheStartWithinFreeSpace) {
  World world = box_tunnel();
  const Site roomy(world);
  const ViewOptions options;
  const Eigen::Vector3d eye = camera_of(roomy, options, 320, 200).eye();
  EXPECT_LT((eye - Eigen::Vector3d(-2.0, 0.0, 1.2)).norm(), 1e-6);

  world.T_world_start = {-19.0, 0.0, 0.0};  // a metre before the wall, of which it keeps 0.5 m
  const Site tight(world);
  EXPECT_NEAR(camera_of(tight, options, 320, 200).eye().x(), -19.5, 1e-5);
}

TEST(PerspectiveView, RaysWithoutAHitShowTheSky) {
  const TriangleMesh nothing;
  const RayScene scene(nothing);
  const RgbImage image = perspective_view(scene, Camera(level({0.0, 0.0, 1.0}, 0.0), 1.2, 32, 20));
  EXPECT_EQ(image.at(3, 4), image.at(30, 19));
  EXPECT_GT(image.at(3, 4)[0], 200);
}

}  // namespace
}  // namespace adit
