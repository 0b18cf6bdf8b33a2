// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/trajectory_score.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "common/bus/log/lcm_log.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

class GroundTruth : public testing::Test {
 protected:
  void write(std::int64_t utime, const std::string& channel, const Pose2& pose) {
    const auto bytes = encode(to_message(StampedPose{utime, pose, {}}));
    log_.write({utime, channel, bytes});
  }

  test::ScratchFolder folder_;
  LogWriter log_{folder_ / "run.lcmlog"};
};

TEST_F(GroundTruth, ReadsTheTruthChannel) {
  write(1'000'000, "TRUTH", {1.0, 2.0, 0.5});
  write(1'000'000, "POSE", {9.0, 9.0, 0.0});
  write(2'000'000, "TRUTH", {2.0, 2.0, -3.0});
  write(2'000'000, "TRUTH", {8.0, 8.0, 0.0});  // duplicate time
  log_.close();
  const Trajectory truth = read_ground_truth(folder_ / "run.lcmlog");
  ASSERT_EQ(truth.size(), 2U);
  EXPECT_EQ(truth[1].utime, 2'000'000);
  EXPECT_NEAR(between(truth[1].pose, {2.0, 2.0, -3.0}).vector().norm(), 0.0, 1e-9);
}

TEST_F(GroundTruth, RejectsALogWithoutTruth) {
  write(1'000'000, "POSE", {});
  log_.close();
  EXPECT_THROW(read_ground_truth(folder_ / "run.lcmlog"), std::runtime_error);
  EXPECT_THROW(read_ground_truth(folder_ / "missing.lcmlog"), std::runtime_error);
}

}  // namespace
namespace {

/// Straight along x from the origin, a pose every 0.1 m and 0.1 s.
Trajectory straight(double length_m, double scale = 1.0) {
  Trajectory trajectory;
  for (int i = 0; i <= std::lround(10.0 * length_m); ++i) {
    trajectory.push_back({1'000'000 + 100'000 * i, {scale * 0.1 * i, 0.0, 0.0}});
  }
  return trajectory;
}

Trajectory moved(const Pose2& T_to_from, Trajectory trajectory) {
  for (TimedPose& at : trajectory) at.pose = T_to_from * at.pose;
  return trajectory;
}

TEST(TrajectoryScore, APerfectPathHasNoErrorInAnyFrame) {
  const Trajectory truth = straight(120.0);
  const Pose2 T_map_world{3.0, -4.0, 2.0};
  const TrajectoryScore score = score_trajectory(moved(T_map_world, truth), truth);
  EXPECT_EQ(score.poses, truth.size());
  EXPECT_NEAR(between(T_map_world.inverse(), score.T_world_map).vector().norm(), 0.0, 1e-9);
  EXPECT_NEAR(score.aligned.max_m, 0.0, 1e-9);
  EXPECT_NEAR(score.anchored.max_m, 0.0, 1e-9);
  EXPECT_NEAR(score.true_length_m, 120.0, 1e-9);
  EXPECT_NEAR(score.length_ratio, 1.0, 1e-9);
  for (const RelativeErrors& errors : score.relative) {
    EXPECT_GT(errors.segments, 0U);
    EXPECT_NEAR(errors.translation_m, 0.0, 1e-9);
    EXPECT_NEAR(errors.rotation_deg, 0.0, 1e-6);
  }
}

TEST(TrajectoryScore, AScaledPathHasProportionalErrors) {
  // 2 % short over 100 m. Anchored: maximum 2 m, mean 1 m, RMSE 2 / √3 m; aligned: half of that.
  const Trajectory truth = straight(100.0);
  const TrajectoryScore score = score_trajectory(straight(100.0, 0.98), truth);
  EXPECT_NEAR(score.anchored.max_m, 2.0, 1e-9);
  EXPECT_NEAR(score.anchored.mean_m, 1.0, 1e-9);
  EXPECT_NEAR(score.anchored.rmse_m, 2.0 / std::sqrt(3.0), 1e-3);  // a sum instead of the integral
  EXPECT_NEAR(score.aligned.max_m, 1.0, 1e-9);
  EXPECT_NEAR(score.aligned.rmse_m, 1.0 / std::sqrt(3.0), 1e-3);
  EXPECT_NEAR(score.length_ratio, 0.98, 1e-9);
  EXPECT_NEAR(score.relative[0].translation_m, 0.02, 2.1e-3);  // a segment may be a pose longer
  EXPECT_NEAR(score.relative[1].translation_m, 0.2, 2.1e-3);
}

/// An error that grows with the distance from the start as the allowed one does, less 0.05 m.
TEST(TrajectoryScore, ComparesErrorsWithThoseAllowedAtTheirDistance) {
  const Trajectory truth = straight(1000.0);
  Trajectory found = truth;
  for (TimedPose& at : found) {
    at.z_m = 2.0 * 0.0003 * at.pose.x;
    at.pose.y = 0.0002 * at.pose.x;
  }
  const TrajectoryScore score = score_trajectory(found, truth);
  // The mean square of x/(x + c) over 0 to L, with c = 0.05/0.0002 = 250 m or 0.05/0.0003 = 167 m:
  // 1 − (2c/L) ln((L + c)/c) + (c/L)(1 − c/(L + c)).
  const auto expected = [](double c, double L) {
    return std::sqrt(1.0 - 2.0 * c / L * std::log((L + c) / c) + c / L * (1.0 - c / (L + c)));
  };
  EXPECT_NEAR(score.plan_of_allowed, expected(0.05 / 0.0002, 1000.0), 1e-3);
  EXPECT_NEAR(score.height_of_allowed, 2.0 * expected(0.05 / 0.0003, 1000.0), 1e-3);
}

TEST(TrajectoryScore, ASingleRotationAffectsTheSegmentsThatContainIt) {
  // 10° in the middle of 40 m: about a third of the 31 segments of 10 m contain it.
  const double turn = deg_to_rad(10.0);
  const Trajectory truth = straight(40.0);
  Trajectory found = truth;
  for (TimedPose& at : found) {
    if (at.pose.x > 20.05) at.pose = Pose2{20.0, 0.0, turn} * Pose2{at.pose.x - 20.0, 0.0, 0.0};
  }
  const TrajectoryScore score = score_trajectory(found, truth);
  EXPECT_EQ(score.relative[1].length_m, 10.0);
  EXPECT_NEAR(static_cast<double>(score.relative[1].segments), 31.0, 1.0);
  // Segments that start within 10 m before the rotation.
  EXPECT_NEAR(score.relative[1].rotation_deg, 10.0 * 10.0 / 31.0, 0.4);  // one segment more or less
  EXPECT_EQ(score.relative[2].segments, 0U);  // the path is shorter than 100 m
}

TEST(TrajectoryScore, NoiseAddsNoLength) {
  const Trajectory truth = straight(50.0);
  Trajectory found = truth;
  for (std::size_t i = 0; i < found.size(); ++i) found[i].pose.y = i % 2 == 0 ? 0.05 : -0.05;
  EXPECT_NEAR(path_length_m(found) / path_length_m(truth), std::sqrt(2.0), 1e-3);
  // In steps of half a metre 0.1 m to the side are 2 %.
  EXPECT_NEAR(score_trajectory(found, truth).length_ratio, 1.0, 0.02);
}

TEST(TrajectoryScore, RejectsTrajectoriesWithoutCommonTimes) {
  Trajectory later = straight(10.0);
  for (TimedPose& at : later) at.utime += 1'000'000'000;
  EXPECT_THROW(score_trajectory(later, straight(10.0)), std::runtime_error);
  EXPECT_THROW(score_trajectory({}, straight(10.0)), std::runtime_error);
}

TEST(DownsampledTrajectory, KeepsTheFirstPoseAndOnePerStep) {
  const Trajectory selected = downsampled(straight(10.0), 0.45);
  ASSERT_EQ(selected.size(), 21U);  // every 0.5 m: the first pose after 0.45 m
  EXPECT_NEAR(selected[1].pose.x, 0.5, 1e-9);
  EXPECT_TRUE(downsampled(Trajectory{}, 0.5).empty());
}

/// Up a grade of 10 % along x.
Trajectory climbing(double length_m) {
  Trajectory trajectory = straight(length_m);
  for (TimedPose& at : trajectory) at.z_m = 0.1 * at.pose.x;
  return trajectory;
}

TEST(TrajectoryScore, MeasuresTheErrorAlongEachAxis) {
  const Trajectory truth = climbing(20.0);
  Trajectory found = moved({5.0, 0.0, 0.0}, truth);
  for (TimedPose& at : found) {
    at.z_m = 3.0 + 0.5 * at.z_m;                // from another height; 5 % of the distance too low
    at.pose.y += at.pose.x > 15.0 ? 0.2 : 0.0;  // for the second half
  }
  const TrajectoryScore score = score_trajectory(found, truth);
  EXPECT_TRUE(score.heights);
  EXPECT_NEAR(score.anchored.x.rmse_m, 0.0, 1e-9);
  EXPECT_NEAR(score.anchored.y.rmse_m, 0.2 * std::sqrt(0.5), 1e-3);  // 201 poses
  EXPECT_NEAR(score.anchored.y.max_m, 0.2, 1e-9);
  EXPECT_NEAR(score.anchored.rmse_m, score.anchored.y.rmse_m, 1e-9);
  // The error is 0 to 1 m, evenly.
  EXPECT_NEAR(score.anchored.z.rmse_m, std::sqrt(1.0 / 3.0), 3e-3);  // 201 poses
  EXPECT_NEAR(score.anchored.z.max_m, 1.0, 1e-9);
  EXPECT_NEAR(score.aligned.z.rmse_m, std::sqrt(1.0 / 12.0), 3e-3);
}

TEST(TrajectoryScore, SaysWhetherThereAreHeights) {
  EXPECT_FALSE(score_trajectory(straight(5.0), climbing(5.0)).heights);
}

}  // namespace
}  // namespace adit
