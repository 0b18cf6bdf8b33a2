// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The processes of drivers with emulated lasers on a pseudo-terminal and by TCP, and LCM.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/live/drivers/live_laser.hpp"
#include "tests/support/lasers/lms_emulator.hpp"
#include "tests/support/lasers/pty_line.hpp"
#include "tests/support/lasers/scip_emulator.hpp"
#include "tests/support/lasers/tcp_laser.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using Level = Health::Level;

constexpr double kStampErrorMaxMs = 10.0;

/// Distances between those that are codes of one of the lasers.
std::uint32_t reading(int scan, int beam) {
  return 30U + static_cast<std::uint32_t>(scan + 37 * beam) % 4000U;
}

TEST(SickLms2xxLive, PublishesScansThroughAllThatHappensToALaser) {
  const test::ScratchFolder folder;
  LmsEmulator laser({.boot_s = 0.5}, [](int scan, int beam) {
    return static_cast<std::uint16_t>(reading(scan, beam));
  });
  PtyLaser<LmsEmulator> line(folder / "laser", laser);
  LiveLaser<LmsEmulator, PtyLaser<LmsEmulator>> live(laser, line, reading, 0.01);
  live.start(ADIT_SICK_LMS2XX, "front",
             fmt::format("sick_lms2xx_front: {{device: {}, baud: 500000}}\n",
                         (folder / "laser").string()));
  ASSERT_TRUE(live.has_health(Level::kFault));
  EXPECT_EQ(live.readings, 0);

  laser.power_on(wall_utime());
  ASSERT_TRUE(live.more_readings_arrive(1));
  ASSERT_TRUE(live.has_health(Level::kOk)) << live.health->reason;
  EXPECT_LT(live.core_share(400), kBusyLoopShare);
  EXPECT_LT(std::abs(live.stamp_error_ms()), kStampErrorMaxMs);

  line.corrupt_share = 0.002;  // half of the telegrams
  ASSERT_TRUE(live.more_readings_arrive(100));
  line.corrupt_share = 0.0;

  laser.power_off();
  ASSERT_TRUE(live.has_health(Level::kFault));
  laser.power_on(wall_utime());
  ASSERT_TRUE(live.more_readings_arrive(100));

  line.line().unplug();
  ASSERT_TRUE(live.has_health(Level::kFault, "laser"));
  line.line().plug();
  ASSERT_TRUE(live.more_readings_arrive(100));
  EXPECT_TRUE(live.has_health(Level::kDegraded, "gaps since the start")) << live.health->reason;

  EXPECT_EQ(live.wrong, 0);
  EXPECT_EQ(live.driver().terminate(), 0);
}

TEST(ScipLive, PublishesScansByTcpAndConnectsAgain) {
  ScipEmulator laser({.has_baud = false, .boot_s = 0.2}, reading);
  laser.power_on(wall_utime());
  TcpLaser<ScipEmulator> line(laser);
  LiveLaser<ScipEmulator, TcpLaser<ScipEmulator>> live(laser, line, reading, 0.001);
  live.start(ADIT_SCIP, "front", fmt::format("scip_front: {{device: \"{}\"}}\n", line.address()));
  ASSERT_TRUE(live.more_readings_arrive(1));
  ASSERT_TRUE(live.has_health(Level::kOk)) << live.health->reason;
  EXPECT_LT(live.core_share(200), kBusyLoopShare);
  EXPECT_LT(std::abs(live.stamp_error_ms()), kStampErrorMaxMs);

  line.disconnect();
  ASSERT_TRUE(live.more_readings_arrive(50));
  laser.power_off();
  ASSERT_TRUE(live.has_health(Level::kFault));
  laser.power_on(wall_utime());
  ASSERT_TRUE(live.more_readings_arrive(50));
  EXPECT_EQ(live.wrong, 0);
  EXPECT_EQ(live.driver().terminate(), 0);
}

/// A tunnel of three metres' width with noise, in centimetres.
std::uint32_t tunnel(int scan, int beam) {
  const double bearing_rad = (beam - 90) * std::numbers::pi / 180.0;
  const double range_m = std::min(20.0, 1.5 / std::max(1e-3, std::abs(std::sin(bearing_rad))));
  return static_cast<std::uint32_t>(100.0 * range_m) + static_cast<std::uint32_t>(scan + beam) % 3;
}

/// Rate, stamps and clock of real messages, by the command that commissions a robot.
TEST(CheckDriverLive, FindsTheDriverOfASickGood) {
  const test::ScratchFolder folder;
  LmsEmulator laser(
      {}, [](int scan, int beam) { return static_cast<std::uint16_t>(tunnel(scan, beam)); });
  laser.already_streams(wall_utime(), 500000);
  PtyLaser<LmsEmulator> line(folder / "laser", laser);
  LiveLaser<LmsEmulator, PtyLaser<LmsEmulator>> live(laser, line, tunnel, 0.01);
  live.start(ADIT_SICK_LMS2XX, "front",
             fmt::format("sick_lms2xx_front: {{device: {}, baud: 500000}}\n",
                         (folder / "laser").string()));
  ASSERT_TRUE(live.more_readings_arrive(50));
  EXPECT_EQ(live.check_driver(ADIT, "LASER_FRONT"), 0);
  EXPECT_EQ(live.driver().terminate(), 0);
}

/// The laser of docs/howto/write_a_driver.md: a line of text ten times a second.
class TextLaser {
 public:
  explicit TextLaser(std::filesystem::path link) : line_(std::move(link)) {}

  PtyLine& line() { return line_; }
  [[nodiscard]] int scans_sent() const { return static_cast<int>(starts_.size()); }
  [[nodiscard]] std::int64_t scan_start(int scan) const {
    return starts_.at(static_cast<std::size_t>(scan));
  }

  void step(std::int64_t utime) {
    constexpr std::int64_t kPeriodUs = 100'000;
    constexpr std::int64_t kScanUs = 50'000;
    if (next_us_ == 0) next_us_ = utime;
    if (utime < next_us_) return;
    starts_.push_back(next_us_ - kScanUs);
    next_us_ += kPeriodUs;
    std::string text;
    for (int beam = 0; beam < 181; ++beam) {
      text += fmt::format("{} ", reading(scans_sent() - 1, beam));
    }
    text += "\n";
    if (line_.is_plugged())
      line_.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }

 private:
  PtyLine line_;
  std::int64_t next_us_ = 0;
  std::vector<std::int64_t> starts_;
};

/// Runs a program of the page, `command` and what follows it.
void run_howto(std::vector<std::string> command) {
  const test::ScratchFolder folder;
  TextLaser laser(folder / "laser");
  LiveLaser<TextLaser, TextLaser> live(laser, laser, reading, 0.001);
  command.insert(command.end(), {(folder / "laser").string(), "LASER_FRONT"});
  live.start(command);
  ASSERT_TRUE(live.more_readings_arrive(20));
  ASSERT_TRUE(live.has_health(Level::kOk));
  EXPECT_LT(std::abs(live.stamp_error_ms()), kStampErrorMaxMs);
  laser.line().unplug();
  ASSERT_TRUE(live.has_health(Level::kFault, "no scans"));
  laser.line().plug();
  ASSERT_TRUE(live.more_readings_arrive(10));
  ASSERT_TRUE(live.has_health(Level::kOk));
  EXPECT_EQ(live.wrong, 0);
  EXPECT_TRUE(live.driver().is_running());
}

TEST(HowToWriteADriver, InCppPublishesScans) { run_howto({HOWTO_CPP}); }

TEST(HowToWriteADriver, InPythonPublishesScans) {
  const char* const kPython = "/usr/bin/python3";
  if (!std::filesystem::exists(kPython)) GTEST_SKIP() << "no python3";
  run_howto({kPython, HOWTO_PYTHON});
}

}  // namespace
}  // namespace adit
