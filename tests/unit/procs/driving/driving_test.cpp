// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/driving.hpp"

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/geometry/pose2.hpp"
#include "tests/support/drives/test_paths.hpp"

namespace adit {
namespace {

using Kind = DrivingState::Kind;

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kPeriodUs = 50'000;

/// A vehicle with four-wheel steering that executes commands without delay.
class IdealVehicle : public testing::Test {
 protected:
  DriveOutput step(bool with_pose = true) {
    utime_ += kPeriodUs;
    if (with_pose) driving_.add_pose(utime_, T_odom_body_);
    DriveOutput output = driving_.drive(utime_);
    const double distance_m = output.command.speed_m_s * 1e-6 * kPeriodUs;
    T_odom_body_ = T_odom_body_ * along_arc(distance_m, distance_m * output.command.curvature_1_m);
    return output;
  }

  /// Drives until a state is reached, for at most a minute.
  DriveOutput drive_until(Kind kind, const std::function<void(const DriveOutput&)>& inspect = {}) {
    DriveOutput output;
    for (int i = 0; i < 1200; ++i) {
      output = step();
      if (inspect) inspect(output);
      if (output.state.kind == kind) break;
    }
    return output;
  }

  /// A cycle of a vehicle that is held by a stop order.
  DriveOutput step_while_held() {
    utime_ += kPeriodUs;
    driving_.add_pose(utime_, T_odom_body_);
    VehicleState state;
    state.utime = utime_;
    state.stopped = true;
    driving_.add_state(state);
    return driving_.drive(utime_);
  }

  void match(ScanMatch::Status status, std::vector<DegenerateDirection> degenerate = {}) {
    ScanMatch match;
    match.utime = utime_;
    match.status = status;
    match.degenerate = std::move(degenerate);
    driving_.add_match(match);
  }

  void step_for(double seconds, bool with_pose = true) {
    for (int i = 0; i < std::lround(seconds / 0.05); ++i) step(with_pose);
  }

  void expect_stopped(Kind kind, const std::string& reason, bool with_pose = true) {
    const DriveOutput output = step(with_pose);
    EXPECT_EQ(output.command.speed_m_s, 0.0);
    EXPECT_EQ(output.command.utime, utime_);
    EXPECT_EQ(output.state.kind, kind);
    EXPECT_EQ(output.state.reason, reason);
  }

  static PlannedPath straight(std::int32_t id = 1) {
    PlannedPath path = TestPathBuilder({}).forward(8.0).path();
    path.id = id;
    return path;
  }

  const DrivingParams params_;
  Driving driving_{params_};
  std::int64_t utime_ = kStart;
  Pose2 T_odom_body_;
};

TEST_F(IdealVehicle, StandsWithoutAPath) { expect_stopped(Kind::kIdle, "no path received yet"); }

TEST_F(IdealVehicle, DrivesToTheEndAndStopsThere) {
  driving_.follow(straight(7));
  double fastest = 0.0;
  double before = 0.0;
  const DriveOutput output = drive_until(Kind::kArrived, [&](const DriveOutput& out) {
    fastest = std::max(fastest, out.command.speed_m_s);
    EXPECT_LE(out.command.speed_m_s, before + params_.speed.acceleration_m_s2 * 0.05 + 1e-9);
    before = out.command.speed_m_s;
  });
  EXPECT_DOUBLE_EQ(fastest, params_.speed.speed_m_s);
  EXPECT_EQ(output.state.path_id, 7);
  EXPECT_NEAR(T_odom_body_.x, 8.0, 0.03);
  EXPECT_NEAR(output.state.progress_m, 8.0, 0.02);
  EXPECT_NEAR(output.state.remaining_m, 0.0, 0.02);
  expect_stopped(Kind::kArrived, "");
  step_for(1.0, false);
  expect_stopped(Kind::kArrived, "", false);
}

TEST_F(IdealVehicle, StandsInACuspUntilTheCurvatureIsReversed) {
  driving_.follow(TestPathBuilder({}).forward(2.0, 0.5).back(2.0, -0.5).path());
  int standing = 0;
  bool reversed = false;
  const DriveOutput end = drive_until(Kind::kArrived, [&](const DriveOutput& out) {
    const DriveCommand& command = out.command;
    const bool between_runs = out.state.progress_m > 1.5 && out.state.progress_m < 2.5;
    if (between_runs && command.speed_m_s == 0.0) ++standing;
    if (command.speed_m_s < 0.0 && !reversed) {
      EXPECT_LT(command.curvature_1_m, -0.3);  // within 0.2 1/m
      reversed = true;
    }
    EXPECT_FALSE(reversed && command.speed_m_s > 0.0);
  });
  EXPECT_TRUE(reversed);
  EXPECT_GE(standing, 40);  // from 0.5 to -0.45 at 0.4 1/m/s takes 2.4 s
  EXPECT_EQ(end.state.kind, Kind::kArrived);
  const Pose2 T_odom_end =
      TestPathBuilder({}).forward(2.0, 0.5).back(2.0, -0.5).path().points.back().T_odom_body;
  EXPECT_LT(between(T_odom_end, T_odom_body_).translation().norm(), 0.05);
  EXPECT_LT(std::abs(between(T_odom_end, T_odom_body_).theta), deg_to_rad(2.0));
}

TEST_F(IdealVehicle, ArrivesImmediatelyOnAPathOfOnePoint) {
  PlannedPath path = straight();
  path.points.resize(1);
  driving_.follow(path);
  EXPECT_EQ(drive_until(Kind::kArrived).state.kind, Kind::kArrived);
  EXPECT_EQ(T_odom_body_, Pose2{});
}

TEST_F(IdealVehicle, WaitsForPosesAndResumes) {
  driving_.follow(straight());
  expect_stopped(Kind::kWaiting, "no pose received yet", false);
  step_for(5.0);
  EXPECT_EQ(step().state.kind, Kind::kDriving);
  step_for(0.25, false);
  expect_stopped(Kind::kWaiting, "the newest pose is stale", false);
  EXPECT_EQ(step().state.kind, Kind::kDriving);
  EXPECT_EQ(drive_until(Kind::kArrived).state.kind, Kind::kArrived);
}

TEST_F(IdealVehicle, WaitsWhileScanMatchingIsLost) {
  driving_.follow(straight());
  step_for(3.0);
  match(ScanMatch::Status::kLost);
  step_for(0.5);
  EXPECT_EQ(driving_.state().kind, Kind::kDriving);
  match(ScanMatch::Status::kLost);  // again
  expect_stopped(Kind::kWaiting, "scan matching is lost");
  match(ScanMatch::Status::kRejected);  // does not count
  expect_stopped(Kind::kWaiting, "scan matching is lost");
  match(ScanMatch::Status::kMatched);
  EXPECT_EQ(step().state.kind, Kind::kDriving);
}

/// In a smooth tunnel without wheel odometry the pose stands still, and the robot never arrives.
TEST_F(IdealVehicle, FailsAfterADistanceOfUnobservedMotion) {
  using Fill = DegenerateDirection::Fill;
  const DegenerateDirection filled{Eigen::Vector3d::UnitX(), Fill::kOdometry};
  const DegenerateDirection open{Eigen::Vector3d::UnitX(), Fill::kNone};
  driving_.follow(straight());
  step_for(3.0);
  double distance_m = 0.0;
  const auto drive = [&](int steps) {
    for (int i = 0; i < steps && driving_.state().kind == Kind::kDriving; ++i) {
      const Pose2 T_odom_estimated = T_odom_body_;
      distance_m += step().command.speed_m_s * 0.05;
      T_odom_body_ = T_odom_estimated;
    }
  };
  match(ScanMatch::Status::kMatched, {filled});
  drive(400);
  EXPECT_GT(distance_m, 7.0);  // 20 s at 0.4 m/s
  EXPECT_EQ(driving_.state().kind, Kind::kDriving);
  distance_m = 0.0;
  match(ScanMatch::Status::kMatched, {open});
  drive(1200);
  EXPECT_EQ(driving_.state().kind, Kind::kFailed);
  EXPECT_NE(driving_.state().reason.find("not observed"), std::string::npos);
  EXPECT_NEAR(distance_m, params_.progress.unobserved_distance_max_m, 0.05);  // a few steps
}

/// A laser that scans the floor reports a standing robot while the wheels turn.
TEST_F(IdealVehicle, FailsWhereWheelOdometryAndScansDiffer) {
  driving_.follow(straight());
  const auto drive = [&](double seconds, bool moves) {
    for (int i = 0; i < std::lround(seconds / 0.05); ++i) {
      const Pose2 T_odom_before = T_odom_body_;
      VehicleState state;
      state.utime = utime_;
      state.speed_m_s = step().command.speed_m_s;
      driving_.add_state(state);
      if (!moves) T_odom_body_ = T_odom_before;
    }
  };
  drive(8.0, true);
  EXPECT_EQ(driving_.state().kind, Kind::kDriving);
  drive(3.0, false);
  EXPECT_EQ(driving_.state().kind, Kind::kFailed);
  EXPECT_NE(driving_.state().reason.find("differ by"), std::string::npos);
}

TEST_F(IdealVehicle, FailsBesideThePathUntilANewOneArrives) {
  driving_.follow(straight());
  step_for(5.0);
  const Pose2 on_path = T_odom_body_;
  T_odom_body_.y = 0.6;
  expect_stopped(Kind::kFailed, "0.60 m off the path");
  T_odom_body_ = on_path;
  step_for(1.0);
  expect_stopped(Kind::kFailed, "0.60 m off the path");
  driving_.follow(TestPathBuilder({}, T_odom_body_).forward(2.0).path());
  EXPECT_EQ(step().state.kind, Kind::kDriving);
}

TEST_F(IdealVehicle, FailsOnAPathThatStartsElsewhere) {
  driving_.follow(TestPathBuilder({}, {1.5, 0.0, 0.0}).forward(5.0).path());
  expect_stopped(Kind::kFailed, "1.50 m off the path");
}

TEST_F(IdealVehicle, RejectsAnEndlessPath) {
  PlannedPath path = straight();
  path.points.back().T_odom_body.x = 1e300;
  driving_.follow(path);
  expect_stopped(Kind::kIdle, "the path exceeds the maximum length");
}

TEST_F(IdealVehicle, FailsOnAPathInAnotherDirection) {
  T_odom_body_.theta = 0.6;
  driving_.follow(straight());
  expect_stopped(Kind::kFailed, "heading 34 degrees off the path");
}

TEST_F(IdealVehicle, StopsWhenANewPlanFoundNoPath) {
  driving_.follow(straight());
  step_for(5.0);
  PlannedPath none;
  none.id = 2;
  none.reason = "No path: blocked by a roof that is too low.";
  driving_.follow(none);
  expect_stopped(Kind::kIdle, none.reason);
  EXPECT_EQ(driving_.state().path_id, 2);
}

TEST_F(IdealVehicle, CommandsCreepingWhileHeldAndResumes) {
  driving_.follow(straight());
  step_for(5.0);
  for (int i = 0; i < 20; ++i) {
    const DriveOutput output = step_while_held();
    EXPECT_EQ(output.state.kind, Kind::kWaiting);
    EXPECT_EQ(output.state.reason, "held by a stop order");
    EXPECT_DOUBLE_EQ(output.command.speed_m_s, 0.05);
  }
  step_for(0.3);  // without vehicle states: the last one is stale
  const DriveOutput output = step();
  EXPECT_EQ(output.state.kind, Kind::kDriving);
  EXPECT_DOUBLE_EQ(output.command.speed_m_s, 0.05);  // what caused the hold is still near
  EXPECT_EQ(drive_until(Kind::kArrived).state.kind, Kind::kArrived);
}

TEST_F(IdealVehicle, FailsAfterALongHold) {
  driving_.follow(straight());
  step_for(5.0);
  for (int i = 0; i < 201; ++i) EXPECT_EQ(step_while_held().state.kind, Kind::kWaiting);
  const DriveOutput output = step_while_held();
  EXPECT_EQ(output.state.kind, Kind::kFailed);
  EXPECT_EQ(output.state.reason, "held by a stop order, no progress for 10 s");
  EXPECT_EQ(output.command.speed_m_s,
            0.0);  // so that an obstacle ahead is no reason to hold it any more
  step_for(0.5);
  driving_.follow(TestPathBuilder({}, T_odom_body_).forward(2.0).path());
  EXPECT_EQ(step_while_held().state.kind, Kind::kWaiting);
}

TEST_F(IdealVehicle, KeepsItsProgressWhileHeld) {
  driving_.follow(straight());
  step_for(5.0);
  for (int i = 0; i < 10; ++i) step_while_held();
  const double held_m = step_while_held().state.progress_m;
  for (int i = 0; i < 100; ++i) step_while_held();
  // Up to the prediction of the last commands, 50 ms at 0.5 m/s.
  EXPECT_NEAR(held_m, T_odom_body_.x, 0.026);
  EXPECT_NEAR(driving_.state().progress_m, held_m, 1e-6);
}

TEST_F(IdealVehicle, DoesNotCreepWhileNotLocalized) {
  driving_.follow(straight());
  step_for(5.0);
  step_while_held();
  match(ScanMatch::Status::kLost);
  for (int i = 0; i < 11; ++i) step_while_held();
  const DriveOutput output = step_while_held();
  EXPECT_EQ(output.state.reason, "scan matching is lost");
  EXPECT_EQ(output.command.speed_m_s, 0.0);
}

TEST_F(IdealVehicle, AcceptsANewPathWhileMoving) {
  driving_.follow(straight());
  step_for(5.0);
  const double before = step().command.speed_m_s;
  driving_.follow(TestPathBuilder({}, T_odom_body_).forward(5.0).path());
  EXPECT_GE(step().command.speed_m_s, before);
  driving_.follow(TestPathBuilder({}, T_odom_body_).back(2.0).path());
  EXPECT_EQ(step().command.speed_m_s, 0.0);
  EXPECT_EQ(drive_until(Kind::kArrived).state.kind, Kind::kArrived);
}

TEST_F(IdealVehicle, WaitsAfterAStepBackOfTheClock) {
  driving_.follow(straight());
  step_for(5.0);
  utime_ -= 3'600'000'000;  // the clock of the commands only
  expect_stopped(Kind::kWaiting, "the newest pose is from the future", false);
  EXPECT_EQ(step().state.kind, Kind::kDriving);
}

TEST(Driving, RejectsAVehicleThatCannotBeSteered) {
  DrivingParams params;
  params.vehicle.steering = "ackermann";
  params.vehicle.turning_radius_m = 0.5;
  EXPECT_THROW(Driving{params}, std::invalid_argument);
}

}  // namespace
}  // namespace adit
