// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/sensor_clocks.hpp"

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::int64_t kMs = 1'000;
constexpr std::int64_t kSecond = 1'000'000;
constexpr std::int64_t kStart = 1'000'000 * kSecond;
constexpr std::int64_t kPeriodUs = 20 * kMs;

/// Two channels of 50 Hz whose clocks can be set.
class MonitoredClocks : public testing::TestWithParam<std::int64_t> {
 protected:
  void run(double duration_s, std::int64_t laser_offset_us, std::int64_t imu_offset_us) {
    laser_accepted_ = imu_accepted_ = 0;
    const std::int64_t end = now_ + static_cast<std::int64_t>(1e6 * duration_s);
    for (; now_ < end; now_ += kPeriodUs) {
      laser_accepted_ += accepts("LASER_FRONT", now_ + laser_offset_us);
      imu_accepted_ += accepts("IMU", now_ + imu_offset_us);
    }
  }
  int accepts(const std::string& channel, std::int64_t utime) {
    return clocks_.check(channel, utime, now_).empty() ? 1 : 0;
  }

  std::int64_t now_ = kStart;
  int laser_accepted_ = 0;
  int imu_accepted_ = 0;
  int set_ = 0;
  SensorClocks clocks_{[this] { ++set_; }};
};

TEST_P(MonitoredClocks, RejectASingleStampThatIsOff) {
  run(1.0, 0, 0);
  EXPECT_EQ(accepts("LASER_FRONT", now_ + GetParam()), 0);
  now_ += kPeriodUs;
  run(1.0, 0, 0);
  EXPECT_EQ(laser_accepted_, 50);
  EXPECT_EQ(imu_accepted_, 50);
  EXPECT_TRUE(clocks_.fault(now_).empty());
  EXPECT_EQ(set_, 0);
}

TEST_P(MonitoredClocks, RejectOneClockThatIsOffUntilItIsRight) {
  run(1.0, 0, 0);
  run(20.0, GetParam(), 0);
  EXPECT_EQ(laser_accepted_, 0);
  EXPECT_EQ(imu_accepted_, 1000);
  EXPECT_NE(clocks_.fault(now_).find("the clock of LASER_FRONT is "), std::string::npos);
  EXPECT_NE(clocks_.fault(now_).find(GetParam() > 0 ? "ahead" : "behind"), std::string::npos);
  run(1.0, 0, 0);
  EXPECT_EQ(laser_accepted_, 50);
  EXPECT_TRUE(clocks_.fault(now_).empty());
  EXPECT_EQ(set_, 0);
}

TEST_P(MonitoredClocks, FollowAClockThatAllChannelsHave) {
  run(1.0, 0, 0);
  run(5.0, GetParam(), GetParam());
  EXPECT_EQ(set_, 1);
  EXPECT_GE(laser_accepted_, 100);  // all but 2 s and what shows that it lasts
  EXPECT_GE(imu_accepted_, 100);
  run(5.0, 0, 0);
  EXPECT_EQ(set_, 2);
  EXPECT_GE(laser_accepted_, 100);
  EXPECT_TRUE(clocks_.fault(now_).empty());
}

INSTANTIATE_TEST_SUITE_P(Steps, MonitoredClocks,
                         testing::Values(3600 * kSecond, -3600 * kSecond, 10 * kSecond,
                                         -10 * kSecond, 3 * kSecond, -3 * kSecond));

TEST_F(MonitoredClocks, FollowASmallStep) {
  run(1.0, 0, 0);
  run(1.0, 300 * kMs, 0);  // ahead: accepted at once
  EXPECT_EQ(laser_accepted_, 50);
  run(1.0, 0, 0);  // behind: when it has caught up
  EXPECT_GE(laser_accepted_, 34);
  EXPECT_EQ(set_, 0);
}

TEST_F(MonitoredClocks, AcceptADriftOfTheClock) {
  run(1.0, 0, 0);
  for (int s = 0; s < 100; ++s) {
    run(1.0, s * 500, 0);  // 500 ppm
    EXPECT_GE(laser_accepted_, 50);
  }
  EXPECT_EQ(set_, 0);
}

TEST_F(MonitoredClocks, AcceptWhatArrivesLate) {
  run(1.0, 0, 0);
  const std::int64_t stall_begin = now_;
  now_ += 30 * kSecond;
  for (std::int64_t t = stall_begin; t < stall_begin + 3 * kSecond; t += kPeriodUs) {
    EXPECT_EQ(accepts("LASER_FRONT", t), 1);  // what the queue kept
  }
  EXPECT_EQ(accepts("LASER_FRONT", now_), 1);
}

TEST_F(MonitoredClocks, AcceptALogAtAnySpeed) {
  for (const double speed : {0.2, 1.0, 4.0, 50.0}) {
    SensorClocks clocks;
    for (int i = 0; i < 1000; ++i) {
      const auto arrival = kStart + static_cast<std::int64_t>(i * kPeriodUs / speed);
      EXPECT_TRUE(clocks.check("LASER_FRONT", i * kPeriodUs, arrival).empty());
    }
  }
}

TEST_F(MonitoredClocks, AcceptSparseMeasurements) {
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(accepts("GAS", now_), 1);
    now_ += 20 * kSecond;
  }
}

}  // namespace
}  // namespace adit
