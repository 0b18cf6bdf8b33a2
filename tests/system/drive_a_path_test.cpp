// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// A simulated robot looks at a drift with a post in it, finds its way and drives there: all nodes
// from the laser to the wheels on one bus.
#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/drive_command.hpp"
#include "common/messages/driving_state.hpp"
#include "common/messages/plan_goal.hpp"
#include "common/messages/planned_path.hpp"
#include "common/messages/pose.hpp"
#include "common/messages/run_state.hpp"
#include "common/messages/scan_request.hpp"
#include "procs/driving/driving_node.hpp"
#include "procs/planning/planning_node.hpp"
#include "procs/scan_assembly/scan_assembly_node.hpp"
#include "procs/terrain/terrain_node.hpp"
#include "tests/support/box_drift.hpp"
#include "tests/support/path_drive.hpp"
#include "tests/support/robot_that_knows_its_place.hpp"
#include "tests/support/robot_that_matches_scans.hpp"
#include "tests/support/true_lateral_error.hpp"

namespace adit {
namespace {

World drift_with_a_post() {
  return box_drift({}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kPost, Material::kTimber, "post");
    builder.box(level_box({4.5, 0.35, 1.0}, {0.25, 0.25, 2.0}));
  });
}

template <class Robot>
class RobotThatDrives {
 public:
  RobotThatDrives() : robot_(drift_with_a_post()) {
    subscribe<planned_path_t>(bus_, channels::kPath, Delivery::latest(),
                              [this](const PlannedPath& path) { path_ = path; });
    subscribe<driving_state_t>(bus_, channels::kDrivingState, Delivery::latest(),
                               [this](const DrivingState& state) { state_ = state; });
    subscribe<run_state_t>(bus_, channels::kRunState, Delivery::latest(),
                           [this](const RunState& state) { run_ = state; });
    subscribe<pose_t>(bus_, channels::kTruth, Delivery::latest(),
                      [this](const StampedPose& truth) { truth_ = truth.T_odom_body; });
  }

  /// Ten seconds, of which the sweep takes eight; then a goal straight ahead.
  void look_and_plan(double distance_m) {
    robot_.run(1.5);
    publish(bus_, channels::kScanRequest,
            to_message(ScanRequest{bus_.now_utime(), 1, LaserId::kFront}));
    robot_.run(10.0);
    publish(bus_, channels::kGoal,
            to_message(PlanGoal{bus_.now_utime(), 2, PlanGoal::Kind::kAlong, {}, distance_m}));
  }

  /// Until it stands again, for two minutes at most; the true errors, each 0.1 s.
  std::vector<double> drive() {
    TrueLateralError error(path_.points);
    std::vector<double> errors_m;
    for (int i = 0; i < 1200 && state_.kind != DrivingState::Kind::kArrived; ++i) {
      robot_.run(0.1);
      errors_m.push_back(error(truth_.translation()));
    }
    robot_.run(1.5);  // a RUN_STATE comes each second
    return errors_m;
  }

  [[nodiscard]] const PlannedPath& path() const { return path_; }
  [[nodiscard]] const DrivingState& state() const { return state_; }
  [[nodiscard]] const RunState& run_state() const { return run_; }
  [[nodiscard]] const Pose2& truth() const { return truth_; }

 private:
  static ScanAssemblyParams assembly_params() {
    ScanAssemblyParams params;
    params.lasers = groundhog_lasers();
    return params;
  }

  Robot robot_;
  MemoryBus& bus_ = robot_.bus();
  ScanAssemblyNode scan_assembly_{bus_, assembly_params()};
  TerrainNode terrain_{bus_, TerrainParams{}};
  PlanningNode planning_{bus_, PlanningParams{}};
  DrivingNode driving_{bus_, DrivingParams{}};
  PlannedPath path_;
  DrivingState state_;
  RunState run_;
  Pose2 truth_;
};

template <class Robot>
class DriveAPath : public testing::Test {};

using Robots = testing::Types<RobotThatKnowsItsPlace, RobotThatMatchesScans>;
TYPED_TEST_SUITE(DriveAPath, Robots);

TYPED_TEST(DriveAPath, GoesRoundAPostAndArrives) {
  RobotThatDrives<TypeParam> robot;
  robot.look_and_plan(8.0);
  ASSERT_EQ(robot.path().outcome, PlanOutcome::kFound) << robot.path().reason;
  const std::vector<double> errors_m = robot.drive();
  EXPECT_EQ(robot.state().kind, DrivingState::Kind::kArrived) << robot.state().reason;
  EXPECT_EQ(robot.state().path_id, 2);
  EXPECT_EQ(robot.run_state().failure, "");
  EXPECT_GT(robot.run_state().travelled_m, 6.5);
  EXPECT_LE(quantile(errors_m, 0.95), 0.10);
  const Pose2 T_end_body = between(robot.path().points.back().T_odom_body, robot.truth());
  EXPECT_LE(T_end_body.translation().norm(), 0.05);
  EXPECT_LE(std::abs(T_end_body.theta), deg_to_rad(2.0));
}

}  // namespace
}  // namespace adit
