// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/geometry/order_statistics.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/service/wall_time.hpp"
#include "tests/support/lasers/driver_process.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {

/// Share of a core above which a driver runs without waiting. How much it needs is printed and
/// belongs in docs/results/drivers.md: beside other tests it depends on them.
constexpr double kBusyLoopShare = 0.5;

/// The process of a driver with an emulated device in real time, and what it publishes on LCM.
/// `Line` connects both and has `step(utime)`.
template <class Line>
class LiveDriver {
 public:
  explicit LiveDriver(Line& line) : line_(line) {
    subscribe<heartbeat_t>(bus_, channels::kHeartbeat, Delivery::queued(100),
                           [this](const Heartbeat& beat) { health = beat.health; });
  }

  /// Starts the program with a configuration; `device`: its first argument, if it has one.
  void start(const std::string& program, const std::string& device, const std::string& yaml) {
    std::ofstream(folder_ / "robot.yaml") << yaml;
    std::vector<std::string> command{program};
    if (!device.empty()) command.push_back(device);
    command.insert(command.end(), {"--config", (folder_ / "robot.yaml").string()});
    start(command);
  }

  void start(const std::vector<std::string>& command) { driver_.emplace(command); }

  /// Runs the device until something is so, and says whether it became so in 90 s without a pause:
  /// a gap, which a pause of the emulated device causes, is part of the health for 60 s.
  bool run_until(const std::function<bool()>& is_so) {
    constexpr std::int64_t kTimeoutUs = 90'000'000;
    const std::int64_t begin_us = steady_us();
    while (!is_so()) {
      watch_pauses();
      if (steady_us() - std::max(begin_us, paused_us_) > kTimeoutUs) return false;
      line_.step(wall_utime());
      while (bus_.handle(0)) {
      }
      bus_.handle(1);
    }
    return true;
  }

  bool more_readings_arrive(int number) {
    const int until = readings + number;
    return run_until([&] { return readings >= until; });
  }

  bool has_health(Health::Level level, const std::string& reason = {}) {
    return run_until([&] {
      return health && health->level == level && health->reason.find(reason) != std::string::npos;
    });
  }

  /// Share of a processor core that the driver needs for this number of readings.
  double core_share(int number) {
    const double cpu_s = driver_->cpu_s();
    const std::int64_t begin_us = steady_us();
    EXPECT_TRUE(more_readings_arrive(number));
    const double wall_s = 1e-6 * static_cast<double>(steady_us() - begin_us);
    const double share = (driver_->cpu_s() - cpu_s) / wall_s;
    fmt::print("{:.1f} readings per second, {:.2f} % of a core, stamps off by {:.2f} ms\n",
               number / wall_s, 100.0 * share, stamp_error_ms());
    return share;
  }

  /// Runs `adit check-driver` on a channel beside the driver; its exit code. Again when it found a
  /// fault: a pause is a gap of the emulated device, a fault of the driver is there each time, in
  /// three runs without a pause or in ten.
  int check_driver(const std::string& adit, const std::string& channel) {
    int code = 0;
    int without_pause = 0;
    for (int run = 0; run < 10 && without_pause < 3; ++run) {
      const std::int64_t begin_us = steady_us();
      DriverProcess check({adit, "check-driver", channel, "--seconds", "5"});
      EXPECT_TRUE(run_until([&] { return !check.is_running(); }));
      code = check.terminate();
      if (code == 0) break;
      if (paused_us_ < begin_us) ++without_pause;
    }
    return code;
  }

  DriverProcess& driver() { return *driver_; }
  LcmBus& bus() { return bus_; }

  /// Median over the readings so far: on a busy machine the emulator itself is late now and then.
  [[nodiscard]] double stamp_error_ms() const {
    if (stamp_errors_ms_.empty()) return std::numeric_limits<double>::infinity();
    return median(stamp_errors_ms_);
  }

  std::optional<Health> health;
  int readings = 0;
  int wrong = 0;  ///< readings

 protected:
  void add_stamp_error(double error_ms) { stamp_errors_ms_.push_back(error_ms); }

 private:
  /// A machine that is busy or stands still stops the emulated device, too.
  void watch_pauses() {
    constexpr std::int64_t kPauseUs = 100'000;
    const std::int64_t now_us = steady_us();
    if (stepped_us_ > 0 && now_us - stepped_us_ > kPauseUs) paused_us_ = now_us;
    stepped_us_ = now_us;
  }

  test::ScratchFolder folder_;
  Line& line_;
  LcmBus bus_;
  std::optional<DriverProcess> driver_;
  std::vector<double> stamp_errors_ms_;
  std::int64_t stepped_us_ = 0;  ///< last step of the device
  std::int64_t paused_us_ = 0;   ///< end of its last pause
};

}  // namespace adit
