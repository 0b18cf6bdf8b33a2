// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The process of the driver of a spinning lidar with an emulated one by UDP, and LCM.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/lidar.hpp"
#include "common/messages/sensing.hpp"
#include "common/service/wall_time.hpp"
#include "tests/support/lasers/driver_process.hpp"
#include "tests/support/lasers/udp_sender.hpp"
#include "tests/support/lasers/vlp16_emulator.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using Level = Health::Level;

constexpr std::uint16_t kPort = 2368;   // of a network of its own
constexpr double kBusyLoopShare = 0.5;  // of a core

/// A tunnel of 3 m width along y of the manual, ahead; 50 m long.
double tunnel_m(double x, double y, double /*z*/) {
  return std::min(1.5 / std::max(1e-9, std::abs(x)), 25.0 / std::max(1e-9, std::abs(y)));
}

class LiveVelodyne {
 public:
  LiveVelodyne() {
    subscribe<planar_lidar_t>(bus_, channels::kLaserFront, Delivery::queued(100),
                              [this](const LaserScan& scan) { check(scan); });
    subscribe<spinning_lidar_t>(bus_, channels::kLidar, Delivery::queued(100),
                                [this](const LidarFragment& fragment) {
                                  revolutions += reassembler_.add(fragment) ? 1 : 0;
                                });
    subscribe<heartbeat_t>(bus_, channels::kHeartbeat, Delivery::queued(100),
                           [this](const Heartbeat& beat) { health = beat.health; });
  }

  void start() {
    std::ofstream(folder_ / "robot.yaml") << "lasers: {count: 1, front: {timing: {mirror_hz: 20, "
                                             "turns: 1}}, lidar: {present: true}}\n"
                                             "velodyne_front: {device: \"udp://127.0.0.1:2368\"}\n";
    driver_.emplace(std::vector<std::string>{ADIT_VELODYNE, "front", "--config",
                                             (folder_ / "robot.yaml").string()});
  }

  /// Runs the lidar until something is so, and says whether it became so in 30 s.
  bool run_until(const std::function<bool()>& is_so) {
    constexpr std::int64_t kTimeoutUs = 30'000'000;
    const std::int64_t begin_us = steady_us();
    while (!is_so()) {
      if (steady_us() - begin_us > kTimeoutUs) return false;
      for (auto& packet : lidar.advance(wall_utime())) {
        const bool is_lost = random_() % 1000 < static_cast<unsigned>(1000.0 * lost_share);
        const bool is_damaged = random_() % 1000 < static_cast<unsigned>(1000.0 * damaged_share);
        if (is_damaged) packet.bytes[random_() % 4] ^= 0xFFU;
        if (!is_lost) sender_.send(packet.bytes);
      }
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
  bool has_health(Level level, const std::string& reason = {}) {
    return run_until([&] {
      return health && health->level == level && health->reason.find(reason) != std::string::npos;
    });
  }
  /// Nothing is sent for a time.
  bool pause(double seconds) {
    const std::int64_t end_us = steady_us() + std::llround(1e6 * seconds);
    const double before = lost_share;
    lost_share = 1.0;
    const bool done = run_until([&] { return steady_us() >= end_us; });
    lost_share = before;
    return done;
  }

  DriverProcess& driver() { return *driver_; }

  Vlp16Emulator lidar{{}, tunnel_m};
  double lost_share = 0.0;
  double damaged_share = 0.0;
  std::optional<Health> health;
  int scans = 0;
  int wrong = 0;
  int revolutions = 0;
  /// Of the scan that was youngest when it was received: beside other tests some wait.
  double age_ms = std::numeric_limits<double>::infinity();

 private:
  void check(const LaserScan& scan) {
    ++scans;
    age_ms = std::min(age_ms, 1e-3 * static_cast<double>(wall_utime() - scan.utime));
    int wrong_beams = 0;
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const double bearing = scan.angle_min_rad + static_cast<double>(i) * scan.angle_step_rad;
      const double true_m = tunnel_m(-std::sin(bearing), std::cos(bearing), 0.0);
      if (true_m < 5.0 && std::abs(scan.ranges_m[i] - true_m) > 0.03) ++wrong_beams;
    }
    wrong += wrong_beams > 0 ? 1 : 0;
  }

  test::ScratchFolder folder_;
  UdpSender sender_{kPort};
  LidarReassembler reassembler_;
  std::mt19937 random_{7};
  LcmBus bus_;
  std::optional<DriverProcess> driver_;
};

TEST(VelodyneLive, PublishesScansThroughAllThatHappensToALidar) {
  LiveVelodyne live;
  live.lidar.power_on(wall_utime() - 1'000'000);
  live.lidar.advance(wall_utime());  // it streams already
  live.start();
  ASSERT_TRUE(live.more_scans_arrive(1));
  ASSERT_TRUE(live.has_health(Level::kOk)) << live.health->reason;

  const double cpu_s = live.driver().cpu_s();
  const std::int64_t begin_us = steady_us();
  const int revolutions = live.revolutions;
  ASSERT_TRUE(live.more_scans_arrive(200));
  const double wall_s = 1e-6 * static_cast<double>(steady_us() - begin_us);
  const double share = (live.driver().cpu_s() - cpu_s) / wall_s;
  fmt::print("{:.1f} scans per second, {:.2f} % of a core, {:.1f} ms old\n", 200 / wall_s,
             100.0 * share, live.age_ms);
  EXPECT_LT(share, kBusyLoopShare);
  EXPECT_NEAR(live.revolutions - revolutions, 50, 3);
  EXPECT_LT(live.age_ms, 100.0);  // 50 ms of the revolution itself

  DriverProcess check({ADIT, "check-driver", "LIDAR", "--seconds", "5"});
  EXPECT_TRUE(live.run_until([&] { return !check.is_running(); }));
  EXPECT_EQ(check.terminate(), 0);

  live.lost_share = 0.01;
  ASSERT_TRUE(live.more_scans_arrive(40));
  live.lost_share = 0.0;
  live.damaged_share = 0.05;
  ASSERT_TRUE(live.has_health(Level::kDegraded, "damaged")) << live.health->reason;
  live.damaged_share = 0.0;
  ASSERT_TRUE(live.more_scans_arrive(40));

  ASSERT_TRUE(live.pause(10.0));
  EXPECT_EQ(live.health->level, Level::kFault) << live.health->reason;
  ASSERT_TRUE(live.more_scans_arrive(40));
  EXPECT_TRUE(live.has_health(Level::kDegraded, "gaps since the start")) << live.health->reason;

  live.lidar.power_off();
  ASSERT_TRUE(live.has_health(Level::kFault, "no data packets"));
  live.lidar.power_on(wall_utime());
  ASSERT_TRUE(live.more_scans_arrive(40));
  EXPECT_EQ(live.wrong, 0);
  EXPECT_EQ(live.driver().terminate(), 0);
}

}  // namespace
}  // namespace adit
