// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/map_heights.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kLengthM = 5.0;
constexpr double kPathStepM = 0.25;

/// A chain of straight local maps in one line with a constant grade.
struct Ramp {
  std::vector<LocalMap> maps;
  std::vector<LocalWalls> walls;

  explicit Ramp(int count, double grade, bool has_attitude = true) {
    for (int id = 0; id < count; ++id) {
      LocalMap map;
      map.id = id;
      map.T_previous_local = {kLengthM, 0.0, 0.0};
      map.information = Eigen::Matrix3d::Identity() * 1e4;
      if (id > 0) map.climb_m = grade * kLengthM;
      if (id > 0) map.forward_m = kLengthM;
      LocalScan scan;
      if (has_attitude) scan.attitude = Attitude{0.0, -std::atan(grade)};
      map.scans.push_back(scan);
      LocalWalls wall;
      for (double x = 0.0; x <= kLengthM; x += kPathStepM)
        wall.path.push_back({{x, 0.0, grade * x}, x});
      maps.push_back(map);
      walls.push_back(wall);
    }
  }
};

WallStore stored(const std::vector<LocalWalls>& walls) {
  WallStore store;
  for (const LocalWalls& of_map : walls) store.push_back(of_map);
  return store;
}

TEST(MapHeights, FollowTheClimbs) {
  const Ramp ramp(20, 0.2);
  MapHeights heights{MapHeightsParams{}};
  heights.update(ramp.maps, stored(ramp.walls), {});
  for (int id = 0; id < 20; ++id) EXPECT_NEAR(heights.height_m(id), id * 1.0, 1e-3);
  EXPECT_LT(std::sqrt(heights.variances_to(0)[19]), 0.6);
}

TEST(MapHeights, AreUnknownWithoutAnAttitude) {
  const Ramp ramp(20, 0.0, false);
  MapHeights heights{MapHeightsParams{}};
  heights.update(ramp.maps, stored(ramp.walls), {});
  EXPECT_GT(std::sqrt(heights.variances_to(0)[19]), 5.0);  // 95 m of ground with any slope
}

/// Two parts of a ramp that lie above each other in plan, as where a ramp crosses itself.
TEST(MapHeights, TellLevelsApart) {
  const Ramp ramp(13, 0.1);
  MapHeights heights{MapHeightsParams{}};
  heights.update(ramp.maps, stored(ramp.walls), {});
  const Pose2 T_across{2.5, -2.5, 1.57};
  EXPECT_FALSE(heights.same_level(0, 12, T_across, stored(ramp.walls)));  // 6 m above
  EXPECT_TRUE(heights.same_level(0, 1, {kLengthM, 0.0, 0.0}, stored(ramp.walls)));

  const Ramp level(13, 0.0);
  MapHeights level_heights{MapHeightsParams{}};
  level_heights.update(level.maps, stored(level.walls), {});
  EXPECT_TRUE(level_heights.same_level(0, 12, T_across, stored(level.walls)));
}

TEST(MapHeights, LevelsAreNotToldApartWithoutAnAttitude) {
  const Ramp ramp(13, 0.1, false);
  MapHeights heights{MapHeightsParams{}};
  heights.update(ramp.maps, stored(ramp.walls), {});
  EXPECT_TRUE(heights.same_level(0, 12, {2.5, -2.5, 1.57}, stored(ramp.walls)));
}

TEST(MapHeights, LoopClosureTiesTheGroundOfBothMaps) {
  Ramp ramp(9, 0.0);
  for (LocalMap& map : ramp.maps) map.climb_m = 0.01 * map.forward_m;  // an error of the pitch
  MapHeights heights{MapHeightsParams{}};
  const PoseConstraint same_place{0, 8, {}, Eigen::Matrix3d::Identity()};
  heights.update(ramp.maps, stored(ramp.walls), {});
  EXPECT_NEAR(heights.height_m(8), 0.4, 1e-3);
  heights.update(ramp.maps, stored(ramp.walls), {same_place});
  EXPECT_NEAR(heights.height_m(8), 0.0, 0.03);
}

/// At the start of the second local map the body climbs a step on all wheels at once, which its
/// pitch does not show.
struct StepUp {
  static constexpr double kStepM = 0.04;
  Ramp ramp{3, 0.0};
  MapHeights heights{MapHeightsParams{}};
  CloudMatch match;

  StepUp() {
    match.older = {1, 0, 0.0, 0.0};
    match.newer = {2, 1, 0.0, 1.0};
    match.T_older_newer = {kLengthM, 0.0, 0.0};
    match.lever_m = {kLengthM + 1.0, 0.0};
    match.rise_m = kStepM;
    match.rise_sd_m = 0.002;
    heights.add(match.older);
    heights.add(match.newer);
    heights.add(match);
  }
  [[nodiscard]] PoseConstraint loop_closure() const {
    return {0, 1, match.T_older_newer, Eigen::Matrix3d::Identity()};
  }
};

TEST(MapHeights, FollowTheRiseOfMatched3DScans) {
  StepUp step;
  EXPECT_TRUE(step.heights.is_match(step.loop_closure()));
  EXPECT_FALSE(step.heights.is_match({0, 1, {}, Eigen::Matrix3d::Identity()}));
  step.heights.update(step.ramp.maps, stored(step.ramp.walls), {});
  EXPECT_NEAR(step.heights.height_m(2), 0.0, 1e-6);
  step.heights.update(step.ramp.maps, stored(step.ramp.walls), {step.loop_closure()});
  // The step may lie in the first local map or after the origin of the second one.
  EXPECT_GT(step.heights.height_m(2), 0.4 * StepUp::kStepM);
  EXPECT_LT(step.heights.height_m(2), StepUp::kStepM);
  EXPECT_EQ(step.heights.variances_to(0).size(), 3);
}

TEST(MapHeights, ARevokedMatchLeavesNoTrace) {
  StepUp step;
  step.heights.update(step.ramp.maps, stored(step.ramp.walls), {step.loop_closure()});
  step.heights.update(step.ramp.maps, stored(step.ramp.walls), {});
  EXPECT_NEAR(step.heights.height_m(2), 0.0, 1e-6);
}

/// Also of a local map whose id another one gets.
TEST(MapHeights, ARemovedLocalMapTakesItsMatchesWithIt) {
  StepUp step;
  step.heights.update(step.ramp.maps, stored(step.ramp.walls), {step.loop_closure()});
  const std::vector<LocalMap> first{step.ramp.maps.front()};
  step.heights.update(first, stored(step.ramp.walls), {});
  EXPECT_FALSE(step.heights.is_match(step.loop_closure()));
  step.heights.update(step.ramp.maps, stored(step.ramp.walls), {});
  EXPECT_NEAR(step.heights.height_m(2), 0.0, 1e-6);
}

/// Out and back in reverse, a constant error of the pitch leaves no trace: the heights of the
/// return are those of the outward path, and how far they are wrong stays unknown.
TEST(MapHeights, ReverseDrivingDoesNotRevealTheErrorOfThePitch) {
  constexpr double kError = 0.01;
  constexpr int kOut = 5;  // local maps out, and as many back
  Ramp ramp(2 * kOut + 1, 0.0);
  for (LocalMap& map : ramp.maps) {
    const double direction = map.id > kOut ? -1.0 : 1.0;
    map.T_previous_local = {direction * kLengthM, 0.0, 0.0};
    if (map.id > 0) map.forward_m = direction * kLengthM;
    map.climb_m = kError * map.forward_m;
    // The frame of a map is where it begins.
    const double onwards = map.id < kOut ? 1.0 : -1.0;
    for (TraversedPoint& point : ramp.walls[static_cast<std::size_t>(map.id)].path) {
      point.forward_m *= onwards;
      point.p.x() *= onwards;
      point.p.z() = kError * point.forward_m;
    }
  }
  // The last map begins at the start, the others beside those of the outward path.
  std::vector<PoseConstraint> loop_closures;
  for (int back = kOut + 1; back <= 2 * kOut; ++back) {
    const int out = 2 * kOut - back;
    loop_closures.push_back({out, back, {}, Eigen::Matrix3d::Identity()});
    if (out > 0) {
      loop_closures.push_back({out - 1, back, {kLengthM, 0.0, 0.0}, Eigen::Matrix3d::Identity()});
    }
  }
  MapHeights heights{MapHeightsParams{}};
  heights.update(ramp.maps, stored(ramp.walls), loop_closures);
  EXPECT_NEAR(heights.height_m(kOut), kError * kOut * kLengthM, 1e-3);  // nothing corrects it
  const MapHeightsParams params;
  const double pitch_m = params.pitch_sd_rad * kOut * kLengthM;
  EXPECT_GT(std::sqrt(heights.variance(0, kOut)), 0.99 * pitch_m);  // and it is not sure either
}

TEST(MapHeights, PathsInOneLineDoNotTieTheirEnds) {
  // On a ramp the end of one path and the start of the next, a metre on, differ in height.
  const Ramp ramp(2, 0.25);
  const GroundOffset offset =
      ground_offset(ramp.walls[1].path, {kLengthM + 1.0, 0.0, 0.0}, ramp.walls[0].path);
  EXPECT_NEAR(offset.distance_m, 1.0, 1e-9);
  const GroundOffset overlapping =
      ground_offset(ramp.walls[1].path, {kLengthM - 1.0, 0.0, 0.0}, ramp.walls[0].path);
  EXPECT_NEAR(overlapping.distance_m, 0.0, 1e-9);
  EXPECT_NEAR(overlapping.offset_m, 0.25 * (kLengthM - 1.0), 1e-9);
}

}  // namespace
}  // namespace adit
