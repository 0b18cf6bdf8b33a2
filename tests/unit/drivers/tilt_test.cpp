// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The driver against an emulated servo, in simulated time.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/tilt/packet.hpp"
#include "drivers/tilt/servo.hpp"

#include "tests/support/devices/servo_emulator.hpp"
#include "tests/support/lasers/laser_line.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::int64_t kSecond = 1'000'000;
constexpr double kRadPerPosition = 2.0 * std::numbers::pi / 4096.0;

/// Examples of the e-manual.
TEST(DynamixelPackets, AreThoseOfTheManual) {
  EXPECT_THAT(encode_instruction(1, DynamixelInstruction::kPing, {}),
              ElementsAre(0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x01, 0x19, 0x4E));
  const std::vector<std::uint8_t> goal{0x74, 0x00, 0x00, 0x02, 0x00, 0x00};
  EXPECT_THAT(encode_instruction(1, DynamixelInstruction::kWrite, goal),
              ElementsAre(0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x09, 0x00, 0x03, 0x74, 0x00, 0x00, 0x02,
                          0x00, 0x00, 0xCA, 0x89));
  const std::vector<std::uint8_t> position{0x84, 0x00, 0x04, 0x00};
  EXPECT_THAT(encode_instruction(1, DynamixelInstruction::kRead, position),
              ElementsAre(0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x07, 0x00, 0x02, 0x84, 0x00, 0x04, 0x00,
                          0x1D, 0x15));
  DynamixelDecoder decoder;
  const std::vector<std::uint8_t> ping{0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x07, 0x00,
                                       0x55, 0x00, 0x06, 0x04, 0x26, 0x65, 0x5D};
  const std::vector<std::uint8_t> read{0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x08, 0x00, 0x55,
                                       0x00, 0xA6, 0x00, 0x00, 0x00, 0x8C, 0xC0};
  decoder.add(ping, 0, 0.0);
  decoder.add(read, 0, 0.0);
  EXPECT_THAT(decoder.next()->parameters, ElementsAre(0x06, 0x04, 0x26));
  EXPECT_THAT(decoder.next()->parameters, ElementsAre(0xA6, 0, 0, 0));
  EXPECT_FALSE(decoder.next());
}

TEST(DynamixelPackets, KeepTheHeaderOutOfWhatTheyCarry) {
  const std::vector<std::uint8_t> parameters{116, 0, 0xFF, 0xFF, 0xFD, 0x00};
  const auto packet = encode_instruction(1, DynamixelInstruction::kWrite, parameters);
  EXPECT_EQ(packet.size(), 10 + parameters.size() + 1);
  EXPECT_EQ(packet[13], 0xFD);
  EXPECT_EQ(packet[14], 0x00);
  // As a status it must come back as it was. Its own start is garbage, each byte a read of its own.
  std::vector<std::uint8_t> status{0xFF, 0xFF, 0xFF, 0xFF, 0xFD, 0x00, 1,    9,
                                   0,    0x55, 0,    0xFF, 0xFF, 0xFD, 0xFD, 0xFD};
  const auto crc = dynamixel_crc(std::span(status).subspan(2));
  status.push_back(static_cast<std::uint8_t>(crc & 0xFF));
  status.push_back(static_cast<std::uint8_t>(crc >> 8));
  DynamixelDecoder decoder;
  std::vector<DynamixelStatus> found;
  for (const std::uint8_t byte : status) {
    decoder.add(std::vector<std::uint8_t>{byte}, 0, 0.0);
    while (auto one = decoder.next()) found.push_back(*one);
  }
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0].parameters, ElementsAre(0xFF, 0xFF, 0xFD, 0xFD));
}

class TiltServoTest : public testing::Test {
 protected:
  void build(const TiltServoParams& params, const ServoEmulator::Params& servo = {}) {
    params_ = params;
    servo_.emplace(servo);
    device_.emplace(params);
    line_.emplace(*device_, *servo_, TiltServo::kTickUs);
  }

  void run_for(double seconds) {
    line_->run_until(line_->now() + std::llround(1e6 * seconds),
                     [this](const TiltReading& reading, std::int64_t now) { check(reading, now); });
  }

  void command(double angle_rad, double rate_rad_s) {
    device_->command({line_->now(), angle_rad, rate_rad_s});
  }

  void check(const TiltReading& reading, std::int64_t now) {
    ++readings_;
    if (last_ && reading.utime <= last_->utime) ++unordered_;
    last_ = reading;
    if (now < judge_from_) return;
    // The servo was read 20 ms or more apart: the next sample is the one of this reading.
    double off_ms = std::numeric_limits<double>::infinity();
    double position = 0.0;
    for (const auto& sample : servo_->samples()) {
      const double ms = 1e-3 * static_cast<double>(reading.utime - sample.utime);
      if (std::abs(ms) >= std::abs(off_ms)) continue;
      off_ms = ms;
      position = sample.position;
    }
    worst_stamp_ms_ = std::max(worst_stamp_ms_, std::abs(off_ms));
    const double sign = params_.reversed ? -1.0 : 1.0;
    const double true_rad = sign * (position - params_.level_position) * kRadPerPosition;
    if (std::abs(reading.angle_rad - true_rad) > 0.51 * kRadPerPosition) ++wrong_;
  }

  [[nodiscard]] double true_angle_rad() const {
    return (servo_->position() - params_.level_position) * kRadPerPosition;
  }

  static constexpr double kRecoveryS = 3.0;

  TiltServoParams params_;
  std::optional<ServoEmulator> servo_;
  std::optional<TiltServo> device_;
  std::optional<LaserLine<ServoEmulator, TiltReading>> line_;
  std::optional<TiltReading> last_;
  int readings_ = 0;
  int wrong_ = 0;
  int unordered_ = 0;
  std::int64_t judge_from_ = 0;
  double worst_stamp_ms_ = 0.0;
};

TEST_F(TiltServoTest, StartsAColdServoHoldsItAndTiltsItAsCommanded) {
  // Its clock is fast and overflows after 2 s.
  build({}, {.clock_rate = 1.001, .clock_start_ms = 30'700, .position = 2100.0});
  line_->start(100 * kSecond);
  run_for(1.0);
  servo_->power_on(line_->now());
  run_for(kRecoveryS);
  ASSERT_TRUE(device_->is_streaming()) << device_->problem();
  EXPECT_TRUE(servo_->torque());
  EXPECT_EQ(servo_->position(), 2100.0);  // no command, no motion
  judge_from_ = line_->now();
  const int before = readings_;
  command(-0.4, 0.3);
  run_for(1.0);
  EXPECT_NEAR(last_->rate_rad_s, -0.3, 0.025);  // a unit of velocity
  run_for(9.0);
  EXPECT_NEAR(readings_ - before, 500, 15);
  EXPECT_NEAR(true_angle_rad(), -0.4, 0.51 * kRadPerPosition);
  EXPECT_NEAR(last_->angle_rad, -0.4, 0.51 * kRadPerPosition);
  EXPECT_EQ(last_->rate_rad_s, 0.0);
  EXPECT_EQ(wrong_, 0);
  EXPECT_EQ(unordered_, 0);
  EXPECT_LT(worst_stamp_ms_, 2.0);  // its clock has milliseconds
  EXPECT_EQ(device_->problem(), "");
}

TEST_F(TiltServoTest, FindsTheBaudRateAndKeepsTheTorqueOfAServoThatHolds) {
  for (const int baud : {1'000'000, 115200}) {
    build({}, {.baud = baud, .line_echoes = true});
    servo_->already_holds(99 * kSecond, 1800);
    line_->start(100 * kSecond);
    run_for(kRecoveryS);
    ASSERT_TRUE(device_->is_streaming()) << baud << ": " << device_->problem();
    EXPECT_EQ(servo_->position(), 1800.0);
    EXPECT_EQ(servo_->torque_losses(), 0);
    EXPECT_GT(readings_, 20);
  }
}

TEST_F(TiltServoTest, KeepsToItsLimits) {
  build({.reversed = true, .angle_min_rad = -0.3, .angle_max_rad = 0.2, .rate_max_rad_s = 0.5});
  servo_->already_holds(99 * kSecond, 2048);
  line_->start(100 * kSecond);
  run_for(kRecoveryS);
  judge_from_ = line_->now();
  command(1.0, 5.0);
  run_for(0.3);
  EXPECT_NEAR(last_->rate_rad_s, 0.5, 0.025);
  run_for(2.0);
  EXPECT_NEAR(last_->angle_rad, 0.2, 0.51 * kRadPerPosition);
  EXPECT_NEAR(true_angle_rad(), -0.2, 0.51 * kRadPerPosition);
  EXPECT_EQ(wrong_, 0);
}

TEST_F(TiltServoTest, ObeysOnADamagedLine) {
  build({});
  servo_->already_holds(99 * kSecond, 2048);
  line_->start(100 * kSecond);
  run_for(kRecoveryS);
  judge_from_ = line_->now();
  line_->faults.corrupt_share = 0.01;
  line_->faults.to_device_share = 0.01;
  const int before = readings_;
  for (int i = 0; i < 30; ++i) {
    const double angle_rad = i % 2 == 0 ? 0.3 : -0.3;
    command(angle_rad, 1.0);
    run_for(2.0);
    EXPECT_NEAR(true_angle_rad(), angle_rad, 0.51 * kRadPerPosition) << i;
  }
  EXPECT_GT(readings_ - before, 1200);  // of 3000: an answer has 27 bytes, a question 14
  EXPECT_EQ(wrong_, 0);
  EXPECT_EQ(unordered_, 0);
  EXPECT_GT(device_->line_counts().corrupt, 100);
}

TEST_F(TiltServoTest, ContinuesAfterTheCableWasPulledAndTheServoSwitchedOff) {
  build({});
  servo_->already_holds(99 * kSecond, 2048);
  line_->start(100 * kSecond);
  run_for(kRecoveryS);
  line_->faults.is_pulled = true;
  run_for(1.0);
  command(0.3, 0.5);
  run_for(9.0);
  EXPECT_FALSE(device_->is_streaming());
  EXPECT_THAT(device_->problem(), HasSubstr("no answer at any baud rate"));
  line_->faults.is_pulled = false;
  run_for(kRecoveryS);
  EXPECT_TRUE(device_->is_streaming());
  EXPECT_NEAR(true_angle_rad(), 0.3, 0.51 * kRadPerPosition);  // the last command
  for (const double off_s : {2.0, 0.0}) {
    servo_->power_off();
    run_for(off_s);
    servo_->power_on(line_->now());
    run_for(1.0 + kRecoveryS);
    ASSERT_TRUE(device_->is_streaming()) << device_->problem();
    EXPECT_TRUE(servo_->torque());
    EXPECT_NEAR(true_angle_rad(), 0.3, 0.51 * kRadPerPosition);
  }
  judge_from_ = line_->now();
  command(-0.3, 0.5);
  run_for(5.0);
  EXPECT_EQ(wrong_, 0);
  EXPECT_LT(worst_stamp_ms_, 2.0);
}

TEST_F(TiltServoTest, StampsReadingsWhenItIsScheduledLate) {
  build({});
  servo_->already_holds(99 * kSecond, 2048);
  line_->start(100 * kSecond);
  run_for(5.0);
  judge_from_ = line_->now();
  line_->faults.late_share = 0.0005;  // once in a second
  line_->faults.late_us = 47'000;
  command(0.4, 0.1);
  run_for(20.0);
  EXPECT_EQ(wrong_, 0);
  EXPECT_LT(worst_stamp_ms_, 2.0);
}

TEST_F(TiltServoTest, ReportsAHardwareErrorAndTheAngleAllTheSame) {
  build({});
  servo_->already_holds(99 * kSecond, 2048);
  line_->start(100 * kSecond);
  run_for(kRecoveryS);
  servo_->fail(1U << 5);
  const int before = readings_;
  run_for(1.0);
  EXPECT_THAT(device_->problem(), HasSubstr("hardware error, overload"));
  EXPECT_GT(readings_ - before, 45);
  servo_->power_off();
  run_for(1.0);
  servo_->power_on(line_->now());
  run_for(1.0 + kRecoveryS);
  EXPECT_EQ(device_->problem(), "");
  EXPECT_TRUE(servo_->torque());
}

TEST_F(TiltServoTest, ReportsWhatTheServoRejectsAndHowItIsSet) {
  build({}, {.position_min = 2000});
  servo_->already_holds(99 * kSecond, 2048);
  line_->start(100 * kSecond);
  run_for(kRecoveryS);
  command(-0.5, 0.5);
  run_for(0.5);
  EXPECT_EQ(device_->problem(), "the servo rejects the goal with error 6");
  command(0.1, 0.5);
  run_for(2.0);
  EXPECT_EQ(device_->problem(), "");

  build({}, {.operating_mode = 1});
  servo_->already_holds(99 * kSecond, 2048);
  line_->start(100 * kSecond);
  run_for(kRecoveryS);
  EXPECT_THAT(device_->problem(), HasSubstr("its operating mode is 1: set it to 3"));

  build({}, {.status_return_level = 1});
  servo_->already_holds(99 * kSecond, 2048);
  line_->start(100 * kSecond);
  run_for(kRecoveryS);
  EXPECT_THAT(device_->problem(), HasSubstr("its status return level is 1: set it to 2"));
}

TEST(TiltServoConfig, ThatCannotBeIsRejected) {
  EXPECT_THROW(TiltServo({.angle_min_rad = 0.2, .angle_max_rad = 0.2}), std::invalid_argument);
}

}  // namespace
}  // namespace adit
