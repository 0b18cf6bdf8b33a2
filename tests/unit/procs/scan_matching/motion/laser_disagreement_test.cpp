// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/motion/laser_disagreement.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kPeriodS = 0.0133;  // two lasers of 37.5 Hz take turns
constexpr double kMatchSd = 0.003;
constexpr double kWheelsSd = 0.005;  // of such a step

/// A body at rest by its wheels. Each laser finds it displaced from the pose before by a constant,
/// as where walls lean.
struct Drift {
  LaserDisagreement disagreement{LaserDisagreementParams{}};
  double plain_m = 0.0;  ///< position by match and wheels alone
  double fused_m = 0.0;  ///< position with the disagreement

  Drift(double front_m, double rear_m, int scans, bool has_rear = true) {
    const double share = kWheelsSd * kWheelsSd / (kWheelsSd * kWheelsSd + kMatchSd * kMatchSd);
    MotionEstimate expected;
    expected.from_odometry = true;
    expected.prior.information.diagonal().setConstant(1.0 / (kWheelsSd * kWheelsSd));
    for (int i = 0; i < scans; ++i) {
      const LaserId laser = i % 2 == 0 || !has_rear ? LaserId::kFront : LaserId::kRear;
      const double found_m = share * (laser == LaserId::kFront ? front_m : rear_m);
      plain_m += found_m;
      expected.prior.T_odom_body = {fused_m, 0.0, 0.0};
      Eigen::Matrix3d information = Eigen::Matrix3d::Identity() / (kMatchSd * kMatchSd);
      fused_m = disagreement
                    .fuse(laser, static_cast<std::int64_t>(1e6 * kPeriodS * i), expected,
                          {fused_m + found_m, 0.0, 0.0}, information)
                    .x;
    }
  }
};

TEST(LaserDisagreement, LasersThatContradictEachOtherLeaveThePoseToTheWheels) {
  const Drift drift(0.015, -0.005, 300);  // 4 s
  EXPECT_GT(drift.plain_m, 1.0);
  EXPECT_LT(drift.fused_m, 0.1 * drift.plain_m);
}

TEST(LaserDisagreement, WhatBothLasersFindIsAnErrorOfTheWheels) {
  const Drift spinning_wheels(-0.006, -0.006, 300);
  EXPECT_NEAR(spinning_wheels.fused_m, spinning_wheels.plain_m,
              0.02 * std::abs(spinning_wheels.plain_m));  // until both have been averaged
}

TEST(LaserDisagreement, OneLaserHasNoWitness) {
  const Drift drift(0.015, 0.0, 300, false);
  EXPECT_EQ(drift.fused_m, drift.plain_m);
}

/// The front laser measures that the wheels spin. The rear one sees smooth walls only: its pose is
/// the prediction.
TEST(LaserDisagreement, ALaserWithoutInformationAlongAnAxisIsNoWitness) {
  constexpr double kSpinM = -0.006;
  LaserDisagreement disagreement{LaserDisagreementParams{}};
  MotionEstimate expected;
  expected.from_odometry = true;
  expected.prior.information.diagonal().setConstant(1.0 / (kWheelsSd * kWheelsSd));
  for (int i = 0; i < 300; ++i) {
    const auto utime = static_cast<std::int64_t>(1e6 * kPeriodS * i);
    const bool is_front = i % 2 == 0;
    const Pose2 T_odom_match{is_front ? kSpinM : 0.0, 0.0, 0.0};
    Eigen::Matrix3d information = Eigen::Matrix3d::Identity() / (kMatchSd * kMatchSd);
    if (!is_front) information(0, 0) = 0.0;
    const Pose2 fused = disagreement.fuse(is_front ? LaserId::kFront : LaserId::kRear, utime,
                                          expected, T_odom_match, information);
    if (i < 150) continue;  // until both have been averaged
    EXPECT_NEAR(fused.x, T_odom_match.x, 0.1 * std::abs(kSpinM));
  }
  EXPECT_NEAR(disagreement.error_m(4'000'000).norm(), 0.0, 0.05 * std::abs(kSpinM));
}

TEST(LaserDisagreement, InformationLosesTheSystematicError) {
  Drift drift(0.01, -0.01, 300);
  MotionEstimate expected;
  expected.from_odometry = true;
  expected.prior.information.diagonal().setConstant(1.0);
  Eigen::Matrix3d information = 1e5 * Eigen::Matrix3d::Identity();
  const auto utime = static_cast<std::int64_t>(1e6 * kPeriodS * 300);
  drift.disagreement.fuse(LaserId::kFront, utime, expected, {}, information);
  EXPECT_GT(information(0, 0), 0.0);
  EXPECT_LT(information(0, 0), 1e4);          // more than 0.01 m along the body,
  EXPECT_NEAR(information(1, 1), 1e5, 1e-6);  // nothing across it
  EXPECT_NEAR(information(2, 2), 1e5, 1e-6);
}

}  // namespace
}  // namespace adit
