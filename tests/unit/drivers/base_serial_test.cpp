// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The driver against an emulated base, in simulated time.
#include "drivers/base_serial/base_serial.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/devices/base_emulator.hpp"
#include "tests/support/lasers/laser_line.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kSecond = 1'000'000;
constexpr std::int64_t kStateUs = 20'000;

TEST(BaseFrames, HaveTheCrcOfTheDescription) {
  const std::string text = "123456789";
  EXPECT_EQ(base_crc(std::vector<std::uint8_t>(text.begin(), text.end())), 0x29B1);
}

TEST(BaseDecoder, FindsFramesBehindGarbageAndDropsDamagedOnes) {
  const std::vector<std::uint8_t> payload{1, 0xA5, 0x5A, 2};  // the start of a frame within
  std::vector<std::uint8_t> stream{0xA5, 0x5A, 0x82, 200, 0xA5};
  const auto append = [&stream](const std::vector<std::uint8_t>& bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
  };
  append(encode_base_frame(7, 1, payload));
  auto damaged = encode_base_frame(7, 2, payload);
  damaged[5] ^= 0x10;
  append(damaged);
  append(encode_base_frame(9, 3, {}));
  BaseDecoder decoder;
  std::vector<BaseFrame> frames;
  for (const std::uint8_t byte : stream) {  // each in a read of its own
    decoder.add(std::vector<std::uint8_t>{byte}, 0, 0.0);
    while (const auto frame = decoder.next()) frames.push_back(*frame);
  }
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].payload, payload);
  EXPECT_EQ(frames[0].sequence, 1);
  EXPECT_EQ(frames[1].type, 9);
  EXPECT_GT(decoder.counts().corrupt, 0);
}

TEST(SideSpeeds, AreThoseOfTheArcAndKeepItsCurvatureAtTheLimit) {
  constexpr double kTrackM = 0.5;
  SideSpeeds speeds = side_speeds(0.4, 1.0, kTrackM, 1.0);
  EXPECT_DOUBLE_EQ(speeds.left_m_s, 0.3);
  EXPECT_DOUBLE_EQ(speeds.right_m_s, 0.5);
  speeds = side_speeds(-0.8, 2.0, kTrackM, 0.6);
  const double mean = 0.5 * (speeds.left_m_s + speeds.right_m_s);
  EXPECT_NEAR((speeds.right_m_s - speeds.left_m_s) / kTrackM / mean, 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(speeds.right_m_s, -0.6);
}

class BaseSerialTest : public testing::Test {
 protected:
  void build(const BaseSerialParams& params, const BaseEmulator::Params& base) {
    params_ = params;
    base_.emplace(base);
    device_.emplace(params);
    line_.emplace(*device_, *base_, kTickUs);
  }
  void build(const BaseEmulator::Params& base = {}) { build({}, base); }

  void run_for(double seconds) {
    line_->run_until(line_->now() + std::llround(1e6 * seconds),
                     [this](const BaseReading& reading, std::int64_t now) { check(reading, now); });
  }

  /// With a command each 50 ms, as from driving, and a stop order each 100 ms, as from the guard.
  void drive_for(double seconds, double speed_m_s, double curvature_1_m = 0.0) {
    for (int i = 0; i < std::lround(20.0 * seconds); ++i) {
      if (i % 2 == 0) order(false);
      command(speed_m_s, curvature_1_m);
      run_for(0.05);
    }
  }
  void command(double speed_m_s, double curvature_1_m = 0.0) {
    device_->obey(DriveCommand{line_->now(), speed_m_s, curvature_1_m}, line_->now(), line_->now());
  }
  void order(bool stopped) {
    device_->obey(StopOrder{line_->now(), stopped, stopped ? "test" : ""}, line_->now(),
                  line_->now());
  }

  void check(const BaseReading& reading, std::int64_t now) {
    if (last_ && reading.odometry.utime <= last_->odometry.utime) ++unordered_;
    last_ = reading;
    ++readings_;
    if (now < judge_from_) return;
    // Encoders are read at multiples of the period since it was switched on.
    const std::int64_t since_us = reading.odometry.utime - on_us_;
    const auto off_us =
        since_us - kStateUs * std::llround(static_cast<double>(since_us) / kStateUs);
    worst_stamp_ms_ = std::max(worst_stamp_ms_, 1e-3 * std::abs(static_cast<double>(off_us)));
    const auto ticks = base_->ticks_at(reading.odometry.utime - off_us);
    const double travelled_m = 0.5 * (ticks[0] + ticks[1]) / params_.ticks_per_m;
    worst_x_m_ = std::max(worst_x_m_, std::abs(reading.odometry.T_wheel_body.x - travelled_m));
  }

  void cold_start() {
    line_->start(100 * kSecond);
    run_for(1.0);
    on_us_ = line_->now();
    base_->power_on(on_us_);
    run_for(2.5);
    ASSERT_TRUE(device_->is_streaming()) << device_->problem();
  }

  static constexpr std::int64_t kTickUs = 50'000;
  static constexpr double kRecoveryS = 3.0;

  BaseSerialParams params_;
  std::optional<BaseEmulator> base_;
  std::optional<BaseSerial> device_;
  std::optional<LaserLine<BaseEmulator, BaseReading>> line_;
  std::optional<BaseReading> last_;
  int readings_ = 0;
  int unordered_ = 0;
  std::int64_t on_us_ = 0;
  std::int64_t judge_from_ = std::numeric_limits<std::int64_t>::max();
  double worst_stamp_ms_ = 0.0;
  double worst_x_m_ = 0.0;  ///< on a straight path
};

TEST_F(BaseSerialTest, StartsAColdBaseAndReportsWhatItsWheelsDo) {
  // Its clock is fast and overflows after 5 s, the left counter in the first metre.
  build({.clock_rate = 1.0005,
         .clock_start_us = std::numeric_limits<std::uint32_t>::max() - 5'000'000U,
         .ticks_start = std::numeric_limits<std::int32_t>::max() - 2000});
  cold_start();
  EXPECT_TRUE(last_->state.expired);
  EXPECT_FALSE(last_->state.stopped);
  judge_from_ = line_->now();
  const int before = readings_;
  drive_for(10.0, 0.4);
  EXPECT_NEAR(readings_ - before, 500, 2);
  EXPECT_EQ(unordered_, 0);
  EXPECT_LT(worst_stamp_ms_, 1.0);
  EXPECT_LT(worst_x_m_, 2.0 / params_.ticks_per_m);  // rounding of both counters
  EXPECT_GT(last_->odometry.T_wheel_body.x, 3.5);
  EXPECT_NEAR(last_->state.speed_m_s, 0.4, 0.005);  // two ticks in 80 ms
  EXPECT_FALSE(last_->state.expired);
  EXPECT_NEAR(last_->state.battery_share, (24.0 - 22.0) / 3.6, 1e-9);
  EXPECT_EQ(device_->problem(), "");
  EXPECT_TRUE(device_->clock().uncertainty_us());
}

TEST_F(BaseSerialTest, DrivesTheArcOfTheCommand) {
  build();
  base_->already_streams(99 * kSecond);
  line_->start(100 * kSecond);
  run_for(1.0);
  constexpr double kCurvature = 0.8;
  drive_for(20.0, 0.3, kCurvature);
  const Pose2& pose = last_->odometry.T_wheel_body;
  EXPECT_GT(pose.theta, 4.0);  // not wrapped
  // A circle, from standstill at the same curvature throughout; rounding of the ticks turns it.
  EXPECT_NEAR(pose.x, std::sin(pose.theta) / kCurvature, 0.01);
  EXPECT_NEAR(pose.y, (1.0 - std::cos(pose.theta)) / kCurvature, 0.01);
  EXPECT_NEAR(last_->state.curvature_1_m, kCurvature, 0.05);
  EXPECT_NEAR(last_->yaw_rate_rad_s, 0.3 * kCurvature, 0.01);
  drive_for(2.0, -0.3, kCurvature);
  EXPECT_LT(last_->state.speed_m_s, -0.29);
  EXPECT_NEAR(last_->state.curvature_1_m, kCurvature, 0.05);
}

TEST_F(BaseSerialTest, BrakesWhenCommandsEnd) {
  build();
  base_->already_streams(99 * kSecond);
  line_->start(100 * kSecond);
  run_for(1.0);
  drive_for(2.0, 0.5);
  run_for(0.15);  // 0.2 s behind the last command
  EXPECT_FALSE(last_->state.expired);
  EXPECT_EQ(base_->targets_ticks_s()[0], 2500);
  run_for(0.15);  // the expiry, and the next turn of the driver
  EXPECT_TRUE(last_->state.expired);
  EXPECT_EQ(base_->targets_ticks_s()[0], 0);
  run_for(0.55);  // 0.5 m/s at 1 m/s²
  EXPECT_EQ(base_->speeds_ticks_s()[0], 0.0);
  EXPECT_FALSE(base_->is_expired());  // the driver still tells it to stand
}

TEST_F(BaseSerialTest, StopsAtOnceAndUntilTheRelease) {
  build();
  base_->already_streams(99 * kSecond);
  line_->start(100 * kSecond);
  run_for(1.0);
  drive_for(2.0, 0.5);
  order(true);
  run_for(0.003);  // 24 bytes take 2 ms
  EXPECT_TRUE(base_->brakes());
  for (int i = 0; i < 20; ++i) {
    command(0.5);
    run_for(0.05);
    order(true);
  }
  EXPECT_EQ(base_->speeds_ticks_s()[0], 0.0);
  EXPECT_TRUE(last_->state.stopped);
  drive_for(1.0, 0.5);
  EXPECT_FALSE(last_->state.stopped);
  EXPECT_GT(base_->speeds_ticks_s()[0], 2000.0);
  for (int i = 0; i < 12; ++i) {  // nobody guards it any more
    command(0.5);
    run_for(0.05);
  }
  EXPECT_TRUE(last_->state.stopped);
}

TEST_F(BaseSerialTest, StandsWhileTheCableIsPulledAndContinues) {
  build();
  base_->already_streams(99 * kSecond);
  on_us_ = 99 * kSecond;
  line_->start(100 * kSecond);
  run_for(1.0);
  judge_from_ = line_->now();
  drive_for(2.0, 0.5);
  line_->faults.is_pulled = true;
  drive_for(0.8, 0.5);
  EXPECT_TRUE(base_->is_expired());
  EXPECT_EQ(base_->speeds_ticks_s()[0], 0.0);  // by its own watchdog
  drive_for(9.2, 0.5);
  EXPECT_FALSE(device_->is_streaming());
  EXPECT_THAT(device_->problem(), HasSubstr("no answer at any baud rate"));
  line_->faults.is_pulled = false;
  const int before = readings_;
  run_for(kRecoveryS);
  EXPECT_GT(readings_, before);
  drive_for(2.0, 0.5);
  EXPECT_LT(worst_x_m_, 2.0 / params_.ticks_per_m);  // what it rolled is not lost
  EXPECT_LT(worst_stamp_ms_, 2.0);                   // from the second second
  EXPECT_EQ(device_->problem(), "");
}

TEST_F(BaseSerialTest, ContinuesItsOdometryWhenTheBaseWasSwitchedOff) {
  build();
  base_->already_streams(99 * kSecond);
  line_->start(100 * kSecond);
  run_for(1.0);
  drive_for(4.0, 0.4);
  run_for(1.0);
  const double x_m = last_->odometry.T_wheel_body.x;
  EXPECT_GT(x_m, 1.0);
  for (const double off_s : {2.0, 0.1}) {  // also so short that nothing times out
    base_->power_off();
    run_for(off_s);
    on_us_ = line_->now();
    base_->power_on(on_us_);
    run_for(kRecoveryS);
    ASSERT_TRUE(device_->is_streaming()) << device_->problem();
    EXPECT_NEAR(last_->odometry.T_wheel_body.x, x_m, 1e-9);
  }
  drive_for(2.0, 0.4);
  EXPECT_GT(last_->odometry.T_wheel_body.x, x_m + 0.5);
  EXPECT_EQ(unordered_, 0);
}

TEST_F(BaseSerialTest, IsNotMovedByDamagedFrames) {
  build();
  base_->already_streams(99 * kSecond);
  on_us_ = 99 * kSecond;
  line_->start(100 * kSecond);
  run_for(1.0);
  judge_from_ = line_->now();
  line_->faults.corrupt_share = 0.01;
  line_->faults.to_device_share = 0.01;
  const int before = readings_;
  drive_for(60.0, 0.3);
  EXPECT_GT(readings_ - before, 0.7 * 3000);  // 25 bytes each
  EXPECT_LT(worst_x_m_, 2.0 / params_.ticks_per_m);
  EXPECT_LT(worst_stamp_ms_, 2.0);
  EXPECT_EQ(unordered_, 0);
  EXPECT_NEAR(base_->speeds_ticks_s()[0], 1500.0, 1.0);
  EXPECT_EQ(base_->targets_ticks_s()[1], 1500);
  EXPECT_GT(device_->line_counts().corrupt, 300);
  EXPECT_THAT(device_->problem(), HasSubstr("of the frames to the base are damaged"));
  line_->faults = {};
  drive_for(21.0, 0.3);
  EXPECT_EQ(device_->problem(), "");
}

TEST_F(BaseSerialTest, StampsStatesWhenItIsScheduledLate) {
  build();
  base_->already_streams(99 * kSecond);
  on_us_ = 99 * kSecond;
  line_->start(100 * kSecond);
  run_for(5.0);
  judge_from_ = line_->now();
  line_->faults.late_share = 0.0005;  // once in a second
  line_->faults.late_us = 47'000;
  drive_for(20.0, 0.2);
  EXPECT_LT(worst_stamp_ms_, 2.0);
}

TEST_F(BaseSerialTest, FindsTheBaudRate) {
  for (const int baud : {57600, 230400, 38400}) {
    build({.baud = baud});
    base_->already_streams(99 * kSecond);
    line_->start(100 * kSecond);
    run_for(kRecoveryS);
    EXPECT_TRUE(device_->is_streaming()) << baud << ": " << device_->problem();
  }
}

TEST_F(BaseSerialTest, DoesNotDriveABaseOfAnotherVersion) {
  build({.version = 2});
  line_->start(100 * kSecond);
  base_->power_on(line_->now());
  run_for(1.0);
  drive_for(2.0, 0.5);
  EXPECT_EQ(readings_, 0);
  EXPECT_EQ(base_->drives(), 0);
  EXPECT_EQ(device_->problem(), "the base speaks version 2 of the protocol, this driver version 1");
}

TEST_F(BaseSerialTest, ReportsWhatTheBaseReports) {
  build({.battery_mv = 0});
  base_->already_streams(99 * kSecond);
  line_->start(100 * kSecond);
  run_for(1.0);
  drive_for(1.0, 0.4);
  EXPECT_EQ(last_->state.battery_share, 0.0);
  EXPECT_EQ(device_->problem(), "the base measures no battery voltage");
  base_->emergency_switch = true;
  drive_for(1.0, 0.4);
  EXPECT_TRUE(last_->state.stopped);
  EXPECT_EQ(last_->state.speed_m_s, 0.0);
  EXPECT_EQ(device_->problem(), "the emergency switch is pressed");
  base_->motor_fault = true;
  drive_for(0.2, 0.4);
  EXPECT_EQ(device_->problem(), "the base reports a fault of a motor");
  line_->faults.to_device_share = 1.0;  // the wire to the base is broken
  drive_for(1.5, 0.4);
  EXPECT_TRUE(last_->state.expired);
  EXPECT_EQ(device_->problem(), "the base sends, but receives no commands: check the line to it");
}

TEST(BaseSerialConfig, ThatCannotBeIsRejected) {
  BaseSerialParams params;
  params.battery_full_v = params.battery_empty_v;
  EXPECT_THROW(BaseSerial{params}, std::invalid_argument);
}

}  // namespace
}  // namespace adit
