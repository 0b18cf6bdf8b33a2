// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/map_score.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {
namespace {

using Points = std::vector<Eigen::Vector2d>;

/// The walls of a tunnel 40 m long and 4 m wide up to `end_x`, a point per cell of 5 cm.
Points walls_to(double end_x) {
  Points points;
  for (int i = 0; - 19.975 + 0.05 * i < end_x; ++i) {
    for (const double y : {-2.0, 2.0}) points.emplace_back(-19.975 + 0.05 * i, y);
  }
  for (int i = 0; i < 80; ++i) points.emplace_back(-20.0, -1.975 + 0.05 * i);
  if (end_x < 20.0) return points;
  for (int i = 0; i < 80; ++i) points.emplace_back(20.0, -1.975 + 0.05 * i);
  return points;
}

Points moved(const Pose2& T_to_from, Points points) {
  for (Eigen::Vector2d& p : points) p = T_to_from * p;
  return points;
}

/// Through the tunnel from end to end.
const Trajectory kPath{{1'000'000, {-15.0, 0.0, 0.0}},
                       {2'000'000, {-5.0, 0.0, 0.0}},
                       {3'000'000, {5.0, 0.0, 0.0}},
                       {4'000'000, {15.0, 0.0, 0.0}}};

class MapScoreOf : public testing::Test {
 protected:
  [[nodiscard]] MapScore score(const Points& mapped, const Pose2& T_world_map = {}) const {
    return score_map(mapped, T_world_map, site_, kPath);
  }

  Site site_{box_tunnel({40.0, 4.0, 2.0})};
};

TEST_F(MapScoreOf, APerfectMapHasAPerfectScoreInAnyFrame) {
  const Pose2 T_map_world{7.0, -3.0, 1.1};
  const MapScore found = score(moved(T_map_world, walls_to(20.0)), T_map_world.inverse());
  EXPECT_EQ(found.mapped_points, walls_to(20.0).size());
  // 88 m of wall at 0.1 m; where it lies on the border of two cells, both may have a point.
  EXPECT_GT(found.reference_points, 850U);
  EXPECT_EQ(found.coverage, 1.0);
  EXPECT_EQ(found.coverage_of_mine, 1.0);
  EXPECT_EQ(found.deviation, 0.0);
  EXPECT_NEAR(found.wall_distance.mean_m, 0.0, 1e-9);
  EXPECT_NEAR(found.wall_distance.p95_m, 0.0, 1e-9);
}

TEST_F(MapScoreOf, AShiftIsMeasuredAsWallDistance) {
  // 0.1 m to the side: the long walls, 40 of 44 m, are off by that, the ends are not.
  const MapScore found = score(moved({0.0, 0.1, 0.0}, walls_to(20.0)));
  EXPECT_EQ(found.coverage, 1.0);
  EXPECT_EQ(found.deviation, 0.0);
  EXPECT_NEAR(found.wall_distance.median_m, 0.1, 1e-9);
  EXPECT_NEAR(found.wall_distance.mean_m, 0.1 * 40.0 / 44.0, 1e-3);  // near the corners less
}

TEST_F(MapScoreOf, ALargeShiftLosesCoverage) {
  // 0.5 m to the side: only the ends still lie upon walls, but for half a metre of each, and within
  // 0.15 m of these the long walls.
  const MapScore found = score(moved({0.0, 0.5, 0.0}, walls_to(20.0)));
  EXPECT_LT(found.coverage, 0.1);
  // All of one long wall is 0.5 m outside the tunnel. All of the other is 0.5 m inside, but 6
  // points at each end lie within 0.3 m of it. Of either end, 4 points are more than 0.3 m out.
  EXPECT_DOUBLE_EQ(found.deviation, (800.0 + 800.0 - 12.0 + 8.0) / 1760.0);
}

TEST_F(MapScoreOf, AWrongWallAddsItsShareToTheDeviation) {
  Points mapped = walls_to(20.0);
  const std::size_t right = mapped.size();
  for (int i = 0; i < 44; ++i) mapped.emplace_back(0.1 * i, 0.0);  // 2 m from either wall
  const MapScore found = score(mapped);
  EXPECT_DOUBLE_EQ(found.deviation, 44.0 / static_cast<double>(right + 44));
  EXPECT_EQ(found.coverage, 1.0);
  EXPECT_NEAR(found.wall_distance.mean_m, 2.0 * found.deviation, 1e-9);
  EXPECT_NEAR(found.wall_distance.median_m, 0.0, 1e-9);
}

TEST_F(MapScoreOf, LimitsWallDistancesToFiveMetres) {
  EXPECT_DOUBLE_EQ(score({{0.0, 100.0}}).wall_distance.mean_m, 5.0);
}

TEST_F(MapScoreOf, AMissingHalfLosesHalfOfTheCoverage) {
  const MapScore found = score(walls_to(0.0));
  EXPECT_NEAR(found.coverage, 0.5, 0.01);  // 0.15 m on each wall, and points in two cells
  EXPECT_NEAR(*found.coverage_of_mine, 0.5, 0.01);
  EXPECT_EQ(found.deviation, 0.0);
}

TEST_F(MapScoreOf, WallsNotVisibleFromThePathDoNotCount) {
  const Trajectory short_path{{1'000'000, {-15.0, 0.0, 0.0}}, {2'000'000, {-12.0, 0.0, 0.0}}};
  const MapScore found = score_map(walls_to(0.0), {}, site_, short_path);
  EXPECT_EQ(found.coverage, 1.0);
  EXPECT_NEAR(*found.coverage_of_mine, 0.5, 0.01);
}

TEST_F(MapScoreOf, AVisiblePostCountsAsAWall) {
  const Site site(box_tunnel({40.0, 4.0, 2.0}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kPost, Material::kTimber, "post");
    builder.bar({0.0, 1.0, 0.0}, {0.0, 1.0, 2.0}, 0.1);
  }));
  Points mapped = walls_to(20.0);
  const double without = score_map(mapped, {}, site, kPath).coverage;
  EXPECT_LT(without, 1.0);
  mapped.emplace_back(0.0, 0.9);
  const MapScore with = score_map(mapped, {}, site, kPath);
  EXPECT_GT(with.coverage, without);
  EXPECT_EQ(with.deviation, 0.0);
}

TEST_F(MapScoreOf, RejectsEmptyMapsAndDistantPaths) {
  EXPECT_THROW((void)score({}), std::runtime_error);
  const Trajectory elsewhere{{1'000'000, {500.0, 0.0, 0.0}}};
  EXPECT_THROW((void)score_map(walls_to(20.0), {}, site_, elsewhere), std::runtime_error);
}

TEST_F(MapScoreOf, JsonHasNoFiguresWithoutData) {
  MapScore map = score(walls_to(20.0));
  map.coverage_of_mine.reset();
  const auto json = nlohmann::json::parse(to_json(score_trajectory(kPath, kPath), map));
  EXPECT_TRUE(json["map"]["coverage_of_mine"].is_null());
  EXPECT_EQ(json["map"]["coverage"], 1.0);
  EXPECT_EQ(json["trajectory"]["aligned"]["rmse_m"], 0.0);
  EXPECT_TRUE(json["trajectory"]["relative"][1].contains("translation_m"));
  EXPECT_FALSE(json["trajectory"]["relative"][2].contains("translation_m"));  // 100 m
}

}  // namespace
}  // namespace adit
