// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The driver against an emulated laser, in simulated time.
#include "drivers/sick_lms2xx/sick_lms2xx.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/lasers/laser_line.hpp"
#include "tests/support/lasers/lms_emulator.hpp"

namespace adit {
namespace {

constexpr std::int64_t kSecond = 1'000'000;
constexpr int kReadings = 8000;  // below the codes

/// The first beam tells the number of the scan, the others follow from it.
std::uint16_t reading(int scan, int beam) {
  return static_cast<std::uint16_t>((scan + 37 * beam) % kReadings);
}

SickLms2xxParams params_of(int baud, int field_of_view_deg, double step_deg) {
  SickLms2xxParams params;
  params.laser.baud = baud;
  params.laser.field_of_view_deg = field_of_view_deg;
  params.laser.angle_step_deg = step_deg;
  return params;
}

/// A driver with an emulated laser, and what is wrong with the scans that it published.
class SickLms2xxTest : public testing::Test {
 protected:
  void build(const SickLms2xxParams& params, LmsEmulator::Params laser_params = {}) {
    params_ = params;
    laser_.emplace(laser_params, reading);
    device_.emplace(params, LaserId::kFront);
    line_.emplace(*device_, *laser_);
  }

  void run_for(double seconds) {
    line_->run_until(line_->now() + std::llround(1e6 * seconds),
                     [this](const LaserScan& scan, std::int64_t now) { check(scan, now); });
  }

  void check(const LaserScan& scan, std::int64_t now) {
    const double unit_m = params_.laser.unit_m();
    ASSERT_EQ(static_cast<int>(scan.ranges_m.size()), params_.laser.beams());
    const int first = static_cast<int>(std::lround(scan.ranges_m[0] / unit_m));
    // The last scan that was sent and has this number.
    int number = laser_->scans_sent() - 1;
    while (number > 0 && number % kReadings != first) --number;
    bool right = number % kReadings == first;
    for (int beam = 0; beam < params_.laser.beams(); ++beam) {
      const auto expected = static_cast<float>(reading(number, beam) * unit_m);
      right = right && scan.ranges_m[static_cast<std::size_t>(beam)] == expected;
    }
    wrong_ += right ? 0 : 1;
    ++scans_;
    if (last_arrival_)
      longest_gap_s_ = std::max(longest_gap_s_, 1e-6 * static_cast<double>(now - *last_arrival_));
    last_arrival_ = now;
    if (last_stamp_ && scan.utime <= *last_stamp_) ++unordered_;
    last_stamp_ = scan.utime;
    const double error_ms = 1e-3 * static_cast<double>(scan.utime - laser_->scan_start(number));
    if (now > judge_times_from_) worst_ms_ = std::max(worst_ms_, std::abs(error_ms));
  }

  /// Within which scans arrive again after a fault, at most: one round over all baud rates, and
  /// setting the laser.
  static constexpr double kRecoveryS = 8.0;

  SickLms2xxParams params_;
  std::optional<LmsEmulator> laser_;
  std::optional<SickLms2xx> device_;
  std::optional<LaserLine<LmsEmulator>> line_;
  int scans_ = 0;
  int wrong_ = 0;
  int unordered_ = 0;
  double longest_gap_s_ = 0.0;
  double worst_ms_ = 0.0;
  std::int64_t judge_times_from_ = 0;
  std::optional<std::int64_t> last_arrival_;
  std::optional<std::int64_t> last_stamp_;
};

struct Setting {
  int baud;
  int field_of_view_deg;
  double step_deg;
  double rate_hz;  ///< at which scans fit on the line
};

class SickLms2xxSettings : public SickLms2xxTest, public testing::WithParamInterface<Setting> {};

/// Switched on after the driver was started.
TEST_P(SickLms2xxSettings, AreSetOnAColdLaserAndScansAreRight) {
  const Setting setting = GetParam();
  LmsEmulator::Params laser;
  laser.turn_s *= 1.003;
  build(params_of(setting.baud, setting.field_of_view_deg, setting.step_deg), laser);
  line_->start(100 * kSecond);
  run_for(1.0);
  laser_->power_on(line_->now());
  run_for(2.0 + kRecoveryS);
  ASSERT_TRUE(device_->is_streaming()) << device_->problem();
  const int before = scans_;
  judge_times_from_ = line_->now();
  run_for(20.0);
  EXPECT_NEAR(scans_ - before, 20.0 * setting.rate_hz, 0.03 * 20.0 * setting.rate_hz + 1.0);
  EXPECT_EQ(wrong_, 0);
  EXPECT_EQ(unordered_, 0);
  EXPECT_LT(worst_ms_, 0.7);  // the driver is scheduled every 0.5 ms
  EXPECT_EQ(laser_->baud(), setting.baud);
  EXPECT_EQ(laser_->field_of_view_deg(), setting.field_of_view_deg);
  EXPECT_EQ(laser_->configurations_written(), 0);  // its unit was right
  EXPECT_EQ(device_->problem(), "");
}

// At 38400 baud a telegram of 181 beams takes 97 ms, 8 turns; one of 361 takes 191 ms, 15 turns.
INSTANTIATE_TEST_SUITE_P(
    OfTheLms, SickLms2xxSettings,
    testing::Values(Setting{500000, 180, 1.0, 75.0}, Setting{500000, 180, 0.5, 37.5},
                    Setting{500000, 100, 0.25, 18.75}, Setting{38400, 180, 1.0, 75.0 / 8.0},
                    Setting{38400, 180, 0.5, 37.5 / 8.0}, Setting{19200, 100, 1.0, 75.0 / 9.0},
                    Setting{9600, 180, 1.0, 75.0 / 30.0}));

class SickLms2xxBauds : public SickLms2xxTest, public testing::WithParamInterface<int> {};

TEST_P(SickLms2xxBauds, AreFoundWhileTheLaserStreams) {
  build(params_of(500000, 180, 0.5));
  laser_->already_streams(100 * kSecond, GetParam());
  line_->start(103 * kSecond);
  run_for(kRecoveryS);
  EXPECT_TRUE(device_->is_streaming()) << device_->problem();
  EXPECT_GT(scans_, 20);
  EXPECT_EQ(wrong_, 0);
}

INSTANTIATE_TEST_SUITE_P(OfTheLms, SickLms2xxBauds, testing::Values(9600, 19200, 38400, 500000));

TEST_F(SickLms2xxTest, SurvivesDamagedBytes) {
  build(params_of(500000, 180, 0.5));
  laser_->already_streams(100 * kSecond, 500000);
  line_->faults.corrupt_share = 0.0005;  // a third of the telegrams of 732 bytes
  line_->start(101 * kSecond);
  run_for(kRecoveryS);
  const int before = scans_;
  judge_times_from_ = line_->now();
  run_for(60.0);
  EXPECT_EQ(wrong_, 0);
  EXPECT_EQ(unordered_, 0);
  EXPECT_NEAR((scans_ - before) / (60.0 * 37.5), std::pow(0.9995, 732.0), 0.05);
  EXPECT_LT(worst_ms_, 1.0);
  EXPECT_GT(device_->line_counts().corrupt, 100);
}

/// Of a telegram of 372 bytes 1 in 40 is whole: the laser is not given up, and what passes is
/// right.
TEST_F(SickLms2xxTest, PublishesNothingWrongWithOnePercentOfTheBytesDamaged) {
  build(params_of(500000, 180, 1.0));
  laser_->already_streams(100 * kSecond, 500000);
  line_->start(101 * kSecond);
  run_for(kRecoveryS);
  line_->faults.corrupt_share = 0.01;
  const int before = scans_;
  run_for(120.0);
  EXPECT_EQ(wrong_, 0);
  EXPECT_GT(scans_ - before, 60);
  line_->faults.corrupt_share = 0.0;
  run_for(kRecoveryS);
  const int again = scans_;
  run_for(10.0);
  EXPECT_NEAR(scans_ - again, 750, 10);
}

TEST_F(SickLms2xxTest, ContinuesAfterTheCableWasPulled) {
  build(params_of(500000, 180, 0.5));
  laser_->already_streams(100 * kSecond, 500000);
  line_->start(101 * kSecond);
  run_for(kRecoveryS);
  line_->faults.is_pulled = true;
  run_for(10.0);
  EXPECT_FALSE(device_->is_streaming());
  EXPECT_NE(device_->problem(), "");
  line_->faults.is_pulled = false;
  longest_gap_s_ = 0.0;
  run_for(kRecoveryS);
  EXPECT_TRUE(device_->is_streaming());
  EXPECT_GE(longest_gap_s_, 10.0);
  EXPECT_LT(longest_gap_s_, 10.0 + kRecoveryS);
  EXPECT_EQ(device_->session().counts().losses, 1);
  judge_times_from_ = line_->now();
  run_for(10.0);
  EXPECT_EQ(wrong_, 0);
  EXPECT_LT(worst_ms_, 1.0);
}

TEST_F(SickLms2xxTest, SetsALaserThatWasSwitchedOffAgain) {
  build(params_of(500000, 180, 0.5));
  laser_->already_streams(100 * kSecond, 500000);
  line_->start(101 * kSecond);
  run_for(kRecoveryS);
  laser_->power_off();
  run_for(3.0);
  laser_->power_on(line_->now());  // at 9600 baud, and not measuring
  run_for(2.0 + kRecoveryS);
  EXPECT_TRUE(device_->is_streaming()) << device_->problem();
  EXPECT_EQ(laser_->baud(), 500000);
  judge_times_from_ = line_->now();
  run_for(10.0);
  EXPECT_EQ(wrong_, 0);
  EXPECT_LT(worst_ms_, 1.0);
}

TEST_F(SickLms2xxTest, WritesTheUnitOnceByThePassword) {
  SickLms2xxParams params = params_of(500000, 180, 1.0);
  params.laser.unit = "mm";
  params.lasers.front.range_max_m = 8.0;
  build(params);
  laser_->already_streams(100 * kSecond, 500000);
  line_->start(101 * kSecond);
  run_for(kRecoveryS);
  EXPECT_TRUE(device_->is_streaming()) << device_->problem();
  laser_->power_off();
  laser_->power_on(line_->now());
  run_for(2.0 + kRecoveryS);
  EXPECT_TRUE(device_->is_streaming()) << device_->problem();
  EXPECT_EQ(laser_->configurations_written(), 1);
  EXPECT_GT(scans_, 100);
  EXPECT_EQ(wrong_, 0);
}

TEST_F(SickLms2xxTest, SaysThatThePasswordIsWrong) {
  SickLms2xxParams params = params_of(38400, 180, 1.0);
  params.laser.unit = "mm";
  params.lasers.front.range_max_m = 8.0;
  build(params, {.password = "SESAME__"});
  laser_->already_streams(100 * kSecond, 38400);
  line_->start(101 * kSecond);
  run_for(20.0);
  EXPECT_FALSE(device_->is_streaming());
  EXPECT_THAT(device_->problem(), testing::HasSubstr("password"));
}

TEST_F(SickLms2xxTest, ReportsADirtyWindow) {
  build(params_of(500000, 180, 1.0), {.status = 0x91});
  laser_->already_streams(100 * kSecond, 500000);
  line_->start(101 * kSecond);
  run_for(kRecoveryS);
  EXPECT_GT(scans_, 0);
  EXPECT_THAT(device_->problem(), testing::HasSubstr("dirty"));
}

/// A driver that is scheduled late reads several scans at once.
TEST_F(SickLms2xxTest, StampsScansThatWaitedWithTheTimeAtWhichTheyWereMeasured) {
  build(params_of(500000, 180, 1.0));
  laser_->already_streams(100 * kSecond, 500000);
  line_->faults.late_share = 0.002;  // once a second
  line_->faults.late_us = 47'000;    // three scans and a half
  line_->start(101 * kSecond);
  run_for(kRecoveryS);
  const int before = scans_;
  judge_times_from_ = line_->now();
  run_for(60.0);
  EXPECT_LT(worst_ms_, 1.5);
  EXPECT_EQ(unordered_, 0);
  EXPECT_GT(scans_ - before, 0.98 * 60.0 * 75.0);
}

TEST(SickLms2xxConfig, MirrorsALaserThatIsMountedUpsideDown) {
  SickLms2xxParams params = params_of(500000, 100, 0.5);
  params.upside_down = true;
  SickLms2xx device(params, LaserId::kFront);
  LmsEmulator laser({}, reading);
  laser.already_streams(100 * kSecond, 500000);
  LaserLine line(device, laser);
  line.start(101 * kSecond);
  std::optional<LaserScan> last;
  line.run_until(106 * kSecond, [&](const LaserScan& scan, std::int64_t) { last = scan; });
  ASSERT_TRUE(last);
  EXPECT_NEAR(last->angle_min_rad, -50.0 * std::numbers::pi / 180.0, 1e-9);
  EXPECT_NEAR(last->angle_step_rad, 0.5 * std::numbers::pi / 180.0, 1e-9);
  const int scan = static_cast<int>(std::lround(last->ranges_m[200] * 100.0));
  EXPECT_FLOAT_EQ(last->ranges_m[0], static_cast<float>(reading(scan, 200) * 0.01));
}

/// The message of the error with which the driver does not start.
std::string error_of(const SickLms2xxParams& params) {
  try {
    const SickLms2xx device(params, LaserId::kFront);
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(SickLms2xxConfig, OfNoLmsIsRejected) {
  EXPECT_EQ(error_of(params_of(500000, 180, 0.5)), "");
  EXPECT_THAT(error_of(params_of(115200, 180, 0.5)), testing::HasSubstr("baud is 115200"));
  EXPECT_THAT(error_of(params_of(38400, 180, 0.25)), testing::HasSubstr("steps of 0.25"));
  EXPECT_THAT(error_of(params_of(38400, 120, 1.0)), testing::HasSubstr("120°"));
  SickLms2xxParams params = params_of(38400, 180, 1.0);
  params.laser.password = "short";
  EXPECT_THAT(error_of(params), testing::HasSubstr("8 characters"));
}

/// A reading without return, 8.19 m, would be a wall.
TEST(SickLms2xxConfig, InMillimetresNeedsAShortRange) {
  SickLms2xxParams params = params_of(38400, 180, 1.0);
  params.laser.unit = "mm";
  params.lasers.front.range_max_m = 80.0;
  EXPECT_THAT(error_of(params), testing::HasSubstr("lasers.front.range_max_m is 80"));
  params.lasers.front.range_max_m = 8.0;
  EXPECT_EQ(error_of(params), "");
}

}  // namespace
}  // namespace adit
