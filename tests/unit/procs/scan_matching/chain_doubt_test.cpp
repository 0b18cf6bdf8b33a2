// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/chain_doubt.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace adit {
namespace {

using Reason = MatchDoubt::Reason;

constexpr std::int64_t kSecond = 1'000'000;

PoseCandidate candidate(const Pose2& T_odom_body, double score) {
  PoseCandidate result;
  result.match.T_odom_body = T_odom_body;
  result.score = score;
  return result;
}

/// A motion of 4 s that no sensor measured, and of which all reachable poses were searched.
class ChainDoubtTest : public testing::Test {
 protected:
  ChainDoubtTest() {
    match_.status = ScanMatch::Status::kMatched;
    match_.reference_utime = 100 * kSecond;
    match_.utime = 104 * kSecond;
    expected_.unmeasured_s = 4.0;
    expected_.speed_known = true;
    found_.searched = true;
    found_.complete = true;
    found_.best = candidate({}, 0.9);
    found_.reachable = {found_.best};
  }

  void expect_doubt(Reason reason) {
    const auto doubt = doubt_.judge(match_, expected_, found_);
    ASSERT_TRUE(doubt);
    EXPECT_EQ(doubt->reason, reason);
    EXPECT_EQ(doubt->from_utime, match_.reference_utime);
    EXPECT_EQ(doubt->utime, match_.utime);
  }
  void expect_sure() { EXPECT_FALSE(doubt_.judge(match_, expected_, found_)); }

  ChainDoubt doubt_{ChainDoubtParams{}};
  ScanMatch match_;
  MotionEstimate expected_;
  PoseSearchResult found_;
};

TEST_F(ChainDoubtTest, IsSureOfOneGoodPose) { expect_sure(); }

TEST_F(ChainDoubtTest, GivesTheOtherPosesOfAnAmbiguousMatch) {
  const Pose2 turned{0.0, 0.0, std::numbers::pi};
  found_.reachable.push_back(candidate(turned, 0.88));
  found_.reachable.push_back(candidate({0.1, 0.0, 0.05}, 0.89));  // the same as the best
  found_.reachable.push_back(candidate({0.0, 1.0, 0.0}, 0.4));
  const auto doubt = doubt_.judge(match_, expected_, found_);
  ASSERT_TRUE(doubt);
  EXPECT_EQ(doubt->reason, Reason::kAmbiguous);
  ASSERT_EQ(doubt->alternatives.size(), 1U);
  EXPECT_EQ(doubt->alternatives[0], (MatchDoubt::Alternative{turned, 0.88}));
}

TEST_F(ChainDoubtTest, IgnoresPosesThatNoAccelerationReaches) {
  expected_.unmeasured_s = 1.0;
  found_.reachable.push_back(candidate({0.8, 0.0, 0.0}, 0.9));
  expect_sure();
  expected_.speed_known = false;
  expect_doubt(Reason::kAmbiguous);
  expected_.speed_known = true;
  expected_.unmeasured_s = 2.0;
  expect_doubt(Reason::kAmbiguous);
}

TEST_F(ChainDoubtTest, DoubtsAPoorMatch) {
  found_.best = candidate({}, 0.45);
  found_.reachable = {found_.best};
  expect_doubt(Reason::kPoor);
}

TEST_F(ChainDoubtTest, DoubtsAWeakMatchIfAnotherIsNear) {
  found_.best = candidate({}, 0.55);
  found_.reachable = {found_.best, candidate({2.0, 0.0, 0.0}, 0.1)};
  expect_sure();
  found_.reachable.push_back(candidate({2.0, 1.0, 0.0}, 0.3));
  expect_doubt(Reason::kPoor);
}

TEST_F(ChainDoubtTest, DoubtsALostScanOnlyBeyondTheSearchWindow) {
  match_.status = ScanMatch::Status::kLost;
  expect_doubt(Reason::kLost);
  found_.complete = false;
  expect_sure();
}

TEST_F(ChainDoubtTest, BeginsALostStretchAtTheLastScanThatWasLocated) {
  expect_sure();
  match_.status = ScanMatch::Status::kLost;
  match_.reference_utime = 110 * kSecond;
  match_.utime = 114 * kSecond;
  const auto doubt = doubt_.judge(match_, expected_, found_);
  ASSERT_TRUE(doubt);
  EXPECT_EQ(doubt->from_utime, 104 * kSecond);
}

TEST_F(ChainDoubtTest, TrustsMotionThatTheWheelsMeasured) {
  expected_.from_odometry = true;
  found_.complete = false;
  match_.status = ScanMatch::Status::kLost;
  expect_sure();
}

TEST_F(ChainDoubtTest, DoubtsAPoorMatchFarFromTheWheels) {
  expected_.from_odometry = true;
  found_.complete = false;
  found_.best.sigmas = 15.0;
  expect_sure();  // a good match: the wheels slip
  found_.best.score = 0.5;
  expect_doubt(Reason::kContradicted);
}

/// Scans each 0.1 s, then none for 5 s.
TEST_F(ChainDoubtTest, DoubtsAMatchAfterAGapInWhichTheBodyMoved) {
  const auto see = [this](double after_s, double moved_m) {
    match_.reference_utime = match_.utime;
    match_.utime += std::llround(after_s * kSecond);
    expected_.unmeasured_s = after_s;
    expected_.T_odom_last = match_.T_odom_body;
    match_.T_odom_body.x += moved_m;
    expected_.prior.T_odom_body = match_.T_odom_body;
  };
  for (int i = 0; i < 50; ++i) {
    see(0.1, 0.04);
    expect_sure();
  }
  see(5.0, 0.02);
  expect_sure();  // it stood
  see(0.1, 0.04);
  expect_sure();
  see(5.0, 2.0);
  expect_doubt(Reason::kLost);
  see(5.0, 2.0);
  expected_.from_odometry = true;
  expect_sure();
}

TEST_F(ChainDoubtTest, TakesSparseScansForUsual) {
  for (int i = 0; i < 20; ++i) {
    match_.reference_utime = match_.utime;
    match_.utime += 4 * kSecond;
    expected_.T_odom_last = match_.T_odom_body;
    match_.T_odom_body.x += 2.0;
    expected_.prior.T_odom_body = match_.T_odom_body;
    expect_sure();
  }
}

TEST_F(ChainDoubtTest, DoubtsAMetreOfUnobservedMotion) {
  match_.degenerate = {{Eigen::Vector3d::UnitX(), DegenerateDirection::Fill::kNone}};
  match_.T_reference_body = {0.7, 0.0, 0.0};
  expect_sure();
  const auto doubt = doubt_.judge(match_, expected_, found_);
  ASSERT_TRUE(doubt);
  EXPECT_EQ(doubt->reason, Reason::kDegenerate);
  match_.degenerate.clear();
  expect_sure();
}

}  // namespace
}  // namespace adit
