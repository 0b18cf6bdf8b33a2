// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/planning_node.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/navigation.hpp"
#include "tests/support/worlds/terrain_scenes.hpp"

namespace adit {
namespace {

constexpr std::int64_t kUtime = 1'600'000'000'000'000;

class PlanningNodeTest : public testing::Test {
 protected:
  PlanningNodeTest() {
    subscribe<planned_path_t>(bus_, channels::kPath, Delivery::queued(10),
                              [this](const PlannedPath& path) { paths_.push_back(path); });
  }

  void send_terrain(TerrainMap terrain = even_ground()) {
    terrain.utime = kUtime;
    for (const TerrainFragment& tile : split(terrain)) {
      publish(bus_, channels::kTerrain, to_message(tile));
    }
  }
  void send_goal(std::int32_t id) {
    publish(bus_, channels::kGoal,
            to_message(PlanGoal{kUtime, id, PlanGoal::Kind::kAlong, {}, 5.0}));
  }
  void send_pose() { publish(bus_, channels::kPose, to_message(StampedPose{kUtime, {}, {}})); }

  MemoryBus bus_;
  PlanningNode node_{bus_, PlanningParams{}};
  std::vector<PlannedPath> paths_;
};

TEST_F(PlanningNodeTest, PublishesOnePathForEachGoal) {
  send_pose();
  send_terrain();
  EXPECT_TRUE(paths_.empty());
  send_goal(3);
  send_pose();
  send_terrain();
  ASSERT_EQ(paths_.size(), 1U);
  EXPECT_EQ(paths_[0].outcome, PlanOutcome::kFound);
  EXPECT_EQ(paths_[0].id, 3);
  EXPECT_EQ(paths_[0].utime, kUtime);
  EXPECT_EQ(node_.health(), Health{});
  send_goal(4);
  EXPECT_EQ(paths_.size(), 2U);
}

TEST_F(PlanningNodeTest, HoldsAGoalUntilTheFirstTerrainAndPose) {
  send_goal(3);
  EXPECT_EQ(node_.health().reason, "goal pending: no terrain received yet");
  send_terrain();
  EXPECT_EQ(node_.health().reason, "goal pending: no pose received yet");
  send_goal(4);
  EXPECT_TRUE(paths_.empty());
  send_pose();
  ASSERT_EQ(paths_.size(), 1U);
  EXPECT_EQ(paths_[0].id, 4);
  EXPECT_EQ(node_.health(), Health{});
}

TEST_F(PlanningNodeTest, PublishesAReasonWhereTheTerrainCannotBePlannedOn) {
  send_pose();
  send_terrain(even_ground(20.0, 5.0));  // cells that are larger than the vehicle
  send_goal(3);
  ASSERT_EQ(paths_.size(), 1U);
  EXPECT_EQ(paths_[0].outcome, PlanOutcome::kSearchLimit);
  EXPECT_FALSE(paths_[0].reason.empty());
  EXPECT_EQ(node_.health().reason, paths_[0].reason);
}

}  // namespace
}  // namespace adit
