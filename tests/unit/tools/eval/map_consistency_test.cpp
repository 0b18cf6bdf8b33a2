// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/map_consistency.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::int64_t kSecond = 1'000'000;
constexpr double kSdX = 0.1;
constexpr double kSdY = 0.2;
constexpr double kSdZ = 0.05;

/// Two local maps 5 m apart, the second 1 m higher.
MapGraph pair_of_local_maps() {
  MapGraph graph;
  graph.poses = {{0.0, 0.0, 0.0}, {5.0, 0.0, 0.0}};
  const Eigen::Vector3d information(1.0 / (kSdX * kSdX), 1.0 / (kSdY * kSdY), 1e4);
  graph.constraints.push_back({{0, 1, {5.0, 0.0, 0.0}, information.asDiagonal()}});
  graph.z_m = {0.0, 1.0};
  graph.z_variance = {0.0, kSdZ * kSdZ};
  return graph;
}

/// The truth by which the second local map has this error, in a world at another place.
Trajectory truth_with(const Eigen::Vector3d& error) {
  const Pose2 T_world_map{30.0, -20.0, 1.2};
  const Pose2 second = T_world_map * Pose2{5.0 - error.x(), -error.y(), 0.3};
  return {{kSecond, T_world_map, 7.0}, {2 * kSecond, second, 8.0 - error.z()}};
}

std::optional<MapConsistency> consistency(const Eigen::Vector3d& error) {
  return score_consistency(pair_of_local_maps(), {{0, kSecond}, {1, 2 * kSecond}},
                           truth_with(error));
}

TEST(MapConsistency, NormalisesEachErrorByItsStandardDeviation) {
  const auto found = consistency({kSdX, -2.0 * kSdY, 3.0 * kSdZ});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->local_maps, 1U);
  EXPECT_NEAR(found->normalised_error_squared, 1.0 + 4.0 + 9.0, 1e-6);
}

TEST(MapConsistency, CountsWhatLiesInTheInterval) {
  const auto inside = consistency({1.9 * kSdX, 0.0, -1.9 * kSdZ});
  EXPECT_EQ(inside->in_interval, (std::array<std::size_t, 3>{1, 1, 1}));
  const auto outside = consistency({2.0 * kSdX, -2.0 * kSdY, 2.0 * kSdZ});
  EXPECT_EQ(outside->in_interval, (std::array<std::size_t, 3>{0, 0, 0}));
}

TEST(MapConsistency, CountsWhatLiesInTheEllipsoid) {
  const double share = std::sqrt(7.815 / 3.0);  // of each standard deviation, to its surface
  const Eigen::Vector3d surface(share * kSdX, share * kSdY, share * kSdZ);
  EXPECT_EQ(consistency(0.99 * surface)->in_ellipsoid, 1U);
  EXPECT_EQ(consistency(1.01 * surface)->in_ellipsoid, 0U);
}

TEST(MapConsistency, IsUnknownWithoutTruthHeightsOrAConnectedGraph) {
  const std::map<int, std::int64_t> utimes{{0, kSecond}, {1, 2 * kSecond}};
  EXPECT_FALSE(score_consistency(pair_of_local_maps(), utimes, {}));
  MapGraph graph = pair_of_local_maps();
  graph.z_m.clear();
  EXPECT_FALSE(score_consistency(graph, utimes, truth_with({0.0, 0.0, 0.0})));
  graph = pair_of_local_maps();
  graph.constraints.clear();
  EXPECT_FALSE(score_consistency(graph, utimes, truth_with({0.0, 0.0, 0.0})));
}

}  // namespace
}  // namespace adit
