// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/velodyne/velodyne.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/lasers/vlp16_emulator.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kOnUs = 1'000'000'000;
constexpr double kRoomRange = 0.0021;  // half the unit, and that of azimuths of 0.01° at 5 m

/// Ranges in a room in the frame of the lidar, x ahead and y to the left: walls at x = 4 and −3,
/// y = ±2, and none above or below.
double room_m(double x, double y) {
  const double along_m = (x > 0.0 ? 4.0 : 3.0) / std::max(1e-9, std::abs(x));
  return std::min(along_m, 2.0 / std::max(1e-9, std::abs(y)));
}

/// The frame of the manual: y ahead, x to the right.
double surrounding(double x, double y, double /*z*/) { return room_m(y, -x); }

VelodyneParams level_params() {
  VelodyneParams params;
  params.decimation = 1;
  params.lasers.count = 1;
  params.lasers.front.range_max_m = 100.0;
  params.lasers.front.timing = {.mirror_hz = 20.0, .mirror_turns = 1};
  params.lasers.lidar.present = true;
  return params;
}

/// A lidar that is connected with its driver in simulated time.
class Connection {
 public:
  explicit Connection(const Vlp16Emulator::Model& model = {},
                      const VelodyneParams& params = level_params())
      : lidar(model, surrounding), driver(params, LaserId::kFront) {
    lidar.power_on(now_us_);
    driver.start(now_us_);
  }

  /// Runs both; `passes`: whether a packet, which it may change, arrives.
  void run(
      double seconds,
      const std::function<bool(std::vector<std::uint8_t>&)>& passes = [](auto&) { return true; }) {
    const std::int64_t end_us = now_us_ + std::llround(1e6 * seconds);
    for (; now_us_ < end_us; now_us_ += 1000) {
      for (auto& [arrival_us, bytes] : lidar.advance(now_us_)) {
        if (!passes(bytes)) continue;
        const std::int64_t late_us = late(random_) < 0.02 ? 5000 : 0;
        for (LaserScan& scan :
             driver.receive(bytes, std::max(arrival_us, now_us_ - 900) + late_us)) {
          scans.push_back(std::move(scan));
          arrivals_us.push_back(arrival_us);
        }
        for (auto& revolution : driver.take_revolutions()) {
          revolutions.push_back(std::move(revolution));
        }
      }
      driver.tick(now_us_);
    }
  }

  Vlp16Emulator lidar;
  Velodyne driver;
  std::vector<LaserScan> scans;
  std::vector<std::int64_t> arrivals_us;  ///< of the packet that completes each
  std::vector<LidarRevolution> revolutions;

 private:
  std::int64_t now_us_ = kOnUs;
  std::mt19937_64 random_{5};
  std::uniform_real_distribution<double> late{0.0, 1.0};
};

/// Distance of the worst return from the walls of the room.
double worst_m(const LidarRevolution& revolution) {
  double worst = 0.0;
  for (std::size_t column = 0; column < revolution.columns.size(); ++column) {
    for (std::size_t ring = 0; ring < revolution.rings.size(); ++ring) {
      const Eigen::Vector3d d = revolution.direction(column, ring);
      const Eigen::Vector3d p = revolution.range_m(column, ring) * d;
      const double to_walls =
          std::min({std::abs(p.x() - 4.0), std::abs(p.x() + 3.0), std::abs(std::abs(p.y()) - 2.0)});
      worst = std::max(worst, to_walls);
    }
  }
  return worst;
}

int wrong_beams(const LaserScan& scan) {
  int wrong = 0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double bearing = scan.angle_min_rad + static_cast<double>(i) * scan.angle_step_rad;
    const double true_m = room_m(std::cos(bearing), std::sin(bearing));
    // Not NaN: a beam whose packet is missing is no wrong one.
    if (std::abs(scan.ranges_m[i] - true_m) > 0.01) ++wrong;
  }
  return wrong;
}

constexpr int kCornerBeams = 8;  // two at each corner, between two walls

class VelodyneInMode : public testing::TestWithParam<Vlp16Emulator::Model> {};

TEST_P(VelodyneInMode, PutsEveryReturnOnTheWalls) {
  Vlp16Emulator::Model model = GetParam();
  VelodyneParams params = level_params();
  params.lasers.front.timing.mirror_hz = model.rpm / 60.0;
  Connection connection(model, params);
  connection.run(2.0);
  const double turns = (2.0 - model.boot_s) * model.rpm / 60.0;
  EXPECT_NEAR(static_cast<double>(connection.revolutions.size()), turns, 2.0);
  for (const LidarRevolution& revolution : connection.revolutions) {
    EXPECT_NEAR(static_cast<double>(revolution.columns.size()), 60e6 / model.rpm / 55.296, 2.0);
    ASSERT_LT(worst_m(revolution), kRoomRange);
  }
  for (const LaserScan& scan : connection.scans) ASSERT_LE(wrong_beams(scan), kCornerBeams);
  EXPECT_EQ(connection.driver.problem(), "");
  EXPECT_EQ(connection.driver.line_counts().corrupt, 0);
}

INSTANTIATE_TEST_SUITE_P(Velodyne, VelodyneInMode,
                         testing::Values(Vlp16Emulator::Model{}, Vlp16Emulator::Model{.rpm = 600.0},
                                         Vlp16Emulator::Model{.rpm = 300.0},
                                         Vlp16Emulator::Model{.return_mode = 0x38},
                                         Vlp16Emulator::Model{.return_mode = 0x39},
                                         Vlp16Emulator::Model{.first_stamp_us = 3'599'000'000U}));

/// The true time of the first column is its stamp by the clock of the test.
TEST(Velodyne, StampsTheFirstColumn) {
  for (const double rate : {1.0, 1.0001, 0.9999}) {
    Vlp16Emulator::Model model;
    model.clock_rate = rate;
    Connection connection(model);
    connection.run(20.0);
    double worst_us = 0.0;
    for (std::size_t i = 40; i < connection.revolutions.size(); ++i) {
      // The head crosses straight behind each 50 ms; at the start it looked 77° to the right.
      const double to_seam_us = (180.0 - 77.0) / 360.0 * 50'000.0;
      const double since_us =
          static_cast<double>(connection.revolutions[i].utime - kOnUs) - 1e6 * model.boot_s;
      const double off_us = std::remainder(since_us - to_seam_us, 50'000.0);
      worst_us = std::max(worst_us, std::abs(off_us - 0.5 * 55.296));
    }
    EXPECT_LT(worst_us, 300.0) << rate;
  }
}

TEST(Velodyne, PublishesEachNthRevolution) {
  VelodyneParams params = level_params();
  params.decimation = 4;
  Connection connection({}, params);
  connection.run(2.0);
  EXPECT_NEAR(4.0 * static_cast<double>(connection.revolutions.size()),
              static_cast<double>(connection.scans.size()), 4.0);
}

TEST(Velodyne, CountsLostPacketsAndHasNoReadingThere) {
  Connection connection;
  std::mt19937_64 random(3);
  connection.run(20.0, [&](auto&) { return random() % 100 != 0; });
  EXPECT_NEAR(static_cast<double>(connection.scans.size()), 395.0, 4.0);
  for (const LaserScan& scan : connection.scans) ASSERT_LE(wrong_beams(scan), kCornerBeams);
  const auto counts = connection.driver.line_counts();
  EXPECT_NEAR(static_cast<double>(counts.corrupt) / static_cast<double>(counts.messages), 0.01,
              0.003);
  const auto has_gap = [](const LaserScan& scan) {
    return std::ranges::any_of(scan.ranges_m, [](float r) { return std::isnan(r); });
  };
  EXPECT_GT(std::ranges::count_if(connection.scans, has_gap), 80);  // a third of them
}

TEST(Velodyne, RejectsDamagedPackets) {
  Connection connection;
  std::mt19937_64 random(3);
  // Of each second packet a byte of flag, azimuth, stamp, mode or product, or of its length.
  connection.run(5.0, [&](std::vector<std::uint8_t>& bytes) {
    if (random() % 50 != 0) return true;
    const std::vector<std::size_t> places{0, 1, 100, 503, 1103, 1203, 1204, 1205};
    const std::size_t place = random() % (places.size() + 1);
    if (place < places.size()) {
      bytes[places[place]] ^= 0xF1U;
    } else {
      bytes.resize(random() % 3000);
    }
    return true;
  });
  EXPECT_NEAR(static_cast<double>(connection.scans.size()), 95.0, 4.0);
  for (const LidarRevolution& revolution : connection.revolutions) {
    ASSERT_LT(worst_m(revolution), kRoomRange);
  }
  EXPECT_GT(connection.driver.line_counts().corrupt, 40);
}

TEST(Velodyne, ContinuesAfterAPauseAndAfterARestart) {
  Connection connection;
  connection.run(2.0);
  connection.run(10.0, [](auto&) { return false; });
  EXPECT_THAT(connection.driver.problem(), HasSubstr("no data packets"));
  std::size_t scans = connection.scans.size();
  connection.run(1.0);
  EXPECT_GE(connection.scans.size(), scans + 18);
  connection.lidar.power_off();
  connection.run(3.0);
  EXPECT_FALSE(connection.driver.is_streaming());
  scans = connection.scans.size();
  connection.lidar.power_on(kOnUs + 16'000'000);
  connection.run(1.2);  // and boots
  EXPECT_GE(connection.scans.size(), scans + 17);
  for (std::size_t i = 1; i < connection.scans.size(); ++i) {
    ASSERT_GT(connection.scans[i].utime, connection.scans[i - 1].utime);
    const std::int64_t age_us = connection.arrivals_us[i] - connection.scans[i].utime;
    ASSERT_NEAR(static_cast<double>(age_us), 51'000.0, 2'000.0) << i;
    ASSERT_LE(wrong_beams(connection.scans[i]), kCornerBeams) << i;
  }
}

TEST(Velodyne, FollowsAClockThatIsSet) {
  Connection connection;
  connection.run(2.0);
  connection.lidar.set_stamp(3'000'000'000U);
  const std::size_t scans = connection.scans.size();
  connection.run(2.0);
  EXPECT_GE(connection.scans.size(), scans + 37);
  const std::int64_t age_us = connection.arrivals_us.back() - connection.scans.back().utime;
  EXPECT_NEAR(static_cast<double>(age_us), 51'000.0, 2'000.0);
}

TEST(Velodyne, SaysThatItTurnsAtAnotherRate) {
  Connection connection;
  connection.run(1.0);
  connection.lidar.set_rpm(600.0);
  connection.run(1.0);
  EXPECT_THAT(connection.driver.problem(), HasSubstr("mirror_hz = 20 is 1200"));
}

TEST(Velodyne, NamesAProductThatItDoesNotKnow) {
  Vlp16Emulator::Model model;
  model.product = 0x28;
  Connection connection(model);
  connection.run(1.0);
  EXPECT_TRUE(connection.scans.empty());
  EXPECT_THAT(connection.driver.problem(), HasSubstr("another product"));
}

TEST(Velodyne, NeedsTheDescriptionOfASpinningLidar) {
  VelodyneParams params = level_params();
  EXPECT_THROW(Velodyne(params, LaserId::kRear), std::invalid_argument);
  params.lasers.lidar.present = false;
  EXPECT_THROW(Velodyne(params, LaserId::kFront), std::invalid_argument);
}

}  // namespace
}  // namespace adit
