// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// A simulated robot scans a tunnel with a post, plans a path and drives it: all nodes from the
// laser to the wheels on one bus.
#include <cmath>
#include <optional>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sim.hpp"
#include "procs/driving/driving_node.hpp"
#include "tests/support/drives/path_drive.hpp"
#include "tests/support/robots/planning_robot.hpp"
#include "tests/support/robots/simulated_robot.hpp"
#include "tests/support/scores/cross_track_error.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {
namespace {

World tunnel_with_post() {
  return box_tunnel({}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kPost, Material::kTimber, "post");
    builder.box(level_box({4.5, 0.35, 1.0}, {0.25, 0.25, 2.0}));
  });
}

template <class Robot>
class DrivingRobot {
 public:
  DrivingRobot() : robot_(tunnel_with_post()) {
    subscribe<driving_state_t>(bus_, channels::kDrivingState, Delivery::latest(),
                               [this](const DrivingState& state) { state_ = state; });
    subscribe<run_state_t>(bus_, channels::kRunState, Delivery::latest(),
                           [this](const RunState& state) { run_ = state; });
    subscribe<pose_t>(bus_, channels::kTruth, Delivery::latest(),
                      [this](const StampedPose& truth) { truth_ = truth.T_odom_body; });
  }

  void scan_and_plan(double distance_m) { robot_.scan_and_plan(distance_m); }

  /// Runs until arrival, at most two minutes; returns the true cross-track errors every 0.1 s.
  std::vector<double> drive() {
    CrossTrackError error(path().points);
    std::vector<double> errors_m;
    for (int i = 0; i < 1200 && state_.kind != DrivingState::Kind::kArrived; ++i) {
      robot_.run(0.1);
      errors_m.push_back(error(truth_.translation()));
    }
    robot_.run(1.5);  // RUN_STATE has a period of one second
    return errors_m;
  }

  [[nodiscard]] const PlannedPath& path() const { return robot_.path(); }
  [[nodiscard]] const DrivingState& state() const { return state_; }
  [[nodiscard]] const RunState& run_state() const { return run_; }
  [[nodiscard]] const Pose2& truth() const { return truth_; }

 private:
  PlanningRobot<Robot> robot_;
  MemoryBus& bus_ = robot_.bus();
  DrivingNode driving_{bus_, DrivingParams{}};
  DrivingState state_;
  RunState run_;
  Pose2 truth_;
};

template <class Robot>
class DriveAPath : public testing::Test {};

using Robots = testing::Types<GroundTruthRobot, ScanMatchingRobot>;
TYPED_TEST_SUITE(DriveAPath, Robots);

TYPED_TEST(DriveAPath, PassesAPostAndArrives) {
  DrivingRobot<TypeParam> robot;
  robot.scan_and_plan(8.0);
  ASSERT_EQ(robot.path().outcome, PlanOutcome::kFound) << robot.path().reason;
  const std::vector<double> errors_m = robot.drive();
  EXPECT_EQ(robot.state().kind, DrivingState::Kind::kArrived) << robot.state().reason;
  EXPECT_EQ(robot.state().path_id, 2);
  EXPECT_EQ(robot.run_state().failure, "");
  EXPECT_GT(robot.run_state().distance_travelled_m, 6.5);
  EXPECT_LE(absolute_quantile(errors_m, 0.95), 0.10);
  const Pose2 T_end_body = between(robot.path().points.back().T_odom_body, robot.truth());
  // Along the smooth tunnel wheels measure most of the motion: 0.02 m per root of a metre.
  constexpr bool kByTruth = std::is_same_v<TypeParam, GroundTruthRobot>;
  EXPECT_LE(T_end_body.translation().norm(), kByTruth ? 0.05 : 0.02 + 0.02 * std::sqrt(8.0));
  EXPECT_LE(std::abs(T_end_body.theta), deg_to_rad(2.0));
}

}  // namespace
}  // namespace adit
