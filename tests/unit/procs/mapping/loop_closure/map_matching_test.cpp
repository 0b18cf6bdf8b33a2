// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/loop_closure/map_matching.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/unit/procs/mapping/mapped_world.hpp"

namespace adit {
namespace {

using test::walls_of;

RelativePose around(const Pose2& T_older_newer, double sd_m, double sd_rad) {
  return {T_older_newer, Eigen::Vector3d(sd_m * sd_m, sd_m * sd_m, sd_rad * sd_rad).asDiagonal()};
}

std::vector<LoopClosureAlternative> match(const LocalWalls& newer, const LocalWalls& older,
                                          const RelativePose& predicted) {
  return match_maps(newer, {{test::borrowed(older), {}}}, 7, predicted, {});
}

void expect_near(const Pose2& actual, const Pose2& expected, double metres, double radians) {
  const Pose2 error = between(expected, actual);
  EXPECT_LT(error.translation().norm(), metres);
  EXPECT_LT(std::abs(error.theta), radians);
}

class MapMatchingRecovers : public testing::TestWithParam<Pose2> {};

TEST_P(MapMatchingRecovers, AKnownDisplacement) {
  const test::WallWorld mine = test::sample_mine(3);
  const Pose2 T_world_older{8.0, 0.0, 0.0};
  const Pose2 truth{1.0, 0.2, 0.1};
  const auto found = match(walls_of(mine, T_world_older * truth, 5.0, 2),
                           walls_of(mine, T_world_older), around(truth * GetParam(), 1.0, 0.15));
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().older_map, 7);
  expect_near(found.front().T_older_newer, truth, 0.01, 0.003);  // the floor of the model, twice
  EXPECT_GT(found.front().log_likelihood, 15.0);
}

INSTANTIATE_TEST_SUITE_P(Predictions, MapMatchingRecovers,
                         testing::Values(Pose2{}, Pose2{1.5, 1.0, 0.0}, Pose2{-2.0, 0.5, 0.3},
                                         Pose2{0.5, -1.5, -0.4}));

/// A neighbour lies where the displacement to it says, which may be wrong.
TEST(MapMatching, DependsOnTheOlderMapAndNotOnThePlacesOfItsNeighbours) {
  const test::WallWorld mine = test::sample_mine(3);
  const Pose2 T_world_older{8.0, 0.0, 0.0};
  const Pose2 truth{1.0, 0.2, 0.1};
  const LocalWalls older = walls_of(mine, T_world_older);
  const LocalWalls next = walls_of(mine, T_world_older * Pose2{5.0, 0.0, 0.0}, 5.0, 3);
  const LocalWalls newer = walls_of(mine, T_world_older * truth, 5.0, 2);
  const auto found =
      match_maps(newer, {{test::borrowed(older), {}}, {test::borrowed(next), {5.1, 0.0, 0.0}}}, 7,
                 around(truth, 0.3, 0.05), {});
  ASSERT_FALSE(found.empty());
  expect_near(found.front().T_older_newer, truth, 0.01, 0.003);  // the floor of the model, twice
}

/// The newer map lies on the walls of the neighbour only: the match has the error of its place.
TEST(MapMatching, IsAsUnsureAsThePlaceOfTheNeighbourOnWhichItLies) {
  const test::WallWorld mine = test::sample_mine(3);
  const Pose2 T_world_older{8.0, 0.0, 0.0};
  const Pose2 T_older_next{20.0, 0.0, 0.0};
  const Pose2 truth{21.0, 0.2, 0.1};
  const LocalWalls older = walls_of(mine, T_world_older);
  const LocalWalls next = walls_of(mine, T_world_older * T_older_next, 5.0, 3);
  const LocalWalls newer = walls_of(mine, T_world_older * truth, 5.0, 2);
  const Eigen::Vector3d sd(0.1, 0.02, 0.003);
  const auto covariance = [&](const Eigen::Matrix3d& of_next) -> Eigen::Matrix3d {
    const auto found = match_maps(
        newer, {{test::borrowed(older), {}}, {test::borrowed(next), T_older_next, 0.0, of_next}}, 7,
        around(truth, 0.3, 0.05), {});
    EXPECT_FALSE(found.empty());
    if (found.empty()) return Eigen::Matrix3d::Zero();
    return found.front().information.inverse();
  };
  const Eigen::Matrix3d of_next = sd.cwiseAbs2().asDiagonal();
  const Eigen::Matrix3d added = covariance(of_next) - covariance(Eigen::Matrix3d::Zero());
  const Eigen::Matrix3d Ad = adjoint(between(truth, T_older_next));
  const Eigen::Matrix3d expected = Ad * of_next * Ad.transpose();
  EXPECT_TRUE(added.isApprox(expected, 0.02)) << added << "\n\n" << expected;
}

TEST(MapMatching, AddsACovarianceAndLeavesUnknownDirectionsUnknown) {
  const Eigen::Matrix3d information = Eigen::Vector3d(0.0, 400.0, 1e4).asDiagonal();
  const Eigen::Matrix3d added = Eigen::Vector3d(0.04, 0.0075, 3e-4).asDiagonal();
  const Eigen::Matrix3d sum = with_added_covariance(information, added);
  const Eigen::Matrix3d expected =
      Eigen::Vector3d(0.0, 1.0 / (0.0025 + 0.0075), 1.0 / (1e-4 + 3e-4)).asDiagonal();
  EXPECT_TRUE(sum.isApprox(expected, 1e-9)) << sum;
}

/// Far walls show each place the sides of their bumps that face it, which are not the same.
TEST(MapMatching, IsUnsureOfTheDistanceBetweenPlacesThatAreFarFromEachOther) {
  const test::WallWorld mine = test::sample_mine(3);
  const Pose2 T_world_older{8.0, 0.0, 0.0};
  const Pose2 truth{10.0, 0.0, 0.0};
  const LocalWalls older = walls_of(mine, T_world_older);
  const LocalWalls newer = walls_of(mine, T_world_older * truth, 5.0, 2);
  const auto covariance = [&](double far_view_per_m2) -> Eigen::Matrix3d {
    MapMatchingParams params;
    params.refinement.residual_sd_min_m = 1e-4;  // the walls are less rough than lasers are noisy
    params.far_view_per_m2 = far_view_per_m2;
    const auto found =
        match_maps(newer, {{test::borrowed(older), {}}}, 7, around(truth, 0.5, 0.05), params);
    EXPECT_FALSE(found.empty());
    if (found.empty()) return Eigen::Matrix3d::Zero();
    return found.front().information.inverse();
  };
  const auto by_x = [](const TraversedPoint& a, const TraversedPoint& b) {
    return a.p.x() < b.p.x();
  };
  const double apart_m = truth.x + std::ranges::min(newer.path, by_x).p.x() -
                         std::ranges::max(older.path, by_x).p.x();  // along a straight tunnel
  ASSERT_GT(apart_m, 4.0);
  const Eigen::Matrix3d added = covariance(1.0) - covariance(0.0);
  const double roughness_m = std::sqrt(added(0, 0)) / (apart_m * apart_m);
  EXPECT_GT(roughness_m, 1e-4);
  EXPECT_LT(roughness_m, 0.05);
  EXPECT_NEAR(added(1, 1), 0.0, 0.05 * added(0, 0));
  EXPECT_NEAR(added(2, 2), 0.0, 1e-9);
  const Eigen::Matrix3d more = covariance(2.0) - covariance(0.0);
  EXPECT_NEAR(more(0, 0), 4.0 * added(0, 0), 0.01 * added(0, 0));
}

TEST(MapMatching, FindsTheReverseTraversalInAWideGate) {
  const test::WallWorld mine = test::sample_mine(3);
  const Pose2 T_world_older{6.0, 0.0, 0.0};
  const Pose2 truth{7.0, 0.3, std::numbers::pi - 0.1};
  const auto found =
      match(walls_of(mine, T_world_older * truth, 5.0, 2), walls_of(mine, T_world_older),
            around(truth * Pose2{6.0, -4.0, 1.0}, 3.0, 0.7));
  ASSERT_FALSE(found.empty());
  expect_near(found.front().T_older_newer, truth, 0.02, 0.004);
}

TEST(MapMatching, InformationIsConsistentWithTheError) {
  // The expectation is 3; the result is smaller, since the model allows for bent maps and rough
  // walls, which these are not: the error here is a tenth of floor_m.
  const test::WallWorld mine = test::sample_mine(5);
  double sum = 0.0;
  constexpr int kSeeds = 30;
  for (int seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    const Pose2 T_world_older{8.0 + 3.0 * u(random), 0.2 * u(random), 0.1 * u(random)};
    const Pose2 truth{u(random), 0.2 * u(random), 0.2 * u(random)};
    const auto found =
        match(walls_of(mine, T_world_older * truth, 5.0, 2 * seed + 2),
              walls_of(mine, T_world_older, 5.0, 2 * seed + 1), around(truth, 0.3, 0.05));
    ASSERT_FALSE(found.empty());
    const Eigen::Vector3d error = between(truth, found.front().T_older_newer).vector();
    sum += error.dot(found.front().information * error) / kSeeds;
  }
  EXPECT_GT(sum, 0.02);
  EXPECT_LT(sum, 3.5);
}

TEST(MapMatching, GivesNoInformationAlongAStraightTunnel) {
  const test::WallWorld tunnel = test::straight_tunnel(400.0, 3.0);
  for (const double heading : {0.0, 0.05, -0.1}) {
    const Pose2 T_world_older{0.0, 0.2, heading};
    const Pose2 truth = T_world_older.inverse() * Pose2{2.0, 0.1, heading + 0.1};
    const Pose2 predicted = truth * Pose2{0.5, 0.1, 0.05};
    const auto found = match(walls_of(tunnel, T_world_older * truth, 5.0, 2),
                             walls_of(tunnel, T_world_older), around(predicted, 0.7, 0.1));
    ASSERT_EQ(found.size(), 1U) << heading;
    const auto& [older, T_older_newer, information, log_likelihood] = found.front();
    const double theta = (T_world_older * T_older_newer).theta;
    const Eigen::Vector3d axis_newer(std::cos(theta), -std::sin(theta), 0.0);
    const Eigen::Vector3d across_newer(std::sin(theta), std::cos(theta), 0.0);
    EXPECT_LT(axis_newer.dot(information * axis_newer), 1.0);      // less than that of 1 m
    EXPECT_GT(across_newer.dot(information * across_newer), 8e3);  // that of floor_m
    const Pose2 error = between(T_world_older * truth, T_world_older * T_older_newer);
    EXPECT_LT(std::abs(Eigen::Vector3d(error.x, error.y, 0.0).dot(across_newer)), 0.02);
    EXPECT_LT(std::abs(error.theta), 0.004);
    // Along the tunnel, the pose is the prediction.
    const Pose2 moved = between(predicted, T_older_newer);
    EXPECT_LT(std::abs(moved.vector().dot(axis_newer)), 0.1);
  }
}

/// A straight tunnel with a recess on one side at each of the given positions.
test::WallWorld tunnel_with_recesses(const std::vector<double>& at) {
  std::vector<test::Segment> walls{{{-100.0, -1.5}, {100.0, -1.5}}};
  double from = -100.0;
  for (const double x : at) {
    const std::vector<Eigen::Vector2d> corners{
        {from, 1.5}, {x, 1.5}, {x + 0.3, 3.5}, {x + 2.0, 3.5}, {x + 2.0, 1.5}};
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      walls.push_back({corners[i], corners[i + 1]});
    }
    from = x + 2.0;
  }
  walls.push_back({{from, 1.5}, {100.0, 1.5}});
  return test::WallWorld(walls);
}

TEST(MapMatching, ReturnsBothOfTwoSimilarPlaces) {
  // The newer map observed one recess, the older one two, 6 m apart: both matches are possible.
  const LocalWalls older = walls_of(tunnel_with_recesses({2.0, 8.0}), {-1.0, 0.0, 0.0}, 10.0);
  const LocalWalls newer = walls_of(tunnel_with_recesses({2.0}), {0.0, 0.0, 0.0}, 3.0, 2);
  const auto found = match(newer, older, around({4.0, 0.0, 0.0}, 1.5, 0.05));
  ASSERT_GE(found.size(), 2U);
  const auto lies_at = [&](double x) {
    return std::any_of(found.begin(), found.end(), [&](const auto& a) {
      return std::abs(a.T_older_newer.x - x) < 0.05 && std::abs(a.T_older_newer.y) < 0.05;
    });
  };
  EXPECT_TRUE(lies_at(1.0));
  EXPECT_TRUE(lies_at(7.0));
}

/// A straight tunnel with timber sets that stand 0.1 m out of smooth walls.
test::WallWorld tunnel_with_timber_sets(double apart_m) {
  std::vector<test::Segment> walls;
  for (const double side : {-1.0, 1.0}) {
    for (double x = -50.0 * apart_m; x < 50.0 * apart_m; x += apart_m) {
      const std::vector<Eigen::Vector2d> corners{{x, 1.5 * side},
                                                 {x, 1.4 * side},
                                                 {x + 0.15, 1.4 * side},
                                                 {x + 0.15, 1.5 * side},
                                                 {x + apart_m, 1.5 * side}};
      for (std::size_t i = 0; i + 1 < corners.size(); ++i)
        walls.push_back({corners[i], corners[i + 1]});
    }
  }
  return test::WallWorld(walls);
}

/// Two maps that are one set nearer to each other have more walls in common, which all agree.
TEST(MapMatching, DoesNotPreferTheNearerOfSimilarPlacesAlongATunnel) {
  constexpr double kSetsApartM = 1.8;
  const test::WallWorld tunnel = tunnel_with_timber_sets(kSetsApartM);
  const Pose2 T_older_next{3.0 * kSetsApartM, 0.0, 0.0};
  const Pose2 truth{7.0 * kSetsApartM, 0.0, 0.0};
  const LocalWalls older = walls_of(tunnel, {});
  const LocalWalls next = walls_of(tunnel, T_older_next, 5.0, 3);
  const LocalWalls newer = walls_of(tunnel, truth, 5.0, 2);
  const Eigen::Matrix3d of_next = Eigen::Vector3d(0.25, 4e-4, 1e-5).asDiagonal();
  const auto found = match_maps(
      newer, {{test::borrowed(older), {}}, {test::borrowed(next), T_older_next, 0.0, of_next}}, 7,
      around(truth, 1.5, 0.02), {});
  const auto likelihood_at = [&](double x) {
    const auto place = std::ranges::find_if(found, [&](const LoopClosureAlternative& a) {
      return std::abs(a.T_older_newer.x - x) < 0.3;
    });
    return place == found.end() ? -1.0 : place->log_likelihood;
  };
  ASSERT_GT(likelihood_at(truth.x), 0.0);
  ASSERT_GT(likelihood_at(truth.x - kSetsApartM), 0.0);
  EXPECT_GT(likelihood_at(truth.x), likelihood_at(truth.x - kSetsApartM) - 1.0);
}

TEST(MapMatching, FindsNothingInADifferentPlace) {
  const LocalWalls older = walls_of(test::crooked_room(), {-3.0, 0.0, 0.0}, 3.0);
  const LocalWalls newer = walls_of(test::sample_mine(3), {8.0, 0.0, 0.0}, 5.0, 2);
  for (const double turn : {0.0, 1.5, 3.0}) {
    EXPECT_TRUE(match(newer, older, around({0.0, 0.0, turn}, 0.7, 0.2)).empty()) << turn;
  }
}

TEST(MapMatching, StaysInsideTheGate) {
  const test::WallWorld mine = test::sample_mine(3);
  const Pose2 T_world_older{8.0, 0.0, 0.0};
  const RelativePose wrong = around({4.0, 0.0, 0.0}, 0.4, 0.05);
  for (const auto& found :
       match(walls_of(mine, T_world_older, 5.0, 2), walls_of(mine, T_world_older), wrong)) {
    const Eigen::Vector3d off = between(wrong.T_older_newer, found.T_older_newer).vector();
    EXPECT_LE(off.dot(wrong.covariance.inverse() * off), 16.0);  // 4 sigmas
    EXPECT_LT(found.log_likelihood, 15.0);
  }
}

TEST(MapMatching, FindsNothingInEmptyMaps) {
  const LocalWalls room = walls_of(test::crooked_room(), {-2.0, 0.0, 0.0}, 1.0);
  EXPECT_TRUE(match({}, room, around({}, 0.5, 0.1)).empty());
  EXPECT_TRUE(match(room, {}, around({}, 0.5, 0.1)).empty());
  EXPECT_TRUE(match_maps(room, {}, 0, around({}, 0.5, 0.1), {}).empty());
}

}  // namespace
}  // namespace adit
