// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "procs/terrain/cell_heights.hpp"
#include "procs/terrain/terrain.hpp"
#include "tests/unit/procs/terrain/terrain_scenes.hpp"

namespace adit {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Cloud tunnel_with_post() {
  return cloud_of([](MeshBuilder& builder) {
    add_tunnel(builder);
    add_rock(builder, {5.0, 0.7, 1.0}, {0.2, 0.2, 2.0});
  });
}

bool same(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

bool same(const TerrainCell& a, const TerrainCell& b) {
  return a.ground == b.ground && a.count == b.count && same(a.low_m, b.low_m) &&
         same(a.high_m, b.high_m) && same(a.coefficient_m, b.coefficient_m) &&
         same(a.clearance_m, b.clearance_m) && same(a.slope_rad, b.slope_rad) &&
         same(a.step_m, b.step_m) && same(a.repulsion_m, b.repulsion_m);
}

bool same(const TerrainMap& a, const TerrainMap& b) {
  return std::equal(a.cells.begin(), a.cells.end(), b.cells.begin(), b.cells.end(),
                    [](const TerrainCell& x, const TerrainCell& y) { return same(x, y); });
}

/// Share of equal cells; `other(column, row)` is the cell to compare with.
template <class Other>
double share_alike(const TerrainMap& a, const TerrainMap& b, const Other& other) {
  int alike = 0;
  for (int row = 0; row < a.cells.rows(); ++row) {
    for (int column = 0; column < a.cells.columns(); ++column) {
      const auto [c, r] = other(column, row);
      const TerrainCell& x = a.cells.at({column, row});
      const TerrainCell& y = b.cells.at({c, r});
      const bool near = !(std::abs(x.coefficient_m - y.coefficient_m) > 0.02F);
      alike += x.ground == y.ground && near ? 1 : 0;
    }
  }
  return static_cast<double>(alike) / static_cast<double>(a.cells.size());
}

TerrainParams square() {
  TerrainParams params;
  params.behind_m = params.length_m / 2.0;
  return params;
}

/// The cloud rotated about the z axis through the origin.
Cloud turned(Cloud cloud, float angle_rad) {
  const Eigen::Matrix3f R =
      Eigen::AngleAxisf(angle_rad, Eigen::Vector3f::UnitZ()).toRotationMatrix();
  for (CloudLine& line : cloud.lines) {
    line.origin = R * line.origin;
    for (Eigen::Vector3f& p : line.points) p = R * p;
    for (Eigen::Vector3f& miss : line.misses) miss = R * miss;
  }
  return cloud;
}

TEST(TerrainInput, AnEmptyCloudGivesAnUnobservedMap) {
  Cloud cloud;
  cloud.utime = 5;
  cloud.id = 3;
  cloud.T_odom_level = {1.0, 2.0, 0.5};
  const TerrainMap map = Terrain({}).make(cloud);
  EXPECT_EQ(map.utime, 5);
  EXPECT_EQ(map.id, 3);
  EXPECT_EQ(map.T_odom_level, cloud.T_odom_level);
  EXPECT_EQ(map.cells.columns(), 200);
  EXPECT_EQ(map.cells.rows(), 200);
  ASSERT_EQ(map.cells.size(), 40'000U);
  for (const TerrainCell& cell : map.cells) {
    EXPECT_EQ(cell.ground, Ground::kNeverObserved);
    EXPECT_EQ(cell.count, 0);
    EXPECT_TRUE(std::isnan(cell.low_m) && std::isnan(cell.high_m) && std::isnan(cell.step_m) &&
                std::isnan(cell.coefficient_m) && std::isnan(cell.slope_rad) &&
                std::isnan(cell.clearance_m));
    EXPECT_EQ(cell.repulsion_m, 0.0F);
  }
}

TEST(TerrainInput, UnusablePointsAreSkippedAndCounted) {
  const Cloud good = tunnel_with_post();
  EXPECT_EQ(unusable_points(good), 0U);
  Cloud bad = good;
  for (CloudLine& line : bad.lines) {
    line.points.insert(line.points.begin(), {kNaN, 0.0F, 0.0F});
    line.points.emplace_back(3.0F, 0.0F, kInfinity);
    line.points.emplace_back(3.0F, 0.0F, 1e30F);
    line.points.emplace_back(-1e9F, 0.0F, 0.5F);
    line.misses.emplace_back(kNaN, kNaN, -0.5F);
  }
  EXPECT_EQ(unusable_points(bad), 5 * bad.lines.size());
  EXPECT_TRUE(same(Terrain({}).make(bad), Terrain({}).make(good)));
}

TEST(TerrainInput, ALineWithAnInvalidOriginDoesNotAffectTheOthers) {
  Cloud cloud = tunnel_with_post();
  CloudLine lost;
  lost.origin = {kNaN, kNaN, kNaN};
  lost.points.emplace_back(3.0F, 0.0F, 0.0F);
  lost.misses.emplace_back(0.0F, 0.0F, -1.0F);
  cloud.lines.insert(cloud.lines.begin(), lost);
  const TerrainMap map = Terrain({}).make(cloud);
  EXPECT_EQ(cell_at(map, 5.0, -0.5).ground, Ground::kObserved);
}

TEST(TerrainInput, TheSameCloudGivesTheSameBytes) {
  const Cloud cloud = tunnel_with_post();
  EXPECT_TRUE(same(Terrain({}).make(cloud), Terrain({}).make(cloud)));
}

TEST(TerrainInput, TheOrderOfTheLinesDoesNotMatter) {
  Cloud cloud = tunnel_with_post();
  const TerrainMap map = Terrain({}).make(cloud);
  std::reverse(cloud.lines.begin(), cloud.lines.end());
  const auto itself = [](int column, int row) { return std::pair(column, row); };
  // Up to rounding: the mean of the origins is summed in another order.
  EXPECT_GT(share_alike(map, Terrain({}).make(cloud), itself), 0.999);
}

// Points at the edge of a cell, and beams at the edge of a sector, may be assigned to either side.
constexpr double kAlikeShareMin = 0.97;

TEST(TerrainInput, ARotatedCloudGivesARotatedMap) {
  const Cloud cloud = tunnel_with_post();
  const TerrainMap map = Terrain(square()).make(cloud);
  const TerrainMap left = Terrain(square()).make(turned(cloud, std::numbers::pi_v<float> / 2.0F));
  EXPECT_GT(
      share_alike(map, left, [&](int c, int r) { return std::pair(map.cells.rows() - 1 - r, c); }),
      kAlikeShareMin);
  const TerrainMap back = Terrain(square()).make(turned(cloud, std::numbers::pi_v<float>));
  EXPECT_GT(share_alike(map, back,
                        [&](int c, int r) {
                          return std::pair(map.cells.columns() - 1 - c, map.cells.rows() - 1 - r);
                        }),
            kAlikeShareMin);
}

TEST(TerrainInput, AMapWithAnotherOriginHasTheSameCells) {
  const Cloud cloud = tunnel_with_post();
  TerrainParams shifted;
  shifted.behind_m += 1.0;  // ten cells
  const TerrainMap map = Terrain({}).make(cloud);
  const TerrainMap other = Terrain(shifted).make(cloud);
  int alike = 0;
  for (int row = 0; row < map.cells.rows(); ++row) {
    for (int column = 0; column + 10 < map.cells.columns(); ++column) {
      alike +=
          map.cells.at({column, row}).ground == other.cells.at({column + 10, row}).ground ? 1 : 0;
    }
  }
  EXPECT_GT(alike, kAlikeShareMin * map.cells.rows() * (map.cells.columns() - 10));
}

}  // namespace
}  // namespace adit
