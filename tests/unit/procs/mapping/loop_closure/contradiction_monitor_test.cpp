// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/loop_closure/contradiction_monitor.hpp"

#include <numbers>

#include <gmock/gmock.h>

#include "tests/unit/procs/mapping/mapped_world.hpp"

namespace adit {
namespace {

constexpr double kEvidenceMin = 21.1;

/// Local maps along the first tunnel of a mine, and back again.
class ContradictionMonitorTest : public testing::Test {
 protected:
  ContradictionMonitorTest() {
    const test::WallWorld mine = test::sample_mine(3);
    for (const double x_m : {3.0, 8.0, 13.0, 18.0, 13.5, 8.5}) {
      truth_.push_back({x_m, 0.0, 0.0});
      walls_.push_back(test::walls_of(mine, truth_.back(), 5.0, walls_.size() + 1));
      extents_.emplace_back(walls_.back());
    }
  }

  /// A turn of the body by `angle_rad` between maps 2 and 3 that nothing measured.
  [[nodiscard]] std::vector<Pose2> turned(double angle_rad) const {
    std::vector<Pose2> poses = truth_;
    for (std::size_t i = 3; i < poses.size(); ++i) {
      poses[i] = truth_[2] * Pose2{5.0, 0.0, angle_rad} * between(truth_[3], truth_[i]);
    }
    return poses;
  }

  std::vector<MapContradiction> update(const std::vector<Pose2>& poses) {
    const auto alone = [this](int map) {
      const LocalWalls& walls = walls_[static_cast<std::size_t>(map)];
      return std::vector<PlacedWalls>{{test::borrowed(walls), {}, 0.0}};
    };
    WallStore stored;
    for (const LocalWalls& walls : walls_) stored.push_back(walls);
    monitor_.update(stored, extents_, poses, alone,
                    [this](int, int, const Pose2&) { return same_level_; });
    return monitor_.contradictions();
  }

  std::vector<Pose2> truth_;
  std::vector<LocalWalls> walls_;
  std::vector<MapExtent> extents_;
  bool same_level_ = true;
  ContradictionMonitor monitor_{MapMatchingParams{}, kEvidenceMin};
};

TEST_F(ContradictionMonitorTest, FindsNoneInARightMap) { EXPECT_TRUE(update(truth_).empty()); }

TEST_F(ContradictionMonitorTest, FindsAWrongTurnWithoutLoopClosures) {
  const auto found = update(turned(std::numbers::pi / 2.0));
  ASSERT_FALSE(found.empty());
  for (const MapContradiction& pair : found) {  // the turn lies between
    EXPECT_LE(pair.older_map, 2);
    EXPECT_GE(pair.newer_map, 3);
    EXPECT_GE(pair.evidence, kEvidenceMin);
  }
}

TEST_F(ContradictionMonitorTest, ComparesAgainWhatMoved) {
  ASSERT_FALSE(update(turned(std::numbers::pi / 2.0)).empty());
  EXPECT_TRUE(update(truth_).empty());
  EXPECT_FALSE(update(turned(std::numbers::pi / 2.0)).empty());
}

TEST_F(ContradictionMonitorTest, LeavesOutMapsOfDifferentLevels) {
  same_level_ = false;
  EXPECT_TRUE(update(turned(std::numbers::pi / 2.0)).empty());
}

/// A place that was passed forty times; the newest map is turned.
TEST_F(ContradictionMonitorTest, ComparesWithTheNearestOfManyPasses) {
  const test::WallWorld mine = test::sample_mine(3);
  for (int i = 0; i < 40; ++i) {
    truth_.push_back({5.0 + 0.2 * i, 0.0, 0.0});
    walls_.push_back(test::walls_of(mine, truth_.back(), 5.0, walls_.size() + 1));
    extents_.emplace_back(walls_.back());
  }
  EXPECT_TRUE(update(truth_).empty());
  std::vector<Pose2> poses = truth_;
  poses.back().theta = std::numbers::pi / 2.0;
  const auto found = update(poses);
  EXPECT_GE(found.size(), 10U);
  EXPECT_LE(found.size(), 24U) << "as ContradictionMonitor states";
  for (const MapContradiction& pair : found) EXPECT_EQ(pair.newer_map, 45);
  EXPECT_TRUE(update(truth_).empty());
}

/// Ground and roof are taken for walls where the body pitches.
TEST_F(ContradictionMonitorTest, LeavesOutMapsWithWallsAtDifferentHeights) {
  for (LocalWalls& walls : walls_) {
    walls.points.front().z_m = -1.0;
    walls.points.back().z_m = 1.0;
  }
  EXPECT_TRUE(update(turned(std::numbers::pi / 2.0)).empty());
}

TEST_F(ContradictionMonitorTest, BoundsTheContradictionWithoutWalls) {
  const std::vector<Pose2> poses = turned(std::numbers::pi / 2.0);
  const MapMatchingParams params;
  for (std::size_t older = 0; older < 3; ++older) {
    for (std::size_t newer = 3; newer < poses.size(); ++newer) {
      const Pose2 T = between(poses[older], poses[newer]);
      EXPECT_GE(contradiction_bound(walls_[newer], walls_[older], T, params),
                0.9 * contradiction(walls_[newer], {{test::borrowed(walls_[older]), {}, 0.0}}, T,
                                    params));
    }
  }
}

}  // namespace
}  // namespace adit
