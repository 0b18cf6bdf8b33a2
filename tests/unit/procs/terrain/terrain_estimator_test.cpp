// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "procs/terrain/terrain.hpp"

namespace adit {
namespace {

constexpr double kObstacle = 0.15;  // coefficient from which a cell is an obstacle [m]
constexpr int kApart = 5;           // spacing of the filled cells: regions do not overlap

/// Many single cells of flat ground with the same distribution.
struct Cells {
  int points = 100;
  double sigma_m = 0.01;
  double outlier_share = 0.0;  ///< share of points anywhere in the headroom
  int on_obstacle = 0;         ///< points of each cell on a thin obstacle
};

/// Share of the cells that are classified as obstacles.
double obstacle_share(const Cells& cells, const std::string& estimator) {
  TerrainParams params;
  params.estimator.kind = estimator;
  std::mt19937_64 random(7);
  std::normal_distribution<double> floor(0.0, cells.sigma_m);
  std::uniform_real_distribution<double> anywhere(0.05, 0.95);
  std::bernoulli_distribution outlier(cells.outlier_share);
  Cloud cloud;
  cloud.lines.emplace_back();
  TerrainMap map = Terrain(params).make(cloud);
  for (int row = 2; row < map.cells.rows(); row += kApart) {
    for (int column = 2; column < map.cells.columns(); column += kApart) {
      const Eigen::Vector2d p = map.centre(column, row);
      for (int i = 0; i < cells.points; ++i) {
        const bool away = i < cells.on_obstacle || outlier(random);
        const double z = away ? anywhere(random) : floor(random);
        cloud.lines.front().points.emplace_back(Eigen::Vector3d(p.x(), p.y(), z).cast<float>());
      }
    }
  }
  map = Terrain(params).make(cloud);
  int obstacles = 0;
  int all = 0;
  for (int row = 2; row < map.cells.rows(); row += kApart) {
    for (int column = 2; column < map.cells.columns(); column += kApart, ++all) {
      obstacles += map.cells.at({column, row}).coefficient_m > kObstacle ? 1 : 0;
    }
  }
  return static_cast<double>(obstacles) / all;
}

// Shares are of 1600 cells: three standard deviations are at most 0.04.
constexpr double kChance = 0.04;

TEST(TerrainEstimator, OrderStatisticsIgnoreStrayPointsThatMinimumAndMaximumDoNot) {
  const Cells few{.outlier_share = 0.001};
  EXPECT_NEAR(obstacle_share(few, "paper"), 1.0 - std::pow(1.0 - 0.001 * 0.89, 100), kChance);
  EXPECT_LT(obstacle_share(few, "kth"), 0.003);  // three of 100: 0.0002
  const Cells many{.outlier_share = 0.005};
  EXPECT_NEAR(obstacle_share(many, "paper"), 1.0 - std::pow(1.0 - 0.005 * 0.89, 100), kChance);
  EXPECT_LT(obstacle_share(many, "kth"), 0.03);  // three of 100: 0.014
}

TEST(TerrainEstimator, OrderStatisticsRetainThinObstacles) {
  // All three points must be more than 0.15 m above the ground, the third lowest of which is two
  // standard deviations below its mean.
  const double one = (0.95 - (kObstacle - 0.02)) / 0.9;
  EXPECT_NEAR(obstacle_share({.on_obstacle = 3}, "kth"), std::pow(one, 3), kChance);
  EXPECT_GT(obstacle_share({.on_obstacle = 5}, "kth"), 0.97);
  EXPECT_GT(obstacle_share({.on_obstacle = 3}, "paper"), 0.99);
}

TEST(TerrainEstimator, ASinglePointOfFewCounts) {
  EXPECT_NEAR(obstacle_share({.points = 9, .on_obstacle = 1}, "kth"), 0.8 / 0.9, kChance);
  EXPECT_EQ(obstacle_share({.points = 100, .on_obstacle = 1}, "kth"), 0.0);
  EXPECT_NEAR(obstacle_share({.points = 100, .on_obstacle = 1}, "paper"), 0.8 / 0.9, kChance);
}

}  // namespace
}  // namespace adit
