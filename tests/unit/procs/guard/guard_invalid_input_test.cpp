// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Whatever is said: the guard stands or lets drive, and says why.
#include <array>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tests/unit/procs/guard/healthy_robot.hpp"

namespace adit {
namespace {

constexpr double kMax = std::numeric_limits<double>::max();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Finite numbers, as the conversion of messages accepts.
constexpr std::array kNumbers{0.0, -0.0, 0.3, -0.3, 1e-300, 12.0, -1e9, kMax, -kMax};
constexpr std::array kRanges{kNan, kInfinity, -kInfinity, 0.0F, -1.0F, 0.3F, 0.9F, 5.0F, 3e38F};

class RandomInput {
 public:
  explicit RandomInput(std::uint32_t seed) : random_(seed) {}

  double number() { return kNumbers.at(random_() % kNumbers.size()); }
  std::int64_t utime(std::int64_t now) {
    const std::array<std::int64_t, 5> utimes{now, now - 30'000, 0, now + 1'000'000'000,
                                             9'999'999'999'999'999};
    return utimes.at(random_() % (random_() % 4 == 0 ? utimes.size() : 2));
  }
  LaserScan scan(std::int64_t now) {
    LaserScan scan{utime(now), {}, number(), std::abs(number())};
    scan.ranges_m.resize(random_() % 400);
    for (float& range_m : scan.ranges_m) range_m = kRanges.at(random_() % kRanges.size());
    return scan;
  }
  Eigen::Vector3d vector() { return {number(), number(), number()}; }
  LaserId laser() { return random_() % 2 == 0 ? LaserId::kFront : LaserId::kRear; }

  void send(Guard& guard, std::int64_t now) {
    const std::int64_t at = utime(now);
    switch (random_() % 9) {
      case 0:
        return guard.receive(laser(), scan(now), now);
      case 1:
        return guard.receive(laser(), TiltReading{at, number(), 0.0}, now);
      case 2:
        return guard.receive(DriveCommand{at, number(), number()}, now);
      case 3:
        return guard.receive(VehicleState{at, number(), number(), 1.0, false, false}, now);
      case 4:
        return guard.receive(ImuReading{at, vector(), vector()}, now);
      case 5:
        return guard.receive(GasReading{at, 0.0, 0.2, 0.0}, now);
      case 6:
        return guard.receive(SinkageReading{at, {0.0, 0.0, 0.0, std::abs(number())}}, now);
      case 7:
        return guard.receive_pose({number(), number(), number()}, at, now);
      default:
        return guard.receive_supervisor(at, now);
    }
  }

 private:
  std::mt19937 random_;
};

TEST(GuardInvalidInput, YieldsAConsistentOrder) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    Guard guard(groundhog_guard());
    RandomInput input(seed);
    std::int64_t now = HealthyRobot::kStart;
    for (int i = 0; i < 2000; ++i) {
      now += i % 500 == 499 ? -3'600'000'000 : 7'000;
      input.send(guard, now);
      const StopOrder order = guard.evaluate(now);
      EXPECT_EQ(order.utime, now);
      EXPECT_EQ(order.stopped, !order.reason.empty());
      EXPECT_TRUE(order.stopped || guard.reasons().empty());
      EXPECT_LT(order.reason.size(), 1000U);
    }
  }
}

}  // namespace
}  // namespace adit
