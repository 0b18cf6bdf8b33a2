// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The processes of drivers with emulated lasers on a pseudo-terminal and by TCP, and LCM.
#include <cmath>
#include <cstdint>
#include <string>

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

constexpr double kCoreShareMax = 0.03;

// On a busy machine the emulator itself is late.
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
  live.start(ADIT_SICK_LMS2XX, fmt::format("sick_lms2xx_front: {{device: {}, baud: 500000}}\n",
                                           (folder / "laser").string()));
  ASSERT_TRUE(live.has_health(Level::kFault));
  EXPECT_EQ(live.scans, 0);

  laser.power_on(wall_utime());
  ASSERT_TRUE(live.more_scans_arrive(1));
  ASSERT_TRUE(live.has_health(Level::kOk)) << live.health->reason;
  EXPECT_LT(live.core_share(400), kCoreShareMax);
  EXPECT_LT(std::abs(live.stamp_error_ms), kStampErrorMaxMs);

  line.corrupt_share = 0.002;  // half of the telegrams
  ASSERT_TRUE(live.more_scans_arrive(100));
  line.corrupt_share = 0.0;

  laser.power_off();
  ASSERT_TRUE(live.has_health(Level::kFault));
  laser.power_on(wall_utime());
  ASSERT_TRUE(live.more_scans_arrive(100));

  line.line().unplug();
  ASSERT_TRUE(live.has_health(Level::kFault, "laser"));
  line.line().plug();
  ASSERT_TRUE(live.more_scans_arrive(100));
  EXPECT_TRUE(live.has_health(Level::kDegraded, "gaps since the start")) << live.health->reason;

  EXPECT_EQ(live.wrong, 0);
  EXPECT_EQ(live.driver().terminate(), 0);
}

TEST(ScipLive, PublishesScansByTcpAndConnectsAgain) {
  ScipEmulator laser({.has_baud = false, .boot_s = 0.2}, reading);
  laser.power_on(wall_utime());
  TcpLaser<ScipEmulator> line(laser);
  LiveLaser<ScipEmulator, TcpLaser<ScipEmulator>> live(laser, line, reading, 0.001);
  live.start(ADIT_SCIP, fmt::format("scip_front: {{device: \"{}\"}}\n", line.address()));
  ASSERT_TRUE(live.more_scans_arrive(1));
  ASSERT_TRUE(live.has_health(Level::kOk)) << live.health->reason;
  EXPECT_LT(live.core_share(200), kCoreShareMax);
  EXPECT_LT(std::abs(live.stamp_error_ms), kStampErrorMaxMs);

  line.disconnect();
  ASSERT_TRUE(live.more_scans_arrive(50));
  laser.power_off();
  ASSERT_TRUE(live.has_health(Level::kFault));
  laser.power_on(wall_utime());
  ASSERT_TRUE(live.more_scans_arrive(50));
  EXPECT_EQ(live.wrong, 0);
  EXPECT_EQ(live.driver().terminate(), 0);
}

}  // namespace
}  // namespace adit
