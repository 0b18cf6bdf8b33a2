// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/motion_steps.hpp"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kPeriodUs = 13'333;  // of POSE
constexpr std::int64_t kSecond = 1'000'000;

class MotionStepsOfPoses : public testing::Test {
 protected:
  /// Whether a pose at this place is accepted, one period after the one before.
  bool accepts(double x, std::int64_t after_us = kPeriodUs) {
    utime_ += after_us;
    return accepts(StreamPose{utime_, {x, 0.0, 0.0}, 0.0, frame_utime_});
  }
  bool accepts(const StreamPose& pose) { return steps_.check(pose, arrival_utime_).empty(); }

  bool accepts_at_arrival(double x, std::int64_t after_us) {
    arrival_utime_ += after_us;
    return accepts(x, after_us);
  }

  MotionSteps steps_;
  std::int64_t utime_ = kStart;
  std::int64_t arrival_utime_ = kStart;
  std::int64_t frame_utime_ = 0;
};

TEST_F(MotionStepsOfPoses, AcceptADriveAndSmallCorrections) {
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(accepts_at_arrival(0.03 * i, kPeriodUs));  // 2.2 m/s
  EXPECT_TRUE(accepts_at_arrival(3.4, kPeriodUs));  // the walls correct it by 0.4 m
}

TEST_F(MotionStepsOfPoses, RejectOneOutlierAndContinue) {
  EXPECT_TRUE(accepts_at_arrival(0.0, kPeriodUs));
  for (const double x : {1e5, -1e5, 50.0, 3.0}) {
    EXPECT_FALSE(accepts_at_arrival(x, kPeriodUs)) << x;
    EXPECT_TRUE(accepts_at_arrival(0.0, kPeriodUs)) << x;
  }
  EXPECT_FALSE(accepts(StreamPose{utime_ + 1, {0.0, 0.0, 3.0}, 0.0, 0}));
  EXPECT_FALSE(accepts(StreamPose{utime_ + 1, {0.0, 0.0, 0.0}, 50.0}));
  EXPECT_TRUE(accepts(StreamPose{utime_ + 1, {0.0, 0.0, 0.1 + 2.0 * M_PI}}));
}

TEST_F(MotionStepsOfPoses, FollowAStepThatLasts) {
  EXPECT_TRUE(accepts_at_arrival(0.0, kPeriodUs));
  EXPECT_FALSE(accepts_at_arrival(300.0, kPeriodUs));
  EXPECT_FALSE(accepts_at_arrival(300.0, kPeriodUs));
  EXPECT_TRUE(accepts_at_arrival(300.0, kPeriodUs));
  EXPECT_TRUE(accepts_at_arrival(300.1, kPeriodUs));
  EXPECT_FALSE(accepts_at_arrival(0.0, kPeriodUs));
}

/// Every second message is of another sender.
TEST_F(MotionStepsOfPoses, DoNotFollowOutliersBetweenTruePoses) {
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(accepts_at_arrival(0.01 * i, kPeriodUs));
    EXPECT_FALSE(accepts_at_arrival(300.0, kPeriodUs));
  }
}

TEST_F(MotionStepsOfPoses, AcceptADriveDuringAnOutage) {
  EXPECT_TRUE(accepts_at_arrival(0.0, kPeriodUs));
  EXPECT_TRUE(accepts_at_arrival(20.0, 20 * kSecond));
}

TEST_F(MotionStepsOfPoses, DoNotTrustAStampAlone) {
  EXPECT_TRUE(accepts(0.0));
  EXPECT_FALSE(accepts(5000.0, 3600 * kSecond));  // an hour later, but it arrives at once
}

/// Poses that waited arrive together.
TEST_F(MotionStepsOfPoses, AcceptWhatArrivesLate) {
  EXPECT_TRUE(accepts(0.0));
  for (int i = 1; i < 50; ++i) EXPECT_TRUE(accepts(0.5 * i, kSecond / 2)) << i;
}

TEST_F(MotionStepsOfPoses, FollowANewFrameAtOnce) {
  frame_utime_ = kStart;
  EXPECT_TRUE(accepts_at_arrival(300.0, kPeriodUs));
  frame_utime_ = utime_ + kPeriodUs;
  EXPECT_TRUE(accepts_at_arrival(0.0, kPeriodUs));
}

TEST_F(MotionStepsOfPoses, DoNotFollowAFrameThatBeganBefore) {
  frame_utime_ = kStart;
  EXPECT_TRUE(accepts_at_arrival(300.0, kPeriodUs));
  for (const std::int64_t frame_utime : {kStart - 1, kStart + 1, kStart + kSecond}) {
    frame_utime_ = frame_utime;
    EXPECT_FALSE(accepts_at_arrival(300.0, kPeriodUs)) << frame_utime;
    frame_utime_ = kStart;
    EXPECT_TRUE(accepts_at_arrival(300.0, kPeriodUs));
  }
}

TEST_F(MotionStepsOfPoses, DoNotFollowFarWithinAFrame) {
  frame_utime_ = kStart;
  EXPECT_TRUE(accepts_at_arrival(0.0, kPeriodUs));
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(accepts_at_arrival(5e4, kPeriodUs));
  EXPECT_TRUE(accepts_at_arrival(0.0, kPeriodUs));
  for (int i = 0; i < 2; ++i) EXPECT_FALSE(accepts_at_arrival(20.0, kPeriodUs));
  EXPECT_TRUE(accepts_at_arrival(20.0, kPeriodUs));
}

TEST(Subscription, RejectsAPoseThatNoVehicleReaches) {
  MemoryBus bus;
  double x = 0.0;
  const auto id = subscribe<pose_t>(bus, channels::kPose, Delivery::queued(9),
                                    [&x](const StampedPose& pose) { x = pose.T_odom_body.x; });
  bus.inject(kStart, channels::kPose, encode(to_message(StampedPose{kStart, {1.0, 0.0, 0.0}, {}})));
  bus.inject(kStart + 1, channels::kPose,
             encode(to_message(StampedPose{kStart + 1, {90'000.0, 0.0, 0.0}, {}})));
  EXPECT_EQ(x, 1.0);
  EXPECT_EQ(bus.stats(id).rejections.at(std::string(MotionSteps::kTooFar)), 1);
}

}  // namespace
}  // namespace adit
