// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/frame/laser_alignment.hpp"

#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "common/geometry/motion3.hpp"

namespace adit {
namespace {

constexpr double kTiltSdRad = 0.001;
constexpr double kYawSdRad = 0.002;

/// Matches of scans that both lasers take by turns at headings of any kind, whose level frames have
/// the errors of their lasers; simulated by rotation matrices.
std::vector<ScanRotation> matches_of(const Eigen::Vector3d& e_front, const Eigen::Vector3d& e_rear,
                                     int scans, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> heading(-3.0, 3.0);
  const auto rotation = [](const Eigen::Vector3d& vector) -> Eigen::Matrix3d {
    Vector6d motion = Vector6d::Zero();
    motion.tail<3>() = vector;
    return isometry_of(motion).linear();
  };
  std::vector<double> headings;
  for (int i = 0; i < scans; ++i) headings.push_back(heading(random));
  std::vector<ScanRotation> matches;
  for (int i = 0; i < scans; ++i) {
    for (int k = 0; k < i; ++k) {
      ScanRotation match{
          k + 1, i + 1, k % 2 == 0, i % 2 == 0,
          headings[static_cast<std::size_t>(i)] - headings[static_cast<std::size_t>(k)]};
      // Points that the newer scan states, in the frame that the older one states: out of the
      // newer stated frame into the true one, by the turn, into the older stated frame.
      const Eigen::Matrix3d R_turn =
          Eigen::AngleAxisd(match.turn_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      const Eigen::Matrix3d R_older_newer =
          rotation(match.older_is_front ? e_front : e_rear) * R_turn *
          rotation(match.newer_is_front ? e_front : e_rear).transpose();
      const Eigen::AngleAxisd remaining(R_turn.transpose() * R_older_newer);
      match.remaining_rad = remaining.angle() * remaining.axis();
      match.remaining_rad += Eigen::Vector3d(
          kTiltSdRad * normal(random), kTiltSdRad * normal(random), kYawSdRad * normal(random));
      match.tilt_covariance = kTiltSdRad * kTiltSdRad * Eigen::Matrix2d::Identity();
      matches.push_back(match);
    }
  }
  return matches;
}

TEST(LaserAlignment, FindsTheRotationOfOneLaserAgainstTheOther) {
  const Eigen::Vector3d e_front(0.004, -0.009, -0.0087);
  const Eigen::Vector3d e_rear(0.001, -0.002, 0.002);
  const auto alignment = laser_alignment(matches_of(e_front, e_rear, 16, 1));
  ASSERT_TRUE(alignment);
  EXPECT_EQ(alignment->matches, 64U);
  const Eigen::Vector3d error = alignment->rotation_rad - (e_rear - e_front);
  EXPECT_LT(error.norm(), 0.001) << alignment->rotation_rad.transpose();
  for (int axis : {1, 2}) EXPECT_TRUE(alignment->is_off(axis)) << axis;
}

TEST(LaserAlignment, DoesNotTakeWhatBothHaveInCommonForAMount) {
  const Eigen::Vector3d common(0.006, -0.004, 0.01);
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const auto alignment = laser_alignment(matches_of(common, common, 8, seed));
    ASSERT_TRUE(alignment);
    for (int axis : {0, 1, 2}) EXPECT_FALSE(alignment->is_off(axis)) << seed << ", " << axis;
  }
}

TEST(LaserAlignment, StatesItsUncertainty) {
  const Eigen::Vector3d e_front(0.004, -0.003, 0.005);
  int within = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const auto alignment = laser_alignment(matches_of(e_front, Eigen::Vector3d::Zero(), 8, seed));
    ASSERT_TRUE(alignment);
    const Eigen::Vector3d error = alignment->rotation_rad + e_front;
    for (int axis : {0, 1, 2}) within += std::abs(error[axis]) < 1.96 * alignment->sd_rad[axis];
  }
  EXPECT_GT(within, 255);  // 85 of 100; 95 with many scans
}

TEST(LaserAlignment, IgnoresWrongMatches) {
  const Eigen::Vector3d e_front(0.0, 0.0, -0.0087);
  auto matches = matches_of(e_front, Eigen::Vector3d::Zero(), 12, 3);
  for (std::size_t i = 0; i < matches.size(); i += 8) matches[i].remaining_rad.array() += 0.2;
  const auto alignment = laser_alignment(matches);
  ASSERT_TRUE(alignment);
  EXPECT_NEAR(alignment->rotation_rad.z(), 0.0087, 0.002);
}

TEST(LaserAlignment, NeedsScansOfBothLasersOfOnePlace) {
  auto matches = matches_of({0.0, 0.0, 0.01}, Eigen::Vector3d::Zero(), 12, 3);
  for (ScanRotation& match : matches) match.older_is_front = match.newer_is_front = true;
  EXPECT_FALSE(laser_alignment(matches));
}

}  // namespace
}  // namespace adit
