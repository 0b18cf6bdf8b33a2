// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/drive/drive_run.hpp"

#include <fstream>
#include <set>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/log/event_source.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;

constexpr const char* kWorld = R"(world:
  name: small
  T_world_start: {x_m: 3, y_m: 0, theta_rad: 0}
  plan:
    tunnels:
      - {name: main, points_m: [0, 0, 20, 0], width_m: 3.5}
      - {name: side, points_m: [12, 0, 12, 10], width_m: 3.5}
)";

class DriveRun : public testing::Test {
 protected:
  DriveRun() { std::ofstream(folder_ / "small.yaml") << kWorld; }

  DriveRunOptions options(const std::string& waypoints, const std::string& log) {
    std::ofstream(folder_ / "waypoints.txt") << waypoints;
    DriveRunOptions options;
    options.world.name = folder_ / "small.yaml";
    options.waypoints = folder_ / "waypoints.txt";
    options.log = folder_ / log;
    return options;
  }

  test::ScratchFolder folder_;
};

TEST_F(DriveRun, ReachesTheLastWaypoint) {
  DriveRunOptions drive = options("6 0\n8 0\n", "run.lcmlog");
  drive.truth = folder_ / "run.tum";
  double share = 0.0;
  const DriveRunResult result = run_drive(drive, [&](double done) { share = done; });
  EXPECT_EQ(result.failure, "");
  EXPECT_NEAR(result.distance_travelled_m, 5.0, 0.3);
  EXPECT_GT(share, 0.9);
  const Trajectory truth = read_tum(folder_ / "run.tum");
  EXPECT_NEAR(truth.back().pose.x, 8.0, 0.2);  // arrival and braking
  EXPECT_NEAR(truth.back().pose.y, 0.0, 0.1);
  EXPECT_LT(truth.front().utime, kDriveStartUtime + 100'000);
}

TEST_F(DriveRun, IsReproducibleAndDependsOnTheSeed) {
  run_drive(options("5 0\n", "first.lcmlog"));
  run_drive(options("5 0\n", "second.lcmlog"));
  DriveRunOptions other = options("5 0\n", "third.lcmlog");
  other.world.seed = 2;
  run_drive(other);
  const std::string first = test::contents(folder_ / "first.lcmlog");
  EXPECT_GT(first.size(), 100'000U);
  EXPECT_TRUE(first == test::contents(folder_ / "second.lcmlog"));
  EXPECT_FALSE(first == test::contents(folder_ / "third.lcmlog"));
}

TEST_F(DriveRun, RecordsAllChannels) {
  run_drive(options("5 0\n", "run.lcmlog"));
  LogFile log(folder_ / "run.lcmlog");
  std::set<std::string> channels;
  while (const auto event = log.next()) channels.emplace(event->channel);
  EXPECT_THAT(channels,
              IsSupersetOf({"LASER_FRONT", "LASER_REAR", "TILT_FRONT", "TILT_REAR", "IMU",
                            "WHEEL_ODOMETRY", "DRIVE_COMMAND", "VEHICLE_STATE", "GAS", "SINKAGE",
                            "TRUTH", "RUN_STATE", "SIM_TIME", "CONFIG", "HEARTBEAT"}));
}

TEST_F(DriveRun, ReportsAFailureAndKeepsTheLog) {
  const DriveRunResult result = run_drive(options("8 6\n", "run.lcmlog"));  // through rock
  EXPECT_NE(result.failure, "");
  EXPECT_GT(LogFile(folder_ / "run.lcmlog").size(), 1000U);
}

TEST_F(DriveRun, RejectsFaultsOfProcesses) {
  DriveRunOptions drive = options("5 0\n", "run.lcmlog");
  drive.faults = {"kill:mapping@1"};
  EXPECT_THROW(run_drive(drive), std::invalid_argument);
}

TEST_F(DriveRun, RejectsOptionsOfRandomMinesForOtherWorlds) {
  DriveRunOptions drive = options("5 0\n", "run.lcmlog");
  drive.world.damage = 0.5;
  EXPECT_THROW(run_drive(drive), std::invalid_argument);
}

}  // namespace
}  // namespace adit
