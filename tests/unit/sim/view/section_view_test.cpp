// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view/section_view.hpp"

#include <gtest/gtest.h>

#include "sim/view/render.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {
namespace {

const RgbImage::Pixel kRock = to_pixel(linear(SectionView::kRock));
const TunnelLine kMiddle{"middle", {{-20.0, 0.0}, {20.0, 0.0}}, 4.0, false};

/// A picture of the single window.
struct Section {
  Section(const Site& site, const TunnelLine& line)
      : window(SectionView(site, line).windows(1000).front()),
        image(SectionView(site, line).draw(window)) {}

  [[nodiscard]] RgbImage::Pixel at(double s_m, double z_m) const {
    const Eigen::Vector2d uv = window.pixel(s_m, z_m);
    return image.at(static_cast<int>(uv.x()), static_cast<int>(uv.y()));
  }

  SectionWindow window;
  RgbImage image;
};

TEST(SectionView, RockIsDarkAndTheOpeningLight) {
  const Site site(box_tunnel({40.0, 4.0, 2.0}));
  const Section section(site, kMiddle);
  EXPECT_NEAR(section.window.pixels_per_metre, 25.0, 1e-9);  // 1000 pixels for 40 m
  EXPECT_EQ(section.window.exaggeration, 1.0);               // 2 m are 50 pixels, enough to be seen
  // Half a metre of rock above and below.
  EXPECT_NEAR(section.window.z_low_m, -0.5, 1e-3);
  EXPECT_NEAR(section.window.z_high_m, 2.5, 1e-3);
  for (const double s : {1.0, 20.0, 39.0}) {
    EXPECT_EQ(section.at(s, -0.3), kRock);
    EXPECT_EQ(section.at(s, 2.3), kRock);
    EXPECT_GT(section.at(s, 1.0)[0], 2 * kRock[0]);
  }
}

TEST(SectionView, ShowsAPropBehindTheCutAndNoneInFrontOfIt) {
  const Site site(box_tunnel({40.0, 4.0, 2.0}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kCar, Material::kSteel, "left");
    builder.box(level_box({-5.0, 1.0, 0.5}, {2.0, 1.0, 1.0}));
    builder.begin_part(PartKind::kCar, Material::kSteel, "right");
    builder.box(level_box({5.0, -1.0, 0.5}, {2.0, 1.0, 1.0}));
  }));
  const Section section(site, kMiddle);
  const RgbImage::Pixel car = to_pixel(plain_colour({PartKind::kCar, Material::kSteel, ""}));
  EXPECT_EQ(section.at(15.0, 0.5), car);  // seen squarely
  EXPECT_EQ(section.at(25.0, 0.5), section.at(20.0, 0.5));
  EXPECT_EQ(section.at(15.0, 1.5), section.at(20.0, 1.5));
}

TEST(SectionView, ExaggeratesHeightsInALongMine) {
  const Site site(box_tunnel({400.0, 4.0, 2.0}));
  const TunnelLine line{"middle", {{-200.0, 0.0}, {200.0, 0.0}}, 4.0, false};
  const auto windows = SectionView(site, line).windows(1000);
  ASSERT_EQ(windows.size(), 4U);
  EXPECT_NEAR(windows[0].pixels_per_metre, 10.0, 1e-9);
  EXPECT_EQ(windows[0].exaggeration, 2.0);  // 20 pixels are too few
  EXPECT_NEAR(windows[3].to_m, 400.0, 1e-9);
}

TEST(SectionLine, GoesFromWallToWallWithoutATunnelGraph) {
  World world = box_tunnel({40.0, 4.0, 2.0}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kPost, Material::kTimber, "post");
    builder.bar({3.0, 0.0, 0.0}, {3.0, 0.0, 2.0}, 0.1);
  });
  world.T_world_start = {2.0, 1e-3, 0.0};
  const Site site(std::move(world));
  const TunnelLine line = section_line(site, {});
  ASSERT_EQ(line.points.size(), 2U);
  EXPECT_NEAR(line.points[0].x(), -20.5, 0.02);  // half a metre into the rock
  EXPECT_NEAR(line.points[1].x(), 20.5, 0.02);   // and not at the post
}

TEST(SectionLine, FollowsTheTunnelAtTheStartAlongItsEdges) {
  World world = box_tunnel();
  world.T_world_start = {-10.0, 0.0, 0.0};
  world.truth.tunnels.nodes.resize(4);
  world.truth.tunnels.edges = {{0, 1, {{-20.0, 0.0}, {0.0, 0.0}}, 20.0, 4.0, "main"},
                               {1, 3, {{0.0, 0.0}, {0.0, 9.0}}, 9.0, 4.0, "side"},
                               {1, 2, {{0.0, 0.0}, {20.0, 0.0}}, 20.0, 4.0, "main"}};
  const Site site(std::move(world));
  EXPECT_EQ(section_line(site, {}).name, "along main");
  EXPECT_NEAR(section_line(site, {}).length_m(), 40.0, 1e-9);
  ViewOptions options;
  options.section = {{0.0, 0.0}, {0.0, 9.0}};
  EXPECT_NEAR(section_line(site, options).length_m(), 9.0, 1e-9);
}

}  // namespace
}  // namespace adit
