// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The driver against an emulated laser, in simulated time.
#include "drivers/scip/scip.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/lasers/laser_line.hpp"
#include "tests/support/lasers/scip_emulator.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::int64_t kSecond = 1'000'000;
constexpr std::uint32_t kReadings = 4000;  // that two characters encode
constexpr std::uint32_t kLeast = 30;       // above the codes

/// The first step tells the number of the scan, the others follow from it.
std::uint32_t reading(int scan, int step) {
  return kLeast + static_cast<std::uint32_t>(scan + 37 * step) % kReadings;
}

std::vector<std::uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

/// Examples of the specification.
TEST(ScipNumber, IsDecodedAsInTheSpecification) {
  EXPECT_EQ(scip_number("CB"), 1234U);
  EXPECT_EQ(scip_number("1Dh"), 5432U);
  EXPECT_EQ(scip_number("m2@0"), 16000000U);
  EXPECT_EQ(scip_number("0 "), std::nullopt);
  EXPECT_EQ(scip_checksum("00"), 'P');
  EXPECT_EQ(scip_checksum("99"), 'b');
}

TEST(ScipDecoder, FindsResponsesAndDropsDamagedOnes) {
  ScipDecoder decoder;
  decoder.add(
      bytes_of("garbage\n\nBM\n00P\n\nQT\n00X\n\nTM1\n00P\nm2@0a\n\nPP\n00P\nDMIN:23;7\n\n"), 0,
      0.0);
  auto response = decoder.next();
  ASSERT_TRUE(response);
  EXPECT_EQ(response->echo, "BM");
  EXPECT_EQ(response->status, "00");
  response = decoder.next();  // that of QT and that of TM1 have a wrong checksum
  ASSERT_TRUE(response) << "of PP";
  EXPECT_EQ(response->echo, "PP");
  EXPECT_THAT(response->lines, ElementsAre("DMIN:23"));
  EXPECT_FALSE(decoder.next());
  EXPECT_EQ(decoder.counts().responses, 2);
  EXPECT_EQ(decoder.counts().corrupt, 3);
}

TEST(ScipParameters, ThatContradictEachOtherAreRejected) {
  ScipResponse response;
  response.lines = {"DMIN:23",   "DMAX:60000", "ARES:1440", "AMIN:0",
                    "AMAX:1080", "AFRT:540",   "SCAN:2400"};
  ASSERT_TRUE(read_parameters(response));
  EXPECT_NEAR(read_parameters(response)->bearing_rad(0), -0.75 * std::numbers::pi, 1e-12);
  for (const auto& [line, text] : std::vector<std::pair<std::size_t, std::string>>{
           {2, "ARES:0"}, {4, "AMAX:0"}, {4, "AMAX:9999"}, {6, "SCAN:"}, {1, "DMAX:x"}, {0, "D"}}) {
    ScipResponse wrong = response;
    wrong.lines[line] = text;
    EXPECT_FALSE(read_parameters(wrong)) << text;
  }
}

class ScipTest : public testing::Test {
 protected:
  void build(const ScipParams& params, const ScipEmulator::Params& laser = {}) {
    params_ = params;
    params_.lasers.front.range_max_m = 50.0;
    laser_.emplace(laser, reading);
    device_.emplace(params_, LaserId::kFront);
    line_.emplace(*device_, *laser_);
  }

  void run_for(double seconds) {
    line_->run_until(line_->now() + std::llround(1e6 * seconds),
                     [this](const LaserScan& scan, std::int64_t now) { check(scan, now); });
  }

  void check(const LaserScan& scan, std::int64_t now) {
    ++scans_;
    last_ = scan;
    const int first_step =
        540 + static_cast<int>(std::lround(scan.angle_min_rad / scan.angle_step_rad));
    const auto raw_of = [&](std::size_t beam) {
      return static_cast<std::uint32_t>(std::lround(1000.0F * scan.ranges_m[beam]));
    };
    int number = laser_->scans_sent() - 1;
    while (number > 0 && reading(number, first_step) != raw_of(0)) --number;
    bool right = true;
    for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
      right = right && raw_of(beam) == reading(number, first_step + static_cast<int>(beam));
    }
    if (!right) {
      ++wrong_;
      return;
    }
    if (last_stamp_ && scan.utime <= *last_stamp_) ++unordered_;
    last_stamp_ = scan.utime;
    const double error_ms = 1e-3 * static_cast<double>(scan.utime - laser_->scan_start(number));
    if (now > judge_times_from_) worst_ms_ = std::max(worst_ms_, std::abs(error_ms));
  }

  static constexpr double kRecoveryS = 5.0;

  ScipParams params_;
  std::optional<ScipEmulator> laser_;
  std::optional<Scip> device_;
  std::optional<LaserLine<ScipEmulator>> line_;
  int scans_ = 0;
  int wrong_ = 0;
  int unordered_ = 0;
  double worst_ms_ = 0.0;
  std::int64_t judge_times_from_ = 0;
  std::optional<LaserScan> last_;
  std::optional<std::int64_t> last_stamp_;
};

ScipParams by_tcp() {
  ScipParams params;
  params.device = "tcp://192.168.0.10:10940";
  return params;
}

TEST_F(ScipTest, StartsAColdLaserByTcpAndStampsItsScans) {
  // Its clock is fast, and overflows after 30 seconds.
  build(by_tcp(), {.has_baud = false, .clock_rate = 1.0005, .clock_start_ms = (1U << 24) - 30'000});
  line_->start(100 * kSecond);
  run_for(1.0);
  laser_->power_on(line_->now());
  run_for(1.0 + kRecoveryS);
  ASSERT_TRUE(device_->is_streaming()) << device_->problem();
  judge_times_from_ = line_->now();
  const int before = scans_;
  run_for(60.0);
  EXPECT_NEAR(scans_ - before, 2400, 20);
  EXPECT_EQ(wrong_, 0);
  EXPECT_EQ(unordered_, 0);
  // The laser stamps milliseconds, answers after 2 ms, and the driver is scheduled every 0.5 ms.
  EXPECT_LT(worst_ms_, 2.0);
  EXPECT_EQ(last_->ranges_m.size(), 1081U);
  EXPECT_NEAR(last_->angle_min_rad, -0.75 * std::numbers::pi, 1e-9);
  EXPECT_EQ(device_->problem(), "");
  EXPECT_TRUE(device_->clock().uncertainty_us());
}

TEST_F(ScipTest, StampsScansOfALaserThatDoesNotTellItsTime) {
  build(by_tcp(), {.has_baud = false, .tells_time = false});
  laser_->already_streams(99 * kSecond, 0);
  line_->start(100 * kSecond);
  run_for(kRecoveryS);
  judge_times_from_ = line_->now();
  run_for(20.0);
  EXPECT_FALSE(device_->clock().uncertainty_us());
  EXPECT_GT(scans_, 700);
  EXPECT_LT(worst_ms_, 5.0);  // the time on the network is not known: 3.3 kB by 10 Mbit/s
}

TEST_F(ScipTest, FindsAndChangesTheBaudRate) {
  ScipParams params;
  params.device = "/dev/ttyS0";
  params.baud = 500000;
  params.characters = 2;
  params.angle_min_deg = -90.0;
  params.angle_max_deg = 90.0;
  build(params);
  laser_->already_streams(99 * kSecond, 19200);
  line_->start(100 * kSecond);
  run_for(kRecoveryS);
  EXPECT_TRUE(device_->is_streaming()) << device_->problem();
  EXPECT_EQ(laser_->baud(), 500000);
  judge_times_from_ = line_->now();
  const int before = scans_;
  run_for(20.0);
  EXPECT_NEAR(scans_ - before, 400, 10);  // 1,480 bytes take 30 ms: each second scan
  EXPECT_EQ(wrong_, 0);
  EXPECT_LT(worst_ms_, 2.0);
  EXPECT_EQ(last_->ranges_m.size(), 721U);
  EXPECT_NEAR(last_->angle_min_rad, -0.5 * std::numbers::pi, 1e-9);
}

TEST_F(ScipTest, ContinuesAfterTheCableWasPulledAndTheLaserSwitchedOff) {
  build(by_tcp(), {.has_baud = false});
  laser_->already_streams(99 * kSecond, 0);
  line_->start(100 * kSecond);
  run_for(kRecoveryS);
  line_->faults.is_pulled = true;
  run_for(10.0);
  EXPECT_FALSE(device_->is_streaming());
  line_->faults.is_pulled = false;
  run_for(kRecoveryS);
  EXPECT_TRUE(device_->is_streaming());
  laser_->power_off();
  run_for(3.0);
  laser_->power_on(line_->now());  // its time begins at zero
  run_for(1.0 + kRecoveryS);
  EXPECT_TRUE(device_->is_streaming());
  judge_times_from_ = line_->now();
  const int before = scans_;
  run_for(20.0);
  EXPECT_NEAR(scans_ - before, 800, 10);
  EXPECT_EQ(wrong_, 0);
  EXPECT_LT(worst_ms_, 2.0);
}

/// A scan of 3,312 bytes is damaged by one or two in three cases of four. A checksum of six bits
/// lets one damaged line in 64 pass, if its characters are such that encode numbers.
TEST_F(ScipTest, PublishesAlmostNothingWrongOfADamagedLine) {
  build(by_tcp(), {.has_baud = false});
  laser_->already_streams(99 * kSecond, 0);
  line_->start(100 * kSecond);
  run_for(kRecoveryS);
  line_->faults.corrupt_share = 0.0004;
  const int before = scans_;
  run_for(120.0);
  line_->faults.corrupt_share = 0.0;
  EXPECT_GT(scans_ - before, 900);
  EXPECT_LT(wrong_, 0.02 * (scans_ - before));
  const int clean = scans_;
  run_for(10.0);
  EXPECT_GT(scans_ - clean, 390);
}

TEST_F(ScipTest, ReportsCodesAsNoReturnOrAsNotMeasured) {
  ScipParams params = by_tcp();
  params.lasers.front.range_max_m = 30.0;
  ScipEmulator laser({.has_baud = false}, [](int, int step) -> std::uint32_t {
    constexpr std::uint32_t kRaw[] = {0, 7, 23, 60000, 65533};
    return step < 5 ? kRaw[step] : 1000U;
  });
  Scip device(params, LaserId::kFront);
  LaserLine line(device, laser);
  laser.already_streams(99 * kSecond, 0);
  line.start(100 * kSecond);
  line.run_until(106 * kSecond, [this](const LaserScan& scan, std::int64_t) { last_ = scan; });
  ASSERT_TRUE(last_);
  EXPECT_FLOAT_EQ(last_->ranges_m[0], 100.0F);
  EXPECT_TRUE(std::isnan(last_->ranges_m[1]));
  EXPECT_FLOAT_EQ(last_->ranges_m[2], 0.023F);
  EXPECT_FLOAT_EQ(last_->ranges_m[3], 60.0F);
  EXPECT_FLOAT_EQ(last_->ranges_m[4], 100.0F);
}

TEST(ScipConfig, ThatCannotBeIsRejectedOrReported) {
  ScipParams params = by_tcp();
  params.angle_min_deg = 10.0;
  params.angle_max_deg = -10.0;
  EXPECT_THROW(Scip(params, LaserId::kFront), std::invalid_argument);
  params = by_tcp();
  params.lasers.rear.range_max_m = 200.0;
  EXPECT_THROW(Scip(params, LaserId::kRear), std::invalid_argument);
  params.lasers.rear.range_max_m = 80.0;
  Scip device(params, LaserId::kRear);
  ScipEmulator laser({.has_baud = false}, reading);
  LaserLine line(device, laser);
  laser.already_streams(99 * kSecond, 0);
  line.start(100 * kSecond);
  line.run_until(106 * kSecond, [](const LaserScan&, std::int64_t) {});
  EXPECT_THAT(device.problem(), HasSubstr("it measures 60 m at most"));
}

}  // namespace
}  // namespace adit
