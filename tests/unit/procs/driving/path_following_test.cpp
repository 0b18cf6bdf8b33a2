// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Drives along paths in the simulator, with noise of poses and with slip. All figures, with more
// drives: tests/eval, path_following_table.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/drives/path_drive.hpp"
#include "tests/support/drives/test_paths.hpp"

namespace adit {
namespace {

using Kind = DrivingState::Kind;

constexpr double kErrorMaxM = 0.10;     // for 95 % of the path
constexpr double kSwingsPerM = 0.6;     // a slalom of bends of 2.5 m, each cut once
constexpr double kSteeringRate = 0.31;  // rms [1/m/s]; the limit is 0.5

class PathFollowing : public testing::TestWithParam<const char*> {
 protected:
  static PathDriveSetup setup() {
    PathDriveSetup setup;
    setup.driving.vehicle.steering = GetParam();
    return setup;
  }
};

/// Four drives with different noise and slip.
void expect_small_error(const PlannedPath& path, PathDriveSetup setup) {
  std::vector<double> cross_track_error_m;
  for (setup.seed = 1; setup.seed <= 4; ++setup.seed) {
    const PathDrive drive = drive_path(path, setup);
    EXPECT_EQ(drive.end, Kind::kArrived) << drive.reason;
    EXPECT_LE(drive.oscillations_per_m, kSwingsPerM);
    EXPECT_LE(drive.steering_rms_1_m_s, kSteeringRate);
    cross_track_error_m.insert(cross_track_error_m.end(), drive.cross_track_error_m.begin(),
                               drive.cross_track_error_m.end());
  }
  EXPECT_LE(absolute_quantile(cross_track_error_m, 0.95), kErrorMaxM);
}

TEST_P(PathFollowing, StaysOnEachShapeInBothDirections) {
  for (const PathShape& shape : path_shapes(setup().driving.vehicle, 1.6)) {
    SCOPED_TRACE(shape.name);
    expect_small_error(shape.path, setup());
    expect_small_error(driven_in_reverse(shape.path), setup());
  }
}

TEST_P(PathFollowing, StaysOnPlannedPaths) {
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    expect_small_error(random_corridor_path(seed, setup().driving.vehicle), setup());
  }
}

TEST_P(PathFollowing, ArrivesAtTheEndWithExactPoses) {
  PathDriveSetup quiet = setup();
  quiet.noise = PoseNoise::none();
  for (const PathShape& shape : path_shapes(quiet.driving.vehicle, 1.8)) {
    SCOPED_TRACE(shape.name);
    const PathDrive drive = drive_path(shape.path, quiet);
    EXPECT_EQ(drive.end, Kind::kArrived) << drive.reason;
    EXPECT_LE(drive.T_end_body.translation().norm(), 0.05);
    EXPECT_LE(std::abs(drive.T_end_body.theta), deg_to_rad(2.0));
  }
}

TEST_P(PathFollowing, CorrectsAStartBesideThePath) {
  PathDriveSetup quiet = setup();
  quiet.noise = PoseNoise::none();
  for (const double side : {-1.0, 1.0}) {
    for (const double turn : {-1.0, 1.0}) {
      const Pose2 start{0.0, 0.07 * side, deg_to_rad(5.6) * turn};
      const auto path = TestPathBuilder(quiet.driving.vehicle, start).forward(10.0).path();
      const PathDrive drive = drive_path(path, quiet);
      ASSERT_EQ(drive.end, Kind::kArrived) << drive.reason;
      // After 5 m, six times the response, the remaining error is due to side slip.
      const std::vector<double> late(drive.cross_track_error_m.begin() + 250,
                                     drive.cross_track_error_m.end());
      EXPECT_LE(absolute_quantile(late, 1.0), 0.05);
    }
  }
}

TEST_P(PathFollowing, StopsWithinItsBrakingDistanceWhenPosesEnd) {
  PathDriveSetup stale = setup();
  stale.poses_end_m = 4.0;
  const PathDrive drive =
      drive_path(TestPathBuilder(stale.driving.vehicle).forward(12.0).path(), stale);
  const double v = drive.speed_at_last_pose_m_s;
  EXPECT_EQ(drive.end, Kind::kWaiting);
  EXPECT_NEAR(v, stale.driving.speed.speed_m_s, 0.01);
  // The maximum age of a pose and a period of commands; 1 cm for the time steps.
  const double reaction_s = stale.driving.localization.pose_age_max_s + 0.05;
  EXPECT_LE(drive.distance_without_poses_m, v * reaction_s + v * v / (2.0 * 0.8) + 0.01);
}

TEST_P(PathFollowing, IsDeterministic) {
  const auto path = path_shapes(setup().driving.vehicle, 1.6)[3].path;
  EXPECT_EQ(drive_path(path, setup()).cross_track_error_m,
            drive_path(path, setup()).cross_track_error_m);
}

INSTANTIATE_TEST_SUITE_P(Driving, PathFollowing, testing::Values("four_wheel", "ackermann"));

TEST(PurePursuit, FollowsGentlePaths) {
  PathDriveSetup setup;
  setup.driving.controller = "pure_pursuit";
  const auto shapes = path_shapes(setup.driving.vehicle, 1.6);
  for (const std::size_t i : {0U, 1U, 2U}) {  // straight, gentle S, circle
    SCOPED_TRACE(shapes[i].name);
    expect_small_error(shapes[i].path, setup);
    expect_small_error(driven_in_reverse(shapes[i].path), setup);
  }
}

}  // namespace
}  // namespace adit
