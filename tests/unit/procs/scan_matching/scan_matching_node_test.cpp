// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/scan_matching_node.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/sensing.hpp"
#include "tests/support/worlds/wall_world.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'000'000'000;

class ScanMatchingNodeOnABus : public testing::Test {
 protected:
  ScanMatchingNodeOnABus() {
    subscribe<scan_match_t>(bus_, channels::kScanMatch, Delivery::queued(100),
                            [this](const ScanMatch& match) { matches_.push_back(match); });
    subscribe<pose_t>(bus_, channels::kPose, Delivery::queued(100),
                      [this](const StampedPose& pose) { poses_.push_back(pose); });
    subscribe<match_doubt_t>(bus_, channels::kMatchDoubt, Delivery::queued(100),
                             [this](const MatchDoubt& doubt) { doubts_.push_back(doubt); });
  }

  void scan(std::int64_t utime, const Pose2& T_world_body) {
    const LaserScan seen = laser_.measure(T_world_body, utime);
    bus_.inject(utime, channels::kLaserFront, encode(to_message(seen)));
  }
  void tilt(std::int64_t utime, double angle_rad, double rate_rad_s = 0.0) {
    const TiltReading reading{utime, angle_rad, rate_rad_s};
    bus_.inject(utime, channels::kTiltFront, encode(to_message(reading)));
  }

  test::LevelLaser laser_{test::crooked_room(), 1};
  MemoryBus bus_;
  ScanMatchingNode node_{bus_, ScanMatchingParams{}};
  std::vector<ScanMatch> matches_;
  std::vector<StampedPose> poses_;
  std::vector<MatchDoubt> doubts_;
};

TEST_F(ScanMatchingNodeOnABus, PublishesAPoseAndAMatchForEachScan) {
  scan(kStart, {-2.0, 0.0, 0.0});
  scan(kStart + 200'000, {-1.9, 0.0, 0.0});
  ASSERT_EQ(poses_.size(), 2U);
  ASSERT_EQ(matches_.size(), 2U);
  EXPECT_EQ(poses_[1].utime, kStart + 200'000);
  EXPECT_NEAR(poses_[1].T_odom_body.x, 0.1, 0.01);
  EXPECT_EQ(matches_[1].channel, channels::kLaserFront);
  EXPECT_EQ(matches_[1].reference_utime, kStart);
  EXPECT_EQ(node_.health().level, Health::Level::kOk);
}

TEST_F(ScanMatchingNodeOnABus, PublishesARejectedMatchWithoutAPose) {
  scan(kStart, {-2.0, 0.0, 0.0});
  scan(kStart, {-1.9, 0.0, 0.0});
  ASSERT_EQ(matches_.size(), 2U);
  EXPECT_EQ(matches_[1].status, ScanMatch::Status::kRejected);
  EXPECT_EQ(poses_.size(), 1U);
}

TEST_F(ScanMatchingNodeOnABus, IgnoresTiltedScans) {
  scan(kStart, {-2.0, 0.0, 0.0});
  tilt(kStart + 100'000, 0.4);
  scan(kStart + 200'000, {-1.9, 0.0, 0.0});
  EXPECT_EQ(matches_.size(), 1U);
  tilt(kStart + 300'000, 0.0);
  scan(kStart + 400'000, {-1.8, 0.0, 0.0});
  EXPECT_EQ(matches_.size(), 2U);
}

/// Between two scans 0.02 rad move the beams that meet a slope ahead by decimetres.
TEST_F(ScanMatchingNodeOnABus, IgnoresScansOfALaserThatStillTilts) {
  scan(kStart, {-2.0, 0.0, 0.0});
  tilt(kStart + 100'000, 0.02, -0.3);
  scan(kStart + 200'000, {-1.9, 0.0, 0.0});
  EXPECT_EQ(matches_.size(), 1U);
  tilt(kStart + 300'000, 0.001, -0.02);  // the noise of a servo that holds
  scan(kStart + 400'000, {-1.8, 0.0, 0.0});
  EXPECT_EQ(matches_.size(), 2U);
}

TEST_F(ScanMatchingNodeOnABus, IgnoresTiltedScansAlsoWhenItRunsLate) {
  bus_.subscribe("BUSY", Delivery::latest(), [this](const ReceivedMessage&) {
    tilt(kStart, 0.4);
    scan(kStart + 10'000, {-2.0, 0.0, 0.0});
    tilt(kStart + 20'000, 0.0);
    scan(kStart + 30'000, {-2.0, 0.0, 0.0});
    return std::string_view();
  });
  bus_.publish("BUSY", {});
  ASSERT_EQ(matches_.size(), 1U);
  EXPECT_EQ(matches_[0].utime, kStart + 30'000);
}

TEST_F(ScanMatchingNodeOnABus, PublishesADoubtIfAScanIsLostAfterAGap) {
  scan(kStart, {-2.0, 0.0, 0.0});
  scan(kStart + 200'000, {-1.9, 0.0, 0.0});
  EXPECT_TRUE(doubts_.empty());
  const LaserScan elsewhere{kStart + 5'000'000, std::vector<float>(181, 1.0F), -1.57, 0.01745};
  bus_.inject(elsewhere.utime, channels::kLaserFront, encode(to_message(elsewhere)));
  ASSERT_EQ(doubts_.size(), 1U);
  EXPECT_EQ(doubts_[0].utime, elsewhere.utime);
  EXPECT_EQ(doubts_[0].from_utime, kStart + 200'000);
}

TEST_F(ScanMatchingNodeOnABus, IgnoresAStampInTheFuture) {
  scan(kStart, {-2.0, 0.0, 0.0});
  const LaserScan seen = laser_.measure({-2.0, 0.0, 0.0}, kStart + 3'600'000'000);
  bus_.inject(kStart + 100'000, channels::kLaserFront, encode(to_message(seen)));
  scan(kStart + 200'000, {-1.9, 0.0, 0.0});
  ASSERT_EQ(poses_.size(), 2U);
  EXPECT_EQ(poses_[1].utime, kStart + 200'000);
  EXPECT_NEAR(poses_[1].T_odom_body.x, 0.1, 0.01);
}

TEST_F(ScanMatchingNodeOnABus, KeepsThePoseWhenTheClockOfAllSensorsIsSet) {
  scan(kStart, {-2.0, 0.0, 0.0});
  std::int64_t arrival = kStart;
  for (const std::int64_t offset_us : {-900'000'000LL, 3'600'000'000LL}) {
    poses_.clear();
    for (int i = 1; i <= 40; ++i) {
      arrival += 100'000;
      const LaserScan seen = laser_.measure({-1.9, 0.0, 0.0}, arrival + offset_us);
      bus_.inject(arrival, channels::kLaserFront, encode(to_message(seen)));
    }
    ASSERT_GE(poses_.size(), 15U);  // all but 1 s for one laser, 2 s for more sensors
    EXPECT_EQ(poses_.back().utime, arrival + offset_us);
    EXPECT_NEAR(poses_.back().T_odom_body.x, 0.1, 0.01);
    EXPECT_EQ(matches_.back().status, ScanMatch::Status::kMatched);
  }
}

TEST_F(ScanMatchingNodeOnABus, IsDegradedWhileScansAreLost) {
  scan(kStart, {-2.0, 0.0, 0.0});
  LaserScan blind{kStart + 200'000, std::vector<float>(181, 81.83F), -1.57, 0.01745};
  bus_.inject(blind.utime, channels::kLaserFront, encode(to_message(blind)));
  EXPECT_EQ(node_.health().level, Health::Level::kDegraded);
  scan(kStart + 400'000, {-2.0, 0.0, 0.0});
  EXPECT_EQ(node_.health().level, Health::Level::kOk);
}

}  // namespace
}  // namespace adit
