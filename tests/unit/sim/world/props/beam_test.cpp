// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/sim/world/props/prop_scene.hpp"

namespace adit {
namespace {

const Eigen::Vector3d kAhead = Eigen::Vector3d::UnitX();
const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

PropDescriptions with_beam() {
  PropDescriptions props;
  props.beams.push_back({.tunnel = "main", .at_m = 30.0, .cables = 1});
  return props;
}

TEST(Beam, SpansTheTunnelFromTheFloorToItsHighEnd) {
  const PropScene scene(with_beam());
  const Obstacle* beam = scene.obstacle("beam");
  ASSERT_NE(beam, nullptr);
  const auto [right, left] = std::minmax_element(
      beam->outline.begin(), beam->outline.end(),
      [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.y() < b.y(); });
  EXPECT_LE(right->y(), -2.0);
  EXPECT_GE(left->y(), 2.0);
  // The middle of the upper end is at 1.6 m, its edges half a thickness of 0.25 m around.
  EXPECT_NEAR(beam->z_high_m, 1.6 + 0.125, 0.02);  // tilted by less than 0.4: 0.125 (1 − cos)
  EXPECT_NEAR(beam->z_low_m, 0.0, 0.02);
}

TEST(Beam, BlocksRaysAtTheHeightOfItsSlope) {
  const PropScene scene(with_beam());
  // In the centre of the tunnel its height is the mean of 0.125 m and 1.6 m.
  const auto up = scene.range({30.0, 0.0, 0.0}, kUp);
  ASSERT_TRUE(up.has_value());
  const double tilt = std::atan2(1.6 - 0.125, 4.2 / std::cos(0.3));
  EXPECT_NEAR(*up, (1.6 + 0.125) / 2.0 - 0.125 / std::cos(tilt), 1e-3);
}

TEST(Cable, HangsAsAParabolaWithTheGivenSag) {
  const PropScene scene(with_beam());
  const Obstacle* cable = scene.obstacle("cable");
  ASSERT_NE(cable, nullptr);
  EXPECT_NEAR(cable->z_low_m, 2.0 - 0.9 - 0.015, 1e-3);
  EXPECT_NEAR(cable->z_high_m, 2.0 + 0.015, 0.005);  // its ends are cut at right angles to it
  // The centres of all cross-sections of 8 vertices are on the parabola.
  const auto& mesh = scene.world.mesh;
  const auto part = std::find_if(mesh.parts.begin(), mesh.parts.end(),
                                 [](const Part& p) { return p.kind == PartKind::kCable; });
  ASSERT_NE(part, mesh.parts.end());
  const std::size_t rings = 101;
  const std::size_t first = mesh.vertices.size() - 8 * rings;
  for (std::size_t i = 0; i < rings; ++i) {
    Eigen::Vector3d middle(0.0, 0.0, 0.0);
    for (std::size_t k = 0; k < 8; ++k) {
      middle += mesh.vertices[first + 8 * i + k].cast<double>() / 8.0;
    }
    const double share = (middle.x() - 27.5) / 5.0;
    EXPECT_NEAR(middle.z(), 2.0 - 4.0 * 0.9 * share * (1.0 - share), 1e-4);
    EXPECT_NEAR((mesh.vertices[first + 8 * i].cast<double>() - middle).norm(), 0.015, 1e-4);
  }
}

TEST(Cable, HasItsDiameterForRays) {
  const PropScene scene(with_beam());
  // Rays down to and up to the lowest point of the cable: the difference is its diameter.
  const auto& cable = *scene.obstacle("cable");
  double y = 0.0;
  for (const Eigen::Vector2d& p : cable.outline) {
    y += p.y() / static_cast<double>(cable.outline.size());
  }
  double thickest = 0.0;
  for (double aside = -0.5; aside <= 0.5; aside += 0.002) {
    const auto down = scene.range({29.0, y + aside, 2.0}, -kUp);
    const auto up = scene.range({29.0, y + aside, 0.9}, kUp);
    if (!down || !up || *down > 1.0) continue;
    thickest = std::max(thickest, 1.1 - *down - *up);
  }
  // A regular octagon is between cos(22.5°) and 1 of its diameter; vertical through a slope of
  // 4 · 0.9 · 0.4 / 5 it is thicker by 1/cos.
  const double slope = 4.0 * 0.9 * (1.0 - 2.0 * 0.3) / 5.0;
  EXPECT_NEAR(thickest, 0.03 * std::hypot(1.0, slope), 0.0025);
}

}  // namespace
}  // namespace adit
