// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/sensor_clocks.hpp"

#include <algorithm>
#include <cstdint>
#include <random>
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

TEST_P(MonitoredClocks, RejectTheFirstStampOfAChannelThatIsOff) {
  for (int i = 0; i < 10; ++i, now_ += kPeriodUs) EXPECT_EQ(accepts("IMU", now_), 1);
  EXPECT_EQ(accepts("LASER_FRONT", now_ + GetParam()), 0);
  now_ += kPeriodUs;
  run(1.0, 0, 0);
  EXPECT_EQ(laser_accepted_, 50);
  EXPECT_EQ(imu_accepted_, 50);
  EXPECT_EQ(set_, 0);
}

TEST_P(MonitoredClocks, RecoverFromAVeryFirstStampThatIsOff) {
  EXPECT_EQ(accepts("LASER_FRONT", now_ + GetParam()), 1);
  now_ += kPeriodUs;
  run(1.2, 0, 0);
  run(1.0, 0, 0);
  EXPECT_EQ(laser_accepted_, 50);
  EXPECT_EQ(imu_accepted_, 50);
  EXPECT_TRUE(clocks_.fault(now_).empty());
}

/// The other channel is accepted as soon as the wrong stamp is old, before this one is again.
TEST_P(MonitoredClocks, RecoverAChannelOfWhichTheFirstStampWasOff) {
  EXPECT_EQ(accepts("IMU", now_ + GetParam()), 1);
  now_ += kPeriodUs;
  run(4.0, 0, 0);
  run(1.0, 0, 0);
  EXPECT_EQ(laser_accepted_, 50);
  EXPECT_EQ(imu_accepted_, 50);
  EXPECT_TRUE(clocks_.fault(now_).empty());
}

TEST_P(MonitoredClocks, ReportAClockThatIsOffFromTheBeginning) {
  for (int i = 0; i < 10; ++i, now_ += kPeriodUs) EXPECT_EQ(accepts("IMU", now_), 1);
  run(5.0, GetParam(), 0);
  EXPECT_EQ(laser_accepted_, 0);
  EXPECT_EQ(imu_accepted_, 250);
  EXPECT_NE(clocks_.fault(now_).find("the clock of LASER_FRONT is "), std::string::npos);
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
                                         -10 * kSecond, 3 * kSecond, -3 * kSecond, kSecond,
                                         -kSecond, 600 * kMs, -600 * kMs));

TEST_F(MonitoredClocks, RejectSingleStampsThatAreALittleAhead) {
  for (const std::int64_t ahead_us : {110 * kMs, 300 * kMs, 990 * kMs}) {
    run(1.0, 0, 0);
    for (int i = 0; i < 3; ++i, now_ += kPeriodUs) {
      EXPECT_EQ(accepts("LASER_FRONT", now_ + ahead_us), 0);
    }
    run(1.0, 0, 0);
    EXPECT_EQ(laser_accepted_, 50);
  }
}

/// Those behind the stamp are too old, so it must not be ahead by more than a few periods.
TEST_F(MonitoredClocks, LoseFewMeasurementsToAnyStamp) {
  for (std::int64_t ahead_us = 0; ahead_us < 3 * kSecond; ahead_us += 7 * kMs) {
    run(0.5, 0, 0);
    accepts("LASER_FRONT", now_ + ahead_us);
    now_ += kPeriodUs;
    run(0.5, 0, 0);
    EXPECT_GE(laser_accepted_, 20) << ahead_us;  // of 25; five periods
  }
}

TEST_F(MonitoredClocks, FollowASmallStep) {
  run(1.0, 0, 0);
  run(1.0, 300 * kMs, 0);  // ahead: when it lasts
  EXPECT_EQ(laser_accepted_, 45);
  EXPECT_EQ(clocks_.fault(now_), "the clock of LASER_FRONT is 0.3 s ahead of the others");
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

/// As a process that receives measurements before the time of the bus: it has none, or an old one.
TEST_F(MonitoredClocks, LearnTheOffsetAfterAWrongStart) {
  for (const std::int64_t bus_time : {std::int64_t{0}, now_ - 3 * kSecond, now_ - 600 * kMs}) {
    clocks_ = SensorClocks();
    EXPECT_TRUE(clocks_.check("POSE", now_, bus_time).empty());
    for (int i = 0; i < 100; ++i) {
      now_ += kPeriodUs;
      EXPECT_TRUE(clocks_.check("POSE", now_ - 5 * kMs, now_).empty());
      EXPECT_TRUE(clocks_.check("LASER_FRONT", now_ - 5 * kMs, now_).empty()) << i;
    }
    // The sender is suspended: what it was about to send arrives late, then all is as before.
    for (int i = 0; i < 500; ++i) {
      now_ += kPeriodUs;
      EXPECT_TRUE(clocks_.check("LASER_FRONT", now_ - 5 * kMs, now_).empty());
    }
    EXPECT_TRUE(clocks_.check("POSE", now_ - 10 * kSecond, now_).empty());
    for (int i = 0; i < 50; ++i) {
      now_ += kPeriodUs;
      EXPECT_TRUE(clocks_.check("POSE", now_ - 5 * kMs, now_).empty()) << bus_time;
      EXPECT_TRUE(clocks_.check("LASER_FRONT", now_ - 5 * kMs, now_).empty());
    }
    EXPECT_TRUE(clocks_.fault(now_).empty());
  }
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

/// With gaps of half a second in one of two channels.
TEST_F(MonitoredClocks, AcceptALogWithGapsAtAnySpeed) {
  for (const double speed : {0.2, 1.0, 4.0, 50.0}) {
    SensorClocks clocks;
    for (int i = 0; i < 1000; ++i) {
      const auto arrival = kStart + static_cast<std::int64_t>(i * kPeriodUs / speed);
      EXPECT_TRUE(clocks.check("IMU", i * kPeriodUs, arrival).empty());
      if (i % 100 >= 75) continue;
      EXPECT_TRUE(clocks.check("LASER_FRONT", i * kPeriodUs, arrival).empty()) << speed << " " << i;
    }
  }
}

/// A jitter of the arrival of up to 0.3 s, and a tenth of the messages lost.
TEST_F(MonitoredClocks, AcceptALatencyThatVaries) {
  std::mt19937 random(1);
  std::int64_t last_arrival = 0;
  for (int i = 0; i < 10'000; ++i) {
    const std::int64_t utime = kStart + i * kPeriodUs;
    const auto latency = std::uniform_int_distribution<std::int64_t>(0, 300 * kMs)(random);
    last_arrival = std::max(last_arrival, utime + latency);
    if (random() % 10 == 0) continue;
    EXPECT_TRUE(clocks_.check("LASER_FRONT", utime, last_arrival).empty()) << i;
  }
}

/// A driver may publish some measurements at once.
TEST_F(MonitoredClocks, AcceptBursts) {
  for (int i = 0; i < 1000; ++i, now_ += 3 * kPeriodUs) {
    for (int k = 0; k < 3; ++k) EXPECT_EQ(accepts("IMU", now_ + k * kPeriodUs), 1);
  }
}

TEST_F(MonitoredClocks, RejectAndReportAClockThatStandsStill) {
  run(1.0, 0, 0);
  const std::int64_t frozen = now_ - kPeriodUs;
  int accepted = 0;
  for (int i = 0; i < 500; ++i, now_ += kPeriodUs) {
    accepted += accepts("LASER_FRONT", frozen);
    EXPECT_EQ(accepts("IMU", now_), 1);
  }
  EXPECT_LT(accepted, 60);  // as repetitions, of which the stage decides
  EXPECT_EQ(clocks_.fault(now_), "the clock of LASER_FRONT stands still");
  run(1.0, 0, 0);
  EXPECT_EQ(laser_accepted_, 50);
  EXPECT_TRUE(clocks_.fault(now_).empty());
}

TEST_F(MonitoredClocks, AcceptSparseMeasurements) {
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(accepts("GAS", now_), 1);
    now_ += 20 * kSecond;
  }
}

}  // namespace
}  // namespace adit
