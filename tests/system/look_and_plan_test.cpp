// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// A simulated robot looks at the drift before it and finds its way: all nodes from the laser to the
// path on one bus.
#include <cmath>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/plan_goal.hpp"
#include "common/messages/planned_path.hpp"
#include "common/messages/scan_request.hpp"
#include "procs/planning/planning_node.hpp"
#include "procs/scan_assembly/scan_assembly_node.hpp"
#include "procs/terrain/terrain_node.hpp"
#include "tests/support/box_drift.hpp"
#include "tests/support/robot_that_knows_its_place.hpp"

namespace adit {
namespace {

class RobotThatLooksAndPlans {
 public:
  explicit RobotThatLooksAndPlans(World world) : robot_(std::move(world)) {
    subscribe<planned_path_t>(bus_, channels::kPath, Delivery::queued(10),
                              [this](const PlannedPath& path) { paths_.push_back(path); });
    subscribe<terrain_t>(bus_, channels::kTerrain, Delivery::queued(100),
                         [this](const TerrainTile& tile) {
                           if (assembler_.add(tile)) ++terrains_;
                         });
  }

  /// Ten seconds, of which the sweep takes eight; then a goal straight ahead.
  PlannedPath look_and_plan(double distance_m) {
    robot_.run(1.5);
    publish(bus_, channels::kScanRequest,
            to_message(ScanRequest{bus_.now_utime(), 1, LaserId::kFront}));
    robot_.run(10.0);
    EXPECT_EQ(terrains_, 1);
    publish(bus_, channels::kGoal,
            to_message(PlanGoal{bus_.now_utime(), 2, PlanGoal::Kind::kAlong, {}, distance_m}));
    return paths_.empty() ? PlannedPath{} : paths_.back();
  }

  [[nodiscard]] Health terrain_health() const { return terrain_.health(); }

 private:
  static ScanAssemblyParams assembly_params() {
    ScanAssemblyParams params;
    params.lasers = groundhog_lasers();
    return params;
  }

  RobotThatKnowsItsPlace robot_;
  MemoryBus& bus_ = robot_.bus();
  ScanAssemblyNode scan_assembly_{bus_, assembly_params()};
  TerrainNode terrain_{bus_, TerrainParams{}};
  PlanningNode planning_{bus_, PlanningParams{}};
  TerrainAssembler assembler_;
  int terrains_ = 0;
  std::vector<PlannedPath> paths_;
};

TEST(LookAndPlan, FindsItsWayDownAFreeDrift) {
  RobotThatLooksAndPlans robot(box_drift());
  const PlannedPath path = robot.look_and_plan(8.0);
  EXPECT_EQ(path.outcome, PlanOutcome::kFound) << path.reason;
  EXPECT_EQ(path.id, 2);
  EXPECT_EQ(robot.terrain_health(), Health{});
  ASSERT_FALSE(path.points.empty());
  EXPECT_GT(path.points.back().T_odom_body.x, 7.0);
  // Half of the drift less half of the vehicle, and a cell: no path may leave it.
  for (const PathPoint& point : path.points) EXPECT_LT(std::abs(point.T_odom_body.y), 1.5);
}

TEST(LookAndPlan, SaysWhatStandsInItsWay) {
  RobotThatLooksAndPlans robot(box_drift({}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kWall, Material::kRock, "fall");
    builder.box(level_box({3.2, 0.0, 0.4}, {0.6, 4.0, 0.8}));
  }));
  const PlannedPath path = robot.look_and_plan(8.0);
  EXPECT_NE(path.outcome, PlanOutcome::kFound);
  EXPECT_TRUE(path.points.empty());
  EXPECT_FALSE(path.reason.empty());
  EXPECT_LT(path.reached_m, 2.0);
  EXPECT_FALSE(path.blocking.empty());
}

}  // namespace
}  // namespace adit
