// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The small parts: times, silence, limits, the latch, the way back.
#include <cmath>

#include <gtest/gtest.h>

#include "procs/guard/input_staleness.hpp"
#include "procs/guard/limit_checks.hpp"
#include "procs/guard/stop_release.hpp"

namespace adit {
namespace {

constexpr std::int64_t kSecond = 1'000'000;

TEST(MonotonicTime, LeavesOutStepsBack) {
  MonotonicTime time;
  EXPECT_EQ(time.advance_to(100 * kSecond), 0);
  EXPECT_EQ(time.advance_to(101 * kSecond), kSecond);
  EXPECT_EQ(time.advance_to(50 * kSecond), kSecond);
  EXPECT_EQ(time.advance_to(51 * kSecond), 2 * kSecond);
  EXPECT_EQ(time.monotonic_us(51 * kSecond - 10), 2 * kSecond - 10);
  EXPECT_EQ(time.monotonic_us(80 * kSecond), 2 * kSecond);  // yet to come
}

TEST(LastReceived, IsStaleFromItsTimeOutOn) {
  LastReceived pose;
  EXPECT_EQ(pose.staleness("pose", 0, 0.25), "no pose yet");
  EXPECT_EQ(pose.staleness_if_received("pose", 0, 0.25), std::nullopt);
  EXPECT_TRUE(pose.receive(kSecond));
  EXPECT_FALSE(pose.receive(kSecond - 1));
  EXPECT_EQ(pose.staleness("pose", kSecond + 250'000, 0.25), std::nullopt);
  EXPECT_EQ(pose.staleness("pose", kSecond + 310'000, 0.25), "pose silent for 0.31 s");
  EXPECT_EQ(pose.staleness_if_received("pose", 2 * kSecond, 0.25), "pose silent for 1.00 s");
}

TEST(AirReason, HoldsBeyondTheLimitsOfTheMines) {
  const AirParams limits;
  EXPECT_EQ(air_reason({}, limits), std::nullopt);
  EXPECT_EQ(air_reason({0, 0.0099, 0.195, 50e-6}, limits), std::nullopt);
  EXPECT_EQ(air_reason({0, 0.0125, 0.1, 1e-3}, limits), "methane 1.25 %, limit 1.00 %");
  EXPECT_EQ(air_reason({0, 0.0, 0.18, 1e-3}, limits), "oxygen 18.00 %, limit 19.50 %");
  EXPECT_EQ(air_reason({0, 0.0, 0.2, 1e-3}, limits), "carbon monoxide 1000 ppm, limit 50 ppm");
}

TEST(SinkageReason, NamesTheDeepestWheel) {
  EXPECT_EQ(sinkage_reason({0, {0.1, 0.15, 0.0, 0.0}}, 0.15), std::nullopt);
  EXPECT_EQ(sinkage_reason({0, {0.1, 0.0, 0.17, 0.16}}, 0.15),
            "rear left wheel sunk in by 0.17 m, limit 0.15 m");
}

TEST(TiltReason, HoldsForRollAndForPitchToEitherSide) {
  const auto leaning = [](double x, double y) {
    return Eigen::Vector3d(x, y, std::sqrt(1.0 - x * x - y * y));
  };
  EXPECT_EQ(tilt_reason(leaning(0.38, 0.0), 0.4), std::nullopt);
  EXPECT_EQ(tilt_reason(leaning(std::sin(0.42), 0.0), 0.4), "pitch of 0.42 rad, limit 0.40 rad");
  EXPECT_EQ(tilt_reason(leaning(-std::sin(0.42), 0.0), 0.4), "pitch of -0.42 rad, limit 0.40 rad");
  EXPECT_EQ(tilt_reason(leaning(0.0, std::sin(0.42)), 0.4), "roll of 0.42 rad, limit 0.40 rad");
  EXPECT_EQ(tilt_reason(leaning(0.0, -std::sin(0.42)), 0.4), "roll of -0.42 rad, limit 0.40 rad");
}

TEST(StopLatch, HoldsUntilTheReasonIsGoneForAWhileAndACommandIsNewer) {
  StopLatch latch(0.5);
  EXPECT_TRUE(latch.evaluate(false, std::nullopt, 0));
  EXPECT_TRUE(latch.evaluate(false, 0, kSecond));  // the command is not newer
  EXPECT_FALSE(latch.evaluate(false, 1, kSecond));
  EXPECT_TRUE(latch.evaluate(true, kSecond, 2 * kSecond));
  EXPECT_TRUE(latch.evaluate(false, 2 * kSecond + 1, 2 * kSecond + 499'999));
  EXPECT_TRUE(latch.evaluate(false, 2 * kSecond, 3 * kSecond));
  EXPECT_FALSE(latch.evaluate(false, 2 * kSecond + 1, 3 * kSecond));
}

TEST(StopLatch, BeginsResetWithEachReason) {
  StopLatch latch(0.5);
  for (int i = 0; i < 20; ++i) {  // a reason that comes and goes
    EXPECT_TRUE(latch.evaluate(i % 2 == 0, i * 300'000, i * 300'000));
  }
}

TEST(RetreatPermission, ForbidsToGoOnAndNotToLeave) {
  RetreatPermission retreat;
  EXPECT_FALSE(retreat.forbids(false, 1, 0));
  EXPECT_TRUE(retreat.forbids(true, 1, kSecond));
  EXPECT_TRUE(retreat.forbids(true, 0, 2 * kSecond));
  EXPECT_FALSE(retreat.forbids(true, -1, 3 * kSecond));
  EXPECT_TRUE(retreat.forbids(true, 1, 4 * kSecond));
}

TEST(RetreatPermission, IsTheSameWhileTheReasonWavers) {
  RetreatPermission retreat;
  retreat.forbids(false, 1, 0);
  retreat.forbids(true, 1, kSecond);
  for (int i = 2; i < 100; ++i) EXPECT_FALSE(retreat.forbids(i % 9 == 0, -1, i * kSecond));
}

TEST(RetreatPermission, IsAnotherForAnotherReason) {
  RetreatPermission retreat;
  retreat.forbids(false, 1, 0);
  retreat.forbids(true, 1, kSecond);
  retreat.forbids(false, -1, 2 * kSecond);
  retreat.forbids(false, -1, 30 * kSecond);
  EXPECT_TRUE(retreat.forbids(true, -1, 31 * kSecond));
  EXPECT_FALSE(retreat.forbids(true, 1, 32 * kSecond));
}

TEST(RetreatPermission, IsNotKnownToWhoNeverDrove) {
  RetreatPermission retreat;
  EXPECT_TRUE(retreat.forbids(true, 1, 0));
  EXPECT_TRUE(retreat.forbids(true, -1, kSecond));
}

}  // namespace
}  // namespace adit
