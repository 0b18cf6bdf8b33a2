// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/terrain.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/unit/procs/terrain/terrain_scenes.hpp"

namespace adit {
namespace {

// Error of a height: the systematic error of the laser of at most 15 mm, its noise of 5 mm and its
// resolution of 10 mm, of which at most half affects the height for beams to the ground and to low
// obstacles.
constexpr double kNoise = 0.03;
const Eigen::AlignedBox2d kAhead(Eigen::Vector2d(2.5, -1.5), Eigen::Vector2d(7.5, 1.5));

TerrainMap map_of(const Cloud& cloud, const std::string& estimator = "kth") {
  TerrainParams params;
  params.estimator.kind = estimator;
  return Terrain(params).make(cloud);
}

Cloud tunnel_with(const std::function<void(MeshBuilder&)>& add) {
  return cloud_of([&](MeshBuilder& builder) {
    add_tunnel(builder);
    add(builder);
  });
}

class OfBothEstimators : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Terrain, OfBothEstimators, testing::Values("kth", "paper"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(OfBothEstimators, FlatGroundHasALowCoefficient) {
  const TerrainMap map = map_of(cloud_of(add_tunnel), GetParam());
  for_cells(map, kAhead, [](const TerrainCell& cell) {
    EXPECT_EQ(cell.ground, Ground::kObserved);
    EXPECT_LT(cell.coefficient_m, kNoise);
    EXPECT_NEAR(cell.low_m, 0.0, kNoise);
    EXPECT_LT(cell.step_m, kNoise);
    // Two rows of the plane, 0.4 m apart, that differ by no more than half the noise.
    EXPECT_LT(cell.slope_rad, 0.04);
  });
}

TEST_P(OfBothEstimators, TheCoefficientOfABoxIsItsHeight) {
  const auto box = [](MeshBuilder& builder) {
    add_rock(builder, {5.0, 0.5, 0.15}, {0.6, 0.6, 0.3});
  };
  const TerrainMap map = map_of(tunnel_with(box), GetParam());
  const Eigen::AlignedBox2d above(Eigen::Vector2d(4.7, 0.2), Eigen::Vector2d(5.3, 0.8));
  // Where a region begins at the face of the box, its lowest height may pass for rising ground: by
  // a quarter over two cells, and the noise.
  constexpr double kRise = 0.25 * 0.2 + kNoise;
  for_cells(map, above, [](const TerrainCell& cell) {
    EXPECT_NEAR(cell.coefficient_m, 0.3, kRise);
    EXPECT_NEAR(cell.low_m, 0.0, kRise);
  });
  EXPECT_LT(cell_at(map, 4.35, 0.5).coefficient_m, kNoise);
}

TEST_P(OfBothEstimators, RailsAreObstaclesAndTheGroundBetweenThemIsNot) {
  const auto rails = [](MeshBuilder& builder) {
    for (const double y : {-0.45, 0.45}) add_rock(builder, {0.0, y, 0.05}, {28.0, 0.06, 0.1});
  };
  const TerrainMap map = map_of(tunnel_with(rails), GetParam());
  const Eigen::AlignedBox2d rail(Eigen::Vector2d(2.5, 0.4), Eigen::Vector2d(4.5, 0.5));
  for_cells(map, rail,
            [](const TerrainCell& cell) { EXPECT_NEAR(cell.coefficient_m, 0.1, kNoise); });
  const Eigen::AlignedBox2d between(Eigen::Vector2d(2.5, -0.2), Eigen::Vector2d(4.5, 0.2));
  for_cells(map, between, [](const TerrainCell& cell) { EXPECT_LT(cell.coefficient_m, kNoise); });
}

TEST_P(OfBothEstimators, AThinHangingCableIsAnObstacle) {
  const auto cable = [](MeshBuilder& builder) {
    builder.bar({4.05, -1.9, 0.8}, {4.05, 1.9, 0.8}, 0.015);
  };
  const TerrainMap map = map_of(tunnel_with(cable), GetParam());
  const Eigen::AlignedBox2d below(Eigen::Vector2d(4.0, -1.5), Eigen::Vector2d(4.1, 1.5));
  for_cells(map, below, [](const TerrainCell& cell) {
    EXPECT_NEAR(cell.coefficient_m, 0.8, 0.015 + kNoise);  // the radius of the cable
  });
}

TEST_P(OfBothEstimators, ObstaclesAboveTheVehicleLimitTheClearanceOnly) {
  const auto low_roof = [](MeshBuilder& builder) {
    add_rock(builder, {7.5, 0.0, 1.65}, {5.0, 4.0, 1.2});
  };
  const TerrainMap map = map_of(tunnel_with(low_roof), GetParam());
  const Eigen::AlignedBox2d below(Eigen::Vector2d(5.2, -1.5), Eigen::Vector2d(6.0, 1.5));
  for_cells(map, below, [](const TerrainCell& cell) {
    EXPECT_LT(cell.coefficient_m, kNoise);
    EXPECT_NEAR(cell.clearance_m, 1.05, kNoise);
  });
}

TEST_P(OfBothEstimators, ALowRoofIsAnObstacleAndAHighOneIsClearance) {
  const auto low_roof = [](MeshBuilder& builder) {
    add_rock(builder, {7.5, 0.0, 1.4}, {5.0, 4.0, 1.2});
  };
  const TerrainMap map = map_of(tunnel_with(low_roof), GetParam());
  const Eigen::AlignedBox2d edge(Eigen::Vector2d(5.0, -1.5), Eigen::Vector2d(5.1, 1.5));
  for_cells(map, edge, [](const TerrainCell& cell) { EXPECT_GT(cell.coefficient_m, 0.75); });
  const Eigen::AlignedBox2d high(Eigen::Vector2d(3.6, -1.0), Eigen::Vector2d(4.4, 1.0));
  for_cells(map, high, [](const TerrainCell& cell) {
    EXPECT_LT(cell.coefficient_m, kNoise);
    EXPECT_NEAR(cell.clearance_m, 2.0, kNoise);
  });
}

TEST(Terrain, TheRoofIsNotGroundWhereTheGroundIsOccluded) {
  const auto block = [](MeshBuilder& builder) {
    add_rock(builder, {3.0, 0.0, 0.5}, {0.4, 3.9, 1.0});
  };
  const TerrainMap map = map_of(tunnel_with(block));
  const Eigen::AlignedBox2d behind(Eigen::Vector2d(3.6, -1.5), Eigen::Vector2d(4.4, 1.5));
  for_cells(map, behind,
            [](const TerrainCell& cell) { EXPECT_EQ(cell.ground, Ground::kOccluded); });
}

TEST(Terrain, MeasuresTheSlopeOfARamp) {
  const double grade = std::tan(10.0 * std::numbers::pi / 180.0);
  const auto ramp = [&](MeshBuilder& builder) {
    add_ground(builder, -5.0, 3.0);
    const std::array corners{builder.vertex({3.0F, -2.0F, 0.0F}),
                             builder.vertex({13.0F, -2.0F, static_cast<float>(10.0 * grade)}),
                             builder.vertex({13.0F, 2.0F, static_cast<float>(10.0 * grade)}),
                             builder.vertex({3.0F, 2.0F, 0.0F})};
    builder.quad(corners[0], corners[1], corners[2], corners[3]);
  };
  const TerrainMap map = map_of(cloud_of(ramp));
  const Eigen::AlignedBox2d on_it(Eigen::Vector2d(3.5, -1.5), Eigen::Vector2d(8.0, 1.5));
  double sum = 0.0;
  int cells = 0;
  for_cells(map, on_it, [&](const TerrainCell& cell) {
    ASSERT_EQ(cell.ground, Ground::kObserved);
    sum += cell.slope_rad;
    ++cells;
    EXPECT_NEAR(cell.slope_rad, 0.1745, 0.06);  // as on flat ground, plus the line spacing
    EXPECT_LT(cell.coefficient_m, 0.3 * grade + kNoise);  // the rise within a region
  });
  EXPECT_NEAR(sum / cells, 0.1745, 0.01);  // errors of single cells have both signs
}

/// A vehicle that stands on a plane which rises ahead of it.
Cloud cloud_on_slope(double grade, const std::function<void(MeshBuilder&)>& add) {
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
  T_world_body.rotate(Eigen::AngleAxisd(-std::atan(grade), Eigen::Vector3d::UnitY()));
  const auto with_slope = [&](MeshBuilder& builder) {
    const auto corner = [&](float x, float y) {
      return builder.vertex({x, y, static_cast<float>(grade) * x});
    };
    builder.quad(corner(-15, -2), corner(15, -2), corner(15, 2), corner(-15, 2));
    add(builder);
  };
  return cloud_of(with_slope, T_world_body);
}

/// Where each region has points of several lines.
const Eigen::AlignedBox2d kNear(Eigen::Vector2d(2.5, -1.4), Eigen::Vector2d(5.5, 1.4));

TEST(Terrain, ASlopeIsNotRough) {
  for (const double grade : {-0.35, -0.25, 0.15, 0.25, 0.35}) {
    const TerrainMap map = map_of(cloud_on_slope(grade, [](MeshBuilder&) {}));
    for_cells(map, kNear, [&](const TerrainCell& cell) {
      EXPECT_EQ(cell.ground, Ground::kObserved) << grade;
      EXPECT_LT(cell.coefficient_m, kNoise) << grade;
      EXPECT_LT(cell.step_m, kNoise) << grade;
      EXPECT_NEAR(cell.slope_rad, std::atan(std::abs(grade)), 0.04) << grade;  // as on flat ground
    });
  }
}

TEST(Terrain, ARockOnASlopeHasItsHeight) {
  for (const double grade : {-0.25, 0.25}) {
    const auto rock = [&](MeshBuilder& builder) {
      add_rock(builder, {5.0, 0.5, 5.0 * grade + 0.1}, {0.4, 0.4, 0.5});
    };
    const TerrainMap map = map_of(cloud_on_slope(grade, rock));
    // The top is 0.35 m above the ground under its middle; its face, 0.2 m before, 0.05 m less or
    // more.
    EXPECT_NEAR(cell_at(map, 4.85, 0.5).coefficient_m, 0.35, 0.05 + 2.0 * kNoise) << grade;
  }
}

TEST(Terrain, IsLevelForATiltedVehicle) {
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
  T_world_body.rotate(Eigen::AngleAxisd(0.06, Eigen::Vector3d(0.6, 0.8, 0.0)));
  const TerrainMap map = map_of(cloud_of(add_tunnel, T_world_body));
  const double easy = share_of(map, kAhead, [](const TerrainCell& cell) {
    return cell.coefficient_m < kNoise && std::abs(cell.low_m) < kNoise;
  });
  EXPECT_EQ(easy, 1.0);
}

}  // namespace
}  // namespace adit
