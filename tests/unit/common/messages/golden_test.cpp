// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Golden bytes of sensing, vehicle, mission, simulation, diagnostics and procman messages.
#include "tests/unit/common/messages/golden.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/messages/diagnostics.hpp"
#include "common/messages/exploration.hpp"
#include "common/messages/lidar.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mission.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/procman.hpp"
#include "common/messages/seal.hpp"
#include "common/messages/sensing.hpp"
#include "common/messages/sim.hpp"
#include "tests/support/message_types.hpp"

namespace adit {
namespace {

using test::expect_golden;

constexpr std::int64_t kUtime = 0x0005'7d2a'1b2c'3d4e;  // in 2018; all bytes differ
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Golden, ExistsForEveryType) {
  std::set<std::string> types;
  for (const MessageType& type : message_types()) types.insert(type.name);
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(test::golden_folder())) {
    files.insert(entry.path().stem().string());
  }
  EXPECT_THAT(files, testing::ElementsAreArray(types));
}

TEST(Golden, PlanarLidar) {
  planar_lidar_t message;
  message.utime = kUtime;
  message.nranges = 3;
  message.ranges = {1.25F, 2.5F, 80.0F};
  message.nintensities = 0;
  message.rad0 = -1.5F;
  message.radstep = 0.5F;
  expect_golden(message, LaserScan{kUtime, {1.25F, 2.5F, 80.0F}, -1.5, 0.5});
}

TEST(Golden, SpinningLidar) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  spinning_lidar_t message;
  message.utime = kUtime;
  message.n_rings = 2;
  message.elevations_rad = {-0.125F, 0.25F};
  message.ring_azimuths_rad = {0.0F, -0.0625F};
  message.ring_times_us = {0.5F, 2.25F};
  message.range_unit_m = kLidarRangeUnitM;
  message.n_fragments = 3;
  message.fragment = 1;
  message.n_columns = 2;
  message.times_us = {0x010203, 0x040506};
  message.azimuths_rad = {3.0F, 2.5F};
  message.ranges = {{1000, 0}, {2000, 0x0708}};
  const LidarRevolution part{
      kUtime,
      {{-0.125F, 0.0F, 0.5F}, {0.25F, -0.0625F, 2.25F}},
      {{0x010203, 3.0F}, {0x040506, 2.5F}},
      {1000 * kLidarRangeUnitM, kInfinite, 2000 * kLidarRangeUnitM, 0x0708 * kLidarRangeUnitM}};
  expect_golden(message, LidarFragment{part, 3, 1});
}

TEST(Golden, Pose) {
  pose_t message;
  message.utime = kUtime;
  message.pos[0] = 12.5;
  message.pos[1] = -3.25;
  message.pos[2] = 0.0;
  message.vel[0] = 0.5;
  message.vel[1] = 0.25;
  message.vel[2] = kNaN;
  message.orientation[0] = std::cos(0.375);
  message.orientation[1] = 0.0;
  message.orientation[2] = 0.0;
  message.orientation[3] = std::sin(0.375);
  message.rotation_rate[0] = kNaN;
  message.rotation_rate[1] = kNaN;
  message.rotation_rate[2] = 0.125;
  std::ranges::fill(message.accel, kNaN);
  const StampedPose pose{kUtime, {12.5, -3.25, 0.75}, Eigen::Vector3d(0.5, 0.25, 0.125)};
  test::expect_golden_bytes(message);
  EXPECT_EQ(test::hex(encode(to_message(pose))), test::hex(encode(message)));
  const auto converted = from_message(message);
  ASSERT_TRUE(converted);
  EXPECT_EQ(converted->utime, kUtime);
  EXPECT_EQ(converted->T_odom_body.x, 12.5);
  EXPECT_EQ(converted->T_odom_body.y, -3.25);
  EXPECT_NEAR(converted->T_odom_body.theta, 0.75, 1e-15);  // through sine and cosine
  EXPECT_EQ(*converted->v_body, *pose.v_body);
}

TEST(Golden, Imu) {
  imu_t message;
  message.utime = kUtime;
  std::ranges::copy(std::array{0.125, 0.25, 0.375}, message.angular_velocity_rad_s);
  std::ranges::copy(std::array{1.5, 2.5, 9.75}, message.linear_acceleration_m_s2);
  message.has_orientation = 0;
  std::ranges::copy(std::array{1.0, 0.0, 0.0, 0.0}, message.orientation);
  expect_golden(message, ImuReading{kUtime, {0.125, 0.25, 0.375}, {1.5, 2.5, 9.75}});
}

TEST(Golden, WheelOdometry) {
  wheel_odometry_t message;
  message.utime = kUtime;
  message.x_m = 1.5;
  message.y_m = 2.5;
  message.theta_rad = 30.25;
  message.forward_m_s = kNaN;
  message.yaw_rate_rad_s = kNaN;
  expect_golden(message, WheelOdometry{kUtime, {1.5, 2.5, 30.25}});
}

TEST(Golden, MatchDoubt) {
  match_doubt_t message;
  message.utime = kUtime;
  message.from_utime = kUtime - 1'000'000;
  message.reason = match_doubt_t::REASON_AMBIGUOUS;
  message.n_alternatives = 1;
  message.T_odom_alternative = {{1.5, 2.5, 0.75}};
  message.scores = {0.875};
  const MatchDoubt::Alternative turned{{1.5, 2.5, 0.75}, 0.875};
  expect_golden(message,
                MatchDoubt{kUtime, kUtime - 1'000'000, MatchDoubt::Reason::kAmbiguous, {turned}});
}

TEST(Golden, Tilt) {
  tilt_t message;
  message.utime = kUtime;
  message.angle_rad = 0.75;
  message.rate_rad_s = -0.125;
  expect_golden(message, TiltReading{kUtime, 0.75, -0.125});
}

TEST(Golden, TiltCommand) {
  tilt_command_t message;
  message.utime = kUtime;
  message.goal_rad = -0.75;
  message.rate_max_rad_s = 0.125;
  expect_golden(message, TiltCommand{kUtime, -0.75, 0.125});
}

TEST(Golden, ScanRequest) {
  scan_request_t message;
  message.utime = kUtime;
  message.id = 0x01020304;
  message.laser = "LASER_REAR";
  expect_golden(message, ScanRequest{kUtime, 0x01020304, LaserId::kRear});
}

TEST(Golden, Gas) {
  gas_t message;
  message.utime = kUtime;
  message.methane_share = 0.125;
  message.oxygen_share = 0.25;
  message.carbon_monoxide_share = 0.5;
  expect_golden(message, GasReading{kUtime, 0.125, 0.25, 0.5});
}

TEST(Golden, Sinkage) {
  sinkage_t message;
  message.utime = kUtime;
  std::ranges::copy(std::array{0.125, 0.25, 0.375, 0.5}, message.depth_m);
  expect_golden(message, SinkageReading{kUtime, {0.125, 0.25, 0.375, 0.5}});
}

TEST(Golden, DriveCommand) {
  drive_command_t message;
  message.utime = kUtime;
  message.speed_m_s = -0.5;
  message.curvature_1_m = 0.25;
  expect_golden(message, DriveCommand{kUtime, -0.5, 0.25});
}

TEST(Golden, Stop) {
  stop_t message;
  message.utime = kUtime;
  message.stopped = 1;
  message.reason = "a wall is near";
  expect_golden(message, StopOrder{kUtime, true, "a wall is near"});
}

TEST(Golden, VehicleState) {
  vehicle_state_t message;
  message.utime = kUtime;
  message.speed_m_s = 0.5;
  message.curvature_1_m = -0.25;
  message.battery_share = 0.75;
  message.stopped = 0;
  message.expired = 1;
  expect_golden(message, VehicleState{kUtime, 0.5, -0.25, 0.75, false, true});
}

TEST(Golden, DrivingState) {
  driving_state_t message;
  message.utime = kUtime;
  message.path_id = 0x01020304;
  message.state = driving_state_t::STATE_FAILED;
  message.reason = "off the path";
  message.progress_m = 2.5;
  message.remaining_m = 7.25;
  message.lateral_error_m = 0.375;
  message.heading_error_rad = -0.125;
  expect_golden(message, DrivingState{kUtime,
                                      0x01020304,
                                      DrivingState::Kind::kFailed,
                                      "off the path",
                                      2.5,
                                      7.25,
                                      {0.375, -0.125}});
}

TEST(Golden, Phase) {
  phase_t message;
  message.utime = kUtime;
  message.sequence = 17;
  message.phase = phase_t::PHASE_EXECUTE;
  message.reason = "a path of 8.1 m";
  message.returning_home = 1;
  message.return_home_reason = "the route is blocked";
  message.laser = "LASER_REAR";
  message.goal_id = 4;
  message.frontier = 3;
  message.scans = 5;
  message.distance_travelled_m = 40.5;
  message.remaining_m = 800.25;
  message.outcome = phase_t::OUTCOME_HOME_UNCERTAIN;
  message.complete = 0;
  message.home_within_m = 1.375;
  MissionPhase phase;
  phase.utime = kUtime;
  phase.sequence = 17;
  phase.phase = Phase::kExecute;
  phase.reason = "a path of 8.1 m";
  phase.returning_home = true;
  phase.return_home_reason = "the route is blocked";
  phase.laser = LaserId::kRear;
  phase.goal_id = 4;
  phase.frontier = 3;
  phase.scans = 5;
  phase.distance_travelled_m = 40.5;
  phase.remaining_m = 800.25;
  phase.outcome = MissionOutcome::kHomeUncertain;
  phase.complete = false;
  phase.home_within_m = 1.375;
  expect_golden(message, phase);
}

TEST(Golden, ExploreRequest) {
  explore_request_t message;
  message.utime = kUtime;
  message.id = 6;
  message.remaining_m = 800.25;
  message.returning_home = 0;
  message.blocked = 1;
  message.blocked_utime = kUtime - 9;
  message.blocked_frontier = 2;
  message.reached_m = 1.375;
  message.evidence = "a beam";
  message.unconfirmed = 1;
  expect_golden(message, ExploreRequest{kUtime, 6, 800.25, false,
                                        BlockedVerdict{kUtime - 9, 2, 1.375, "a beam", true}});
}

TEST(Golden, MissionOrder) {
  mission_order_t message;
  message.utime = kUtime;
  message.kind = mission_order_t::KIND_STOP;
  expect_golden(message, MissionOrder{kUtime, MissionOrder::Kind::kStop});
}

TEST(Golden, SimTime) {
  sim_time_t message;
  message.utime = kUtime;
  expect_golden(message, SimTime{kUtime});
}

TEST(Golden, SimTimeDone) {
  sim_time_done_t message;
  message.utime = kUtime;
  message.stage = "mapping";
  expect_golden(message, SimTimeDone{kUtime, "mapping"});
}

TEST(Golden, SealNonce) {
  seal_nonce_t message;
  message.utime = kUtime;
  SealChallenge value{kUtime, {}};
  for (std::size_t i = 0; i < value.nonce.size(); ++i) {
    value.nonce.at(i) = static_cast<std::uint8_t>(0xF0 + i);
    message.nonce[i] = value.nonce.at(i);
  }
  expect_golden(message, value);
}

TEST(Golden, RunState) {
  run_state_t message;
  message.utime = kUtime;
  message.distance_travelled_m = 120.5;
  message.failure = "hit a post";
  expect_golden(message, RunState{kUtime, 120.5, "hit a post"});
}

TEST(Golden, Heartbeat) {
  heartbeat_t message;
  message.utime = kUtime;
  message.stage = "mapping";
  message.health = heartbeat_t::HEALTH_DEGRADED;
  message.reason = "no odometry";
  message.handled = 30;
  message.rejected = 20;
  message.dropped = 10;
  expect_golden(
      message, Heartbeat{kUtime, "mapping", {Health::Level::kDegraded, "no odometry"}, 30, 20, 10});
}

TEST(Golden, Config) {
  config_t message;
  message.utime = kUtime;
  message.stage = "mapping";
  message.version = "0.1.0";
  message.yaml = "mapping:\n  cell_m: 0.1\n";
  expect_golden(message, ConfigSnapshot{kUtime, "mapping", "0.1.0", "mapping:\n  cell_m: 0.1\n"});
}

TEST(Golden, StageStats) {
  stage_stats_t message;
  message.utime = kUtime;
  message.stage = "mapping";
  message.interval_s = 5.5;
  message.n_subscriptions = 2;
  message.channels = {"POSE", "IMU"};
  message.handled = {370, 371};
  message.rejected = {11, 12};
  message.dropped = {21, 22};
  message.handler_mean_ms = {0.5, 0.25};
  message.handler_max_ms = {3.5, 3.25};
  expect_golden(message,
                StageStats{kUtime,
                           "mapping",
                           5.5,
                           {{"POSE", 370, 11, 21, 0.5, 3.5}, {"IMU", 371, 12, 22, 0.25, 3.25}}});
}

procman_lcm::cmd_t command_message() {
  procman_lcm::cmd_t command;
  command.command_id = "mapping";
  command.exec_str = "adit-mapping --sim-time";
  command.group = "slam";
  command.auto_respawn = 1;
  command.stop_signal = 15;
  command.stop_time_allowed = 2.5F;
  return command;
}

const ProcmanCommand kCommand{"mapping", "adit-mapping --sim-time", "slam", true, 15, 2.5};

TEST(Golden, ProcmanInfo) {
  procman_lcm::cmd_status_t status;
  status.cmd = command_message();
  status.pid = 4711;
  status.actual_runid = 3;
  status.exit_code = 9;
  status.cpu_usage = 0.75F;
  status.mem_vsize_bytes = 120'000'000;
  status.mem_rss_bytes = 40'000'000;
  procman_lcm::deputy_info_t message;
  message.utime = kUtime;
  message.deputy_id = "robot";
  message.cpu_load = 0.5F;
  message.phys_mem_total_bytes = 8'000'000'000;
  message.phys_mem_free_bytes = 3'000'000'000;
  message.swap_total_bytes = 2'000'000'000;
  message.swap_free_bytes = 1'000'000'000;
  message.ncmds = 1;
  message.cmds = {status};
  expect_golden(message,
                ProcmanInfo{kUtime,
                            "robot",
                            {0.5, 8'000'000'000, 3'000'000'000, 2'000'000'000, 1'000'000'000},
                            {{kCommand, 4711, 3, 9, 0.75, 120'000'000, 40'000'000}}});
}

TEST(Golden, ProcmanOrders) {
  procman_lcm::cmd_desired_t desired;
  desired.cmd = command_message();
  desired.desired_runid = 4;
  desired.force_quit = 0;
  procman_lcm::orders_t message;
  message.utime = kUtime;
  message.deputy_id = "robot";
  message.sheriff_id = "base";
  message.ncmds = 2;
  message.cmds = {desired, desired};
  message.cmds[1].desired_runid = 5;
  message.cmds[1].force_quit = 1;
  expect_golden(
      message, ProcmanOrders{kUtime, "robot", "base", {{kCommand, 4, false}, {kCommand, 5, true}}});
}

TEST(Golden, ProcmanOutput) {
  procman_lcm::output_t message;
  message.utime = kUtime;
  message.deputy_id = "robot";
  message.num_commands = 2;
  message.command_ids = {"mapping", "terrain"};
  message.text = {"a loop closure\n", "no cloud\n"};
  expect_golden(
      message,
      ProcmanOutput{kUtime, "robot", {{"mapping", "a loop closure\n"}, {"terrain", "no cloud\n"}}});
}

TEST(Golden, ProcmanDiscovery) {
  procman_lcm::discovery_t message;
  message.utime = kUtime;
  message.transmitter_id = "base";
  message.nonce = 77;
  expect_golden(message, ProcmanDiscovery{kUtime, "base", 77});
}

}  // namespace
}  // namespace adit
