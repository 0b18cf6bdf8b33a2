// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/sensing.hpp"
#include "common/service/wall_time.hpp"
#include "tests/support/lasers/driver_process.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {

/// The process of a driver with an emulated laser in real time, and what it publishes on LCM.
/// `Line` connects both and has `step(utime)`.
template <class Emulator, class Line>
class LiveLaser {
 public:
  /// Distance in units of a beam of a scan.
  using Reading = std::function<std::uint32_t(int scan, int beam)>;

  LiveLaser(Emulator& laser, Line& line, Reading reading, double unit_m)
      : laser_(laser), line_(line), reading_(std::move(reading)), unit_m_(unit_m) {
    subscribe<planar_lidar_t>(bus_, channels::kLaserFront, Delivery::queued(1000),
                              [this](const LaserScan& scan) { check(scan); });
    subscribe<heartbeat_t>(bus_, channels::kHeartbeat, Delivery::queued(100),
                           [this](const Heartbeat& beat) { health = beat.health; });
  }

  /// Starts the program for the front laser, with a configuration.
  void start(const std::string& program, const std::string& yaml) {
    std::ofstream(folder_ / "robot.yaml") << yaml;
    start({program, "front", "--config", (folder_ / "robot.yaml").string()});
  }

  void start(const std::vector<std::string>& command) { driver_.emplace(command); }

  /// Runs the laser until something is so, and says whether it became so in 30 s.
  bool run_until(const std::function<bool()>& is_so) {
    constexpr std::int64_t kTimeoutUs = 30'000'000;
    const std::int64_t begin_us = steady_us();
    while (!is_so()) {
      if (steady_us() - begin_us > kTimeoutUs) return false;
      line_.step(wall_utime());
      while (bus_.handle(0)) {
      }
      bus_.handle(1);
    }
    return true;
  }

  bool more_scans_arrive(int number) {
    const int until = scans + number;
    return run_until([&] { return scans >= until; });
  }

  bool has_health(Health::Level level, const std::string& reason = {}) {
    return run_until([&] {
      return health && health->level == level && health->reason.find(reason) != std::string::npos;
    });
  }

  /// Share of a processor core that the driver needs for this number of scans.
  double core_share(int number) {
    const double cpu_s = driver_->cpu_s();
    const std::int64_t begin_us = steady_us();
    EXPECT_TRUE(more_scans_arrive(number));
    const double wall_s = 1e-6 * static_cast<double>(steady_us() - begin_us);
    const double share = (driver_->cpu_s() - cpu_s) / wall_s;
    fmt::print("{:.1f} scans per second, {:.2f} % of a core, stamps off by {:.2f} ms\n",
               number / wall_s, 100.0 * share, stamp_error_ms);
    return share;
  }

  DriverProcess& driver() { return *driver_; }

  std::optional<Health> health;
  int scans = 0;
  int wrong = 0;
  double stamp_error_ms = 0.0;  ///< of the last scan

 private:
  void check(const LaserScan& scan) {
    ++scans;
    const auto raw_of = [&](std::size_t beam) {
      return static_cast<std::uint32_t>(std::lround(scan.ranges_m[beam] / unit_m_));
    };
    int number = laser_.scans_sent() - 1;
    while (number > 0 && reading_(number, 0) != raw_of(0)) --number;
    bool right = number >= 0;
    for (std::size_t beam = 0; right && beam < scan.ranges_m.size(); ++beam) {
      right = raw_of(beam) == reading_(number, static_cast<int>(beam));
    }
    wrong += right ? 0 : 1;
    if (right) stamp_error_ms = 1e-3 * static_cast<double>(scan.utime - laser_.scan_start(number));
  }

  test::ScratchFolder folder_;
  Emulator& laser_;
  Line& line_;
  Reading reading_;
  double unit_m_;
  LcmBus bus_;
  std::optional<DriverProcess> driver_;
};

}  // namespace adit
