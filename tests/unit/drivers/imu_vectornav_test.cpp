// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The driver against an emulated unit, in simulated time.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/imu_vectornav/line.hpp"
#include "drivers/imu_vectornav/vectornav.hpp"

#include "tests/support/devices/imu_emulator.hpp"
#include "tests/support/lasers/laser_line.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::int64_t kSecond = 1'000'000;

/// The rate about x tells the number of the output; the unit lies with z down.
std::array<double, 6> reading(int number) {
  return {0.1, -0.2, -9.81, 1e-5 * (number % 100'000), 0.02, -0.3};
}

std::vector<std::uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

/// As units send them, and the check value of the CRC.
TEST(VnLines, HaveTheChecksumsOfTheUnit) {
  EXPECT_EQ(vn_crc("123456789"), 0x31C3);
  VnDecoder decoder;
  decoder.add(
      bytes_of("6*00\r\n$VNRRG,01,VN-100_v4*47\r\n$VNIMU,-00.0350,+00.4222,-00.6643,-00.015,"
               "+00.019,+09.948,+00.002066,-00.008442,-00.044656,+20.7,+084.322*66\r\n"),
      0, 0.0);
  auto line = decoder.next();
  ASSERT_TRUE(line);
  EXPECT_EQ(line->header, "VNRRG");
  EXPECT_THAT(line->fields, ElementsAre("01", "VN-100_v4"));
  EXPECT_FALSE(line->has_crc);
  line = decoder.next();
  ASSERT_TRUE(line);
  EXPECT_EQ(line->header, "VNIMU");
  EXPECT_EQ(line->fields.size(), 11U);
  EXPECT_FALSE(decoder.next());
  EXPECT_EQ(decoder.counts().corrupt, 0);
  EXPECT_EQ(encode_vn_line("VNWRG,30,0,0,0,0,0,0,1"), bytes_of("$VNWRG,30,0,0,0,0,0,0,1*68\r\n"));
}

TEST(VnDecoder, DropsDamagedLinesAndFindsOneBehindALostEnd) {
  VnDecoder decoder;
  decoder.add(bytes_of("$VNRRG,01,VN-200_v4*47\r\n$VNIMU,1,2$VNRRG,01,VN-100_v4*47\r\n$VN*4\r\n"),
              0, 0.0);
  const auto line = decoder.next();
  ASSERT_TRUE(line);
  EXPECT_THAT(line->fields, ElementsAre("01", "VN-100_v4"));
  EXPECT_FALSE(decoder.next());
  EXPECT_EQ(decoder.counts().corrupt, 2);
}

class VectorNavTest : public testing::Test {
 protected:
  void build(const VectorNavParams& params, const ImuEmulator::Params& unit = {}) {
    unit_.emplace(unit, reading);
    device_.emplace(params);
    line_.emplace(*device_, *unit_, kTickUs);
  }

  void run_for(double seconds) {
    line_->run_until(line_->now() + std::llround(1e6 * seconds),
                     [this](const ImuReading& one, std::int64_t now) { check(one, now); });
  }

  /// With the default mounting, y and z of the unit are turned round.
  void check(const ImuReading& one, std::int64_t now) {
    ++readings_;
    if (last_ && one.utime <= last_->utime) ++unordered_;
    last_ = one;
    const auto number = static_cast<int>(std::lround(1e5 * one.angular_velocity.x()));
    const Eigen::Vector3d turn(1e-5 * number, -0.02, 0.3);
    const Eigen::Vector3d force(0.1, 0.2, 9.81);
    const auto first = unit_->first_number();
    const auto count = static_cast<int>(unit_->starts().size());
    const bool is_right = (one.angular_velocity - turn).norm() < 1e-9 &&
                          (one.linear_acceleration - force).norm() < 1e-9 && number >= first &&
                          number < first + count;
    if (!is_right) {
      ++wrong_;
      return;
    }
    const std::int64_t start = unit_->starts()[static_cast<std::size_t>(number - first)];
    if (now < judge_from_) return;
    worst_stamp_ms_ =
        std::max(worst_stamp_ms_, 1e-3 * std::abs(static_cast<double>(one.utime - start)));
  }

  static constexpr std::int64_t kTickUs = 50'000;
  static constexpr double kRecoveryS = 6.0;

  std::optional<ImuEmulator> unit_;
  std::optional<VectorNav> device_;
  std::optional<LaserLine<ImuEmulator, ImuReading>> line_;
  std::optional<ImuReading> last_;
  int readings_ = 0;
  int wrong_ = 0;
  int unordered_ = 0;
  std::int64_t judge_from_ = std::numeric_limits<std::int64_t>::max();
  double worst_stamp_ms_ = 0.0;
};

TEST_F(VectorNavTest, SetsAColdUnitAndStampsItsReadings) {
  build({}, {.clock_rate = 1.001});
  line_->start(100 * kSecond);
  run_for(1.0);
  unit_->power_on(line_->now());
  run_for(1.0 + kRecoveryS);
  ASSERT_TRUE(device_->is_streaming()) << device_->problem();
  EXPECT_EQ(unit_->baud(), 230400);
  judge_from_ = line_->now();
  const int before = readings_;
  run_for(30.0);
  EXPECT_NEAR(readings_ - before, 3003, 3);
  EXPECT_EQ(wrong_, 0);
  EXPECT_EQ(unordered_, 0);
  EXPECT_LT(worst_stamp_ms_, 1.0);
  EXPECT_EQ(device_->problem(), "");
}

TEST_F(VectorNavTest, FindsAUnitThatStreamsAtAnotherBaudRate) {
  for (const int baud : {57600, 115200, 921600}) {
    build({.rate_hz = 50, .output = "ymr"});
    unit_->already_streams(99 * kSecond, baud);
    line_->start(100 * kSecond);
    run_for(8.0);
    ASSERT_TRUE(device_->is_streaming()) << baud << ": " << device_->problem();
    const int before = readings_;
    run_for(2.0);
    EXPECT_NEAR(readings_ - before, 100, 2);
    EXPECT_EQ(wrong_, 0);
  }
}

TEST_F(VectorNavTest, PublishesNothingOfDamagedLines) {
  build({});
  unit_->already_streams(99 * kSecond, 230400);
  line_->start(100 * kSecond);
  run_for(kRecoveryS);
  judge_from_ = line_->now();
  line_->faults.corrupt_share = 0.01;
  const int before = readings_;
  run_for(60.0);
  EXPECT_GT(readings_ - before, 1200);  // of 6000: a line has 110 bytes
  EXPECT_EQ(wrong_, 0);
  EXPECT_LT(worst_stamp_ms_, 1.0);
  EXPECT_GT(device_->line_counts().corrupt, 2000);
  line_->faults = {};
  const int clean = readings_;
  run_for(10.0);
  EXPECT_GT(readings_ - clean, 990);
}

TEST_F(VectorNavTest, ContinuesAfterTheCableWasPulledAndTheUnitSwitchedOff) {
  build({});
  unit_->already_streams(99 * kSecond, 230400);
  line_->start(100 * kSecond);
  run_for(kRecoveryS);
  line_->faults.is_pulled = true;
  run_for(10.0);
  EXPECT_FALSE(device_->is_streaming());
  EXPECT_THAT(device_->problem(), HasSubstr("no answer at any baud rate"));
  line_->faults.is_pulled = false;
  run_for(kRecoveryS);
  EXPECT_TRUE(device_->is_streaming()) << device_->problem();
  for (const double off_s : {2.0, 0.0}) {
    unit_->power_off();
    run_for(off_s);
    unit_->power_on(line_->now());  // with the settings of its flash memory
    run_for(1.0 + kRecoveryS);
    EXPECT_TRUE(device_->is_streaming()) << device_->problem();
  }
  judge_from_ = line_->now() + kSecond;
  const int before = readings_;
  run_for(10.0);
  EXPECT_NEAR(readings_ - before, 1000, 3);
  EXPECT_EQ(wrong_, 0);
  EXPECT_EQ(unordered_, 0);
  EXPECT_LT(worst_stamp_ms_, 1.0);
}

TEST_F(VectorNavTest, StampsReadingsWhenItIsScheduledLate) {
  build({});
  unit_->already_streams(99 * kSecond, 230400);
  line_->start(100 * kSecond);
  run_for(kRecoveryS + 3.0);
  judge_from_ = line_->now();
  line_->faults.late_share = 0.0005;  // once in a second
  line_->faults.late_us = 47'000;
  const int before = readings_;
  run_for(20.0);
  EXPECT_GT(readings_ - before, 0.95 * 2000);
  EXPECT_EQ(wrong_, 0);
  EXPECT_LT(worst_stamp_ms_, 1.5);
}

TEST_F(VectorNavTest, ReportsAMountingThatCannotBeAndWhatTheUnitRejects) {
  build({.roll_deg = 0.0});  // z up
  unit_->already_streams(99 * kSecond, 230400);
  line_->start(100 * kSecond);
  run_for(kRecoveryS);
  EXPECT_THAT(device_->problem(), HasSubstr("correct roll_deg, pitch_deg, yaw_deg"));

  build({.baud = 57600});  // too slow for 100 readings per second
  unit_->already_streams(99 * kSecond, 57600);
  line_->start(100 * kSecond);
  run_for(1.0);
  EXPECT_THAT(device_->problem(), HasSubstr("rejects 'VNWRG,07,100' with error '12'"));
}

TEST(VectorNavConfig, ThatCannotBeIsRejected) {
  EXPECT_THROW(VectorNav({.rate_hz = 60}), std::invalid_argument);
}

}  // namespace
}  // namespace adit
