// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view/plan_view.hpp"

#include <gtest/gtest.h>

#include "sim/view/render.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {
namespace {

/// The single window and a picture of it.
struct Plan {
  explicit Plan(const World& world)
      : view(world), windows(view.windows(1000, 400, 10)), image(view.draw(windows.front())) {}

  [[nodiscard]] RgbImage::Pixel at(double x, double y) const {
    const Eigen::Vector2d uv = windows.front().pixel({x, y});
    return image.at(static_cast<int>(uv.x()), static_cast<int>(uv.y()));
  }

  PlanView view;
  std::vector<PlanWindow> windows;
  RgbImage image;
};

const RgbImage::Pixel kRock = to_pixel(linear(PlanView::kRock));

/// Colour of a wide level floor: light from the upper left at its height (1.6 of the length of (−1,
/// 1, 1.6)) and from all around.
RgbImage::Pixel level_floor() {
  const float light = 0.55F + 0.75F * 1.6F / std::sqrt(1.0F + 1.0F + 1.6F * 1.6F);
  return to_pixel(light * plain_colour({PartKind::kFloor, Material::kRock, ""}));
}

TEST(PlanView, ShowsFloorAndRock) {
  // A room of 20 m by 10 m: 24 m by 14 m with the margin, at 400 / 14 pixels for a metre.
  const Plan plan(box_tunnel({20.0, 10.0, 2.0}));
  ASSERT_EQ(plan.windows.size(), 1U);
  EXPECT_NEAR(plan.windows[0].pixels_per_metre, 400.0 / 14.0, 1e-9);
  EXPECT_EQ(plan.at(0.0, 0.0), level_floor());
  EXPECT_EQ(plan.at(-6.0, 3.0), level_floor());
  for (const auto& [x, y] : {std::pair(0.0, 5.5), {0.0, -5.5}, {10.5, 0.0}, {-10.5, 3.0}}) {
    EXPECT_EQ(plan.at(x, y), kRock) << x << ", " << y;
  }
}

TEST(PlanView, XIsToTheRightAndYUp) {
  const Plan plan(box_tunnel({20.0, 10.0, 2.0}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kCar, Material::kSteel, "car");
    builder.box(level_box({6.0, 2.0, 0.5}, {2.0, 1.0, 1.0}));
  }));
  EXPECT_GT(plan.at(6.0, 2.0)[0], plan.at(6.0, 2.0)[2]);  // rusty, and above the floor's light
  EXPECT_NE(plan.at(6.0, 2.0), level_floor());
  EXPECT_EQ(plan.at(-6.0, 2.0), level_floor());
  EXPECT_EQ(plan.at(6.0, -2.0), level_floor());
}

TEST(PlanView, OmitsTheRoofAndShowsObjectsBelowIt) {
  const Plan plan(box_tunnel({20.0, 10.0, 2.0}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kBeam, Material::kTimber, "beam");
    builder.box(level_box({0.0, 0.0, 1.9}, {0.3, 8.0, 0.2}));
  }));
  EXPECT_NE(plan.at(0.0, 3.0), level_floor());
  EXPECT_EQ(plan.at(5.0, 3.0), level_floor());
}

TEST(PlanView, GuessesTheRoofOfAnImportedMesh) {
  World world = box_tunnel({20.0, 10.0, 2.0});
  const RgbImage::Pixel known = Plan(world).at(0.0, 0.0);
  for (Part& part : world.mesh.parts) part.kind = PartKind::kOther;
  const RgbImage::Pixel guessed = Plan(world).at(0.0, 0.0);
  const Rgb other = plain_colour(world.mesh.parts[0]);
  const Rgb floor = plain_colour({PartKind::kFloor, Material::kRock, ""});
  EXPECT_EQ(known, level_floor());
  // The same light on another colour; bytes are rounded.
  EXPECT_NEAR(guessed[0], known[0] * std::pow(other.x() / floor.x(), 1.0F / 2.2F), 1.0);
}

TEST(PlanView, SplitsALongMineIntoWindowsOfOneScale) {
  const World world = box_tunnel({400.0, 4.0, 2.0});
  const PlanView view(world);
  const auto windows = view.windows(1000, 400, 10);
  ASSERT_EQ(windows.size(), 4U);
  for (std::size_t i = 1; i < windows.size(); ++i) {
    EXPECT_NEAR(windows[i].low.x(), windows[i - 1].high.x(), 1e-9);
    EXPECT_EQ(windows[i].pixels_per_metre, windows[0].pixels_per_metre);
  }
  EXPECT_NEAR(windows[0].pixels_per_metre, 4.0 * 1000.0 / 404.0, 1e-9);
}

TEST(PlanView, PixelAndPointConversionsAreInverse) {
  const PlanWindow window{{-3.0, 2.0}, {7.0, 12.0}, 20.0};
  EXPECT_EQ(window.pixel({-3.0, 12.0}), Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(window.pixel({7.0, 2.0}), Eigen::Vector2d(window.width(), window.height()));
  const Eigen::Vector2d p(1.25, 4.5);
  EXPECT_LT((window.p_world(window.pixel(p)) - p).norm(), 1e-12);
}

}  // namespace
}  // namespace adit
