// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/frontier/frontier_register.hpp"

#include <cstddef>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kVehicleWidthM = 1.2;

constexpr std::int64_t kUtime = 1'600'000'000'000'000;
const Eigen::Vector2d kEnd{10.0, 0.0};

/// A square of free cells, 8 m wide, around the body.
LocalMapTile tile() {
  LocalMapTile tile;
  for (int row = -40; row <= 40; ++row) {
    for (int column = -40; column <= 40; ++column) tile.free.emplace_back(column, row);
  }
  tile.path = {{0.0, 0.0}};
  return tile;
}

/// A frontier that local map 0 detected from a distance and local map 1 closed.
class ClosedFrontier : public testing::Test {
 protected:
  ClosedFrontier() {
    scan_from({4.0, 0.0, 0.0});
    update({{kEnd}});
    scan_from({8.0, 0.0, 0.0});
    update({});
  }

  void scan_from(const Pose2& T_map_local) {
    space_.add(static_cast<int>(poses_.size()), tile());
    poses_.push_back(T_map_local);
    space_.pose(poses_);
  }
  void update(const std::vector<DetectedFrontier>& ends) {
    utime_ += 1'000'000;
    frontiers_.update(ends, space_, {}, utime_);
  }
  [[nodiscard]] FrontierState state() const { return frontiers_.find(0)->state; }

  KnownSpace space_{KnownSpaceParams{}};
  std::vector<Pose2> poses_;
  FrontierRegister frontiers_{FrontierRegisterParams{}, kVehicleWidthM};
  std::int64_t utime_ = kUtime;
};

/// A frontier that the planner rejected before local map 1 closed it.
class RejectedFrontier : public ClosedFrontier {
 protected:
  RejectedFrontier() {
    poses_.pop_back();
    space_ = KnownSpace{KnownSpaceParams{}};
    frontiers_ = FrontierRegister{FrontierRegisterParams{}, kVehicleWidthM};
    poses_.clear();
    scan_from({4.0, 0.0, 0.0});
    update({{kEnd}});
  }
  void reject(int times) {
    for (int i = 0; i < times; ++i) frontiers_.record_rejection(0);
  }
  /// A 3D scan of the newest local map shows ground over 2 m on either side of the x axis of map,
  /// up to one place, and rock from another one on.
  void scan_in_3d(double ground_end_m, double rock_m) {
    const double side_m = space_.resolution_m();
    ScannedGround ground{static_cast<int>(poses_.size()) - 1, poses_.back().inverse(), {}};
    ground.cells = Grid2<ScannedCell>(
        CellBox{cell_of({0.0, -2.0}, side_m), cell_of({rock_m + 1.0, 2.0}, side_m)});
    for (std::size_t i = 0; i < ground.cells.size(); ++i) {
      const double x = centre_of(ground.cells.cell(i), side_m).x();
      if (x < ground_end_m) ground.cells[i] = ScannedCell::kGround;
      if (x > rock_m) ground.cells[i] = ScannedCell::kRock;
    }
    space_.add(std::move(ground));
  }
};

TEST_F(RejectedFrontier, IsUnconfirmedUntilTheRobotHasPassedIt) {
  reject(2);
  scan_from({7.0, 0.0, 0.0});
  update({});
  EXPECT_EQ(state(), FrontierState::kUnconfirmed);
  EXPECT_EQ(frontiers_.find(0)->evidence,
            "2 plans found no path to it, and only level lasers show its end, in local map 1");
  scan_from({9.0, 0.0, 0.0});
  update({});
  EXPECT_EQ(state(), FrontierState::kExplored);
}

/// Better evidence than that of level lasers.
TEST_F(RejectedFrontier, IsExploredOnce3DScansShowRockBehindIt) {
  reject(2);
  scan_from({7.0, 0.0, 0.0});
  update({});
  ASSERT_EQ(state(), FrontierState::kUnconfirmed);
  scan_in_3d(11.5, 12.0);
  update({});
  EXPECT_EQ(state(), FrontierState::kExplored);
}

/// Behind a crest rock without ground before it may be the roof.
TEST_F(RejectedFrontier, IsUnconfirmedIf3DScansShowRockWithoutTheGroundBeforeIt) {
  reject(2);
  scan_from({7.0, 0.0, 0.0});
  scan_in_3d(10.0, 13.0);
  update({});
  EXPECT_EQ(state(), FrontierState::kUnconfirmed);
}

TEST_F(RejectedFrontier, IsExploredAfterASingleRejection) {
  reject(1);
  scan_from({7.0, 0.0, 0.0});
  update({});
  EXPECT_EQ(state(), FrontierState::kExplored);
}

TEST_F(RejectedFrontier, IsUnconfirmedAfterARestart) {
  reject(2);
  const std::vector<StoredFrontier> stored = frontiers_.stored_frontiers();
  frontiers_ = FrontierRegister{FrontierRegisterParams{}, kVehicleWidthM};
  frontiers_.restore(stored);
  scan_from({7.0, 0.0, 0.0});
  update({});
  EXPECT_EQ(state(), FrontierState::kUnconfirmed);
}

/// Level lasers may take the roof of a falling tunnel for walls that leave no path.
TEST_F(RejectedFrontier, IsTooNarrowOnlyIfItsOpeningIsNarrow) {
  for (const auto& [width_m, expected] :
       {std::pair{1.0, FrontierState::kTooNarrow}, std::pair{2.0, FrontierState::kUnconfirmed}}) {
    DetectedFrontier end{kEnd};
    end.width_m = width_m;
    update({end});
    ASSERT_EQ(state(), FrontierState::kOpen);
    end.access = Access::kUnreachable;
    update({end});
    EXPECT_EQ(state(), expected);
    end.access = Access::kReachable;
    update({end});
  }
}

TEST_F(RejectedFrontier, MayBeTooNarrowForAWiderVehicle) {
  frontiers_ = FrontierRegister{FrontierRegisterParams{}, 2.0 * kVehicleWidthM};
  DetectedFrontier end{kEnd};
  end.width_m = 2.0;
  update({end});
  end.access = Access::kUnreachable;
  update({end});
  EXPECT_EQ(state(), FrontierState::kTooNarrow);
}

TEST_F(ClosedFrontier, IsExplored) {
  EXPECT_EQ(state(), FrontierState::kExplored);
  EXPECT_EQ(frontiers_.find(0)->evidence, "the space behind it was observed by local map 1");
}

TEST_F(ClosedFrontier, StaysClosedAtASeamThatNoLaterLocalMapObserved) {
  scan_from({100.0, 0.0, 0.0});
  update({{kEnd + Eigen::Vector2d(0.3, 0.4)}});
  EXPECT_EQ(state(), FrontierState::kExplored);
  EXPECT_EQ(frontiers_.frontiers().size(), 1U);
}

TEST_F(ClosedFrontier, ReopensIfALaterLocalMapObservedThePlace) {
  scan_from({12.0, 0.0, 0.0});
  update({{kEnd + Eigen::Vector2d(0.3, 0.4)}});
  EXPECT_EQ(state(), FrontierState::kOpen);
}

/// Local maps count that were added after the last update without a detection there, not after the
/// frontier was closed.
TEST_F(ClosedFrontier, StaysClosedIfLaterLocalMapsObservedNoFrontierThere) {
  scan_from({12.0, 0.0, 0.0});
  update({});
  scan_from({100.0, 0.0, 0.0});
  update({{kEnd}});
  EXPECT_EQ(state(), FrontierState::kExplored);
}

TEST_F(ClosedFrontier, ReopensIfTheClosingLocalMapHasMoved) {
  poses_[1].y = 1.0;
  scan_from({100.0, 0.0, 0.0});
  update({{kEnd}});
  EXPECT_EQ(state(), FrontierState::kOpen);
}

TEST_F(ClosedFrontier, ReopensWhereAWallIsDismissed) {
  DetectedFrontier detection{kEnd + Eigen::Vector2d(0.3, 0.4)};
  update({detection});
  EXPECT_EQ(state(), FrontierState::kExplored);
  detection.at_dismissed_wall = true;
  update({detection});
  EXPECT_EQ(state(), FrontierState::kOpen);
  EXPECT_EQ(frontiers_.frontiers().size(), 1U);
}

TEST_F(ClosedFrontier, IsNotExploredPermanentlyOnceClosingsAreForgotten) {
  const DetectedFrontier detection{kEnd, {1.0, 0.0}, 3.0, Access::kReachable, true};
  for (int i = 1; i < FrontierRegisterParams{}.closings; ++i) {
    update({detection});
    EXPECT_EQ(state(), FrontierState::kOpen);
    update({});
  }
  update({detection});
  EXPECT_EQ(state(), FrontierState::kExplored);  // permanently
  frontiers_.forget_closings();
  update({detection});
  EXPECT_EQ(state(), FrontierState::kOpen);
}

TEST_F(ClosedFrontier, ReopensAfterARestart) {
  const std::vector<StoredFrontier> stored_frontiers = frontiers_.stored_frontiers();
  frontiers_ = FrontierRegister{FrontierRegisterParams{}, kVehicleWidthM};
  frontiers_.restore(stored_frontiers);
  scan_from({100.0, 0.0, 0.0});
  update({{kEnd}});
  EXPECT_EQ(state(), FrontierState::kOpen);
}

}  // namespace
}  // namespace adit
