// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The process adit-sick_lms2xx with an emulated laser on a pseudo-terminal, and LCM.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/sensing.hpp"
#include "common/service/wall_time.hpp"
#include "tests/support/lasers/driver_process.hpp"
#include "tests/support/lasers/lms_emulator.hpp"
#include "tests/support/lasers/pty_line.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

constexpr int kBeams = 181;
constexpr int kReadings = 8000;
constexpr double kTimeoutS = 30.0;

std::uint16_t reading(int scan, int beam) {
  return static_cast<std::uint16_t>((scan + 37 * beam) % kReadings);
}

class SickLms2xxLive : public testing::Test {
 protected:
  SickLms2xxLive() : laser_({.boot_s = 0.5}, reading), pty_(folder_.path() / "laser", laser_) {
    std::ofstream(folder_.path() / "robot.yaml")
        << "sick_lms2xx_front: {device: " << (folder_.path() / "laser").string()
        << ", baud: 500000}\n";
    subscribe<planar_lidar_t>(bus_, channels::kLaserFront, Delivery::queued(1000),
                              [this](const LaserScan& scan) { check(scan); });
    subscribe<heartbeat_t>(bus_, channels::kHeartbeat, Delivery::queued(100),
                           [this](const Heartbeat& beat) {
                             if (beat.stage == "sick_lms2xx_front") health_ = beat.health;
                           });
  }

  void start_driver() {
    driver_.emplace(std::vector<std::string>{ADIT_SICK_LMS2XX, "front", "--config",
                                             (folder_.path() / "robot.yaml").string()});
  }

  void check(const LaserScan& scan) {
    ++scans_;
    const int first = static_cast<int>(std::lround(scan.ranges_m[0] * 100.0F));
    int number = laser_.scans_sent() - 1;
    while (number > 0 && number % kReadings != first) --number;
    bool right = static_cast<int>(scan.ranges_m.size()) == kBeams && number % kReadings == first;
    for (int beam = 0; right && beam < kBeams; ++beam) {
      right = scan.ranges_m[static_cast<std::size_t>(beam)] ==
              static_cast<float>(reading(number, beam) * 0.01);
    }
    wrong_ += right ? 0 : 1;
    if (right) stamp_error_ms_ = 1e-3 * static_cast<double>(scan.utime - laser_.scan_start(number));
  }

  /// Runs the laser until something is so, and says whether it became so in time.
  bool run_until(const std::function<bool()>& is_so, double timeout_s = kTimeoutS) {
    const std::int64_t begin_us = steady_us();
    while (!is_so()) {
      if (static_cast<double>(steady_us() - begin_us) > 1e6 * timeout_s) return false;
      pty_.step(wall_utime());
      while (bus_.handle(0)) {
      }
      bus_.handle(1);
    }
    return true;
  }

  void run_for(double seconds) {
    run_until([] { return false; }, seconds);
  }

  bool more_scans_arrive(int number) {
    const int until = scans_ + number;
    return run_until([&] { return scans_ >= until; });
  }

  test::ScratchFolder folder_;
  LmsEmulator laser_;
  PtyLaser<LmsEmulator> pty_;
  LcmBus bus_;
  std::optional<DriverProcess> driver_;
  std::optional<Health> health_;
  int scans_ = 0;
  int wrong_ = 0;
  double stamp_error_ms_ = 0.0;
};

TEST_F(SickLms2xxLive, PublishesScansThroughAllThatHappensToALaser) {
  start_driver();
  ASSERT_TRUE(run_until([&] { return health_ && health_->level == Health::Level::kFault; }));
  EXPECT_EQ(scans_, 0);

  laser_.power_on(wall_utime());
  ASSERT_TRUE(more_scans_arrive(1));
  ASSERT_TRUE(run_until([&] { return health_ && health_->level == Health::Level::kOk; }))
      << health_->reason;
  const double cpu_s = driver_->cpu_s();
  const std::int64_t begin_us = steady_us();
  const int before = scans_;
  ASSERT_TRUE(more_scans_arrive(600));
  const double wall_s = 1e-6 * static_cast<double>(steady_us() - begin_us);
  const double core = (driver_->cpu_s() - cpu_s) / wall_s;
  std::printf("%.1f scans per second, %.2f %% of a core, stamps off by %.2f ms\n",
              (scans_ - before) / wall_s, 100.0 * core, stamp_error_ms_);
  EXPECT_LT(core, 0.03);
  EXPECT_LT(std::abs(stamp_error_ms_), 10.0);  // on a busy machine the emulator itself is late

  pty_.corrupt_share = 0.002;  // half of the telegrams
  ASSERT_TRUE(more_scans_arrive(100));
  pty_.corrupt_share = 0.0;

  laser_.power_off();
  ASSERT_TRUE(run_until([&] { return health_->level == Health::Level::kFault; }));
  laser_.power_on(wall_utime());
  ASSERT_TRUE(more_scans_arrive(100));

  pty_.line().unplug();
  ASSERT_TRUE(run_until([&] { return health_->level == Health::Level::kFault; }));
  EXPECT_THAT(health_->reason, testing::HasSubstr("laser"));
  pty_.line().plug();
  ASSERT_TRUE(more_scans_arrive(100));
  // At first the damaged bytes are reported, for ten seconds.
  EXPECT_TRUE(run_until([&] {
    return health_->reason.find("gaps since the start") != std::string::npos;
  })) << health_->reason;

  EXPECT_EQ(wrong_, 0);
  EXPECT_TRUE(driver_->is_running());
  EXPECT_EQ(driver_->terminate(), 0);
}

}  // namespace
}  // namespace adit
