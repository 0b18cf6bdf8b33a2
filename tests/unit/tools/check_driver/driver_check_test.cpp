// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check_driver/driver_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <ostream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/messages/codec.hpp"
#include "common/messages/sensing.hpp"
#include "tests/unit/tools/check_driver/bad_results.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using Verdict = CheckResult::Verdict;

constexpr std::int64_t kStartUs = 1'700'000'000'000'000;
constexpr std::int64_t kPeriodUs = 26'667;
constexpr std::int64_t kLatencyUs = 30'000;
constexpr double kYawRate = 0.4;  // [rad/s], to the left
constexpr double kRangeMaxM = 80.0;

/// Range in a room of 8 by 5 metres with a pillar, from its middle.
double range_at(double bearing_rad) {
  const double c = std::cos(bearing_rad);
  const double s = std::sin(bearing_rad);
  const double wall =
      std::min(4.0 / std::max(1e-9, std::abs(c)), 2.5 / std::max(1e-9, std::abs(s)));
  const bool pillar = std::abs(std::remainder(bearing_rad - 0.7, 2.0 * std::numbers::pi)) < 0.1;
  return pillar ? 1.5 : wall;
}

/// Scans of a good driver on a vehicle that turns.
std::vector<LaserScan> good_scans() {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.005);
  std::vector<LaserScan> scans;
  for (int i = 0; i < 200; ++i) {
    LaserScan scan{kStartUs + i * kPeriodUs, {}, -std::numbers::pi / 2.0, std::numbers::pi / 360.0};
    const double yaw = kYawRate * 1e-6 * static_cast<double>(i * kPeriodUs);
    for (int beam = 0; beam <= 360; ++beam) {
      const double bearing = scan.angle_min_rad + beam * scan.angle_step_rad;
      scan.ranges_m.push_back(static_cast<float>(range_at(yaw + bearing) + noise(random)));
    }
    scans.push_back(scan);
  }
  return scans;
}

void add_imu(DriverCheck& check, double sign = 1.0) {
  for (std::int64_t utime = kStartUs - 50'000; utime < kStartUs + 6'000'000; utime += 10'000) {
    ImuReading reading{utime, {0.0, 0.0, sign * kYawRate}, {0.0, 0.0, 9.81}};
    check.add("IMU", encode(to_message(reading)), utime + 1000);
  }
}

CheckResults results_of(const std::vector<LaserScan>& scans, double imu_sign = 1.0,
                        std::int64_t latency_us = kLatencyUs) {
  DriverCheck check("LASER_FRONT", kRangeMaxM);
  add_imu(check, imu_sign);
  std::int64_t arrival = 0;
  for (const LaserScan& scan : scans) {
    arrival = std::max(arrival, scan.utime + latency_us);
    check.add("LASER_FRONT", encode(to_message(scan)), arrival);
  }
  return check.results();
}

const CheckResult& result_of(const CheckResults& results, const std::string& property) {
  return *std::ranges::find(results, property, &CheckResult::property);
}

TEST(DriverCheck, FindsAGoodLaserGood) {
  const CheckResults results = results_of(good_scans());
  EXPECT_THAT(bad(results), testing::IsEmpty());
  EXPECT_TRUE(all_are_good(results));
  EXPECT_EQ(result_of(results, "sign").verdict, Verdict::kGood);
  EXPECT_THAT(text_of("LASER_FRONT", results), HasSubstr("LASER_FRONT is what the stages need\n"));
}

struct Mistake {
  std::string name;
  std::function<void(std::vector<LaserScan>&)> make;
  std::string property;  ///< that is found bad
  std::string remedy;
  std::int64_t latency_us = kLatencyUs;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class MistakesOfLasers : public testing::TestWithParam<Mistake> {};

TEST_P(MistakesOfLasers, AreFoundWithTheirRemedy) {
  std::vector<LaserScan> scans = good_scans();
  GetParam().make(scans);
  const CheckResults results = results_of(scans, 1.0, GetParam().latency_us);
  const auto lines = bad(results);
  EXPECT_THAT(lines,
              testing::Contains(testing::AllOf(testing::StartsWith(GetParam().property + ":"),
                                               HasSubstr(GetParam().remedy))));
  EXPECT_LE(lines.size(), 2U) << testing::PrintToString(lines);  // one mistake, no flood
}

void for_each_scan(std::vector<LaserScan>& scans, const std::function<void(LaserScan&)>& change) {
  for (LaserScan& scan : scans) change(scan);
}

const Mistake kMistakes[] = {
    {"Clockwise",
     [](auto& scans) { for_each_scan(scans, [](auto& s) { std::ranges::reverse(s.ranges_m); }); },
     "sign", "counter-clockwise"},
    {"Millimetres",
     [](auto& scans) {
       for_each_scan(scans, [](auto& s) {
         for (float& range : s.ranges_m) range *= 1000.0F;
       });
     },
     "ranges", "metres, not millimetres"},
    {"Frozen",
     [](auto& scans) {
       for (std::size_t i = 50; i < 150; ++i) scans[i].ranges_m = scans[49].ranges_m;
     },
     "repetition", "nothing while the device sends nothing"},
    {"FromZero", [](auto& scans) { for_each_scan(scans, [](auto& s) { s.angle_min_rad = 0.0; }); },
     "frame", "minus half of the field of view"},
    {"Appended",
     [](auto& scans) {
       for_each_scan(scans, [](auto& s) {
         std::vector<float> even;
         std::vector<float> odd;
         for (std::size_t i = 0; i < s.ranges_m.size(); ++i) {
           (i % 2 == 0 ? even : odd).push_back(s.ranges_m[i]);
         }
         even.insert(even.end(), odd.begin(), odd.end());
         s.ranges_m = even;
       });
     },
     "neighbours", "interlaced"},
    {"Ahead", [](auto&) {}, "clock", "ahead of their arrival", -400'000},
    {"Arrival", [](auto&) {}, "clock", "time of the first beam", 500},
    {"Old", [](auto&) {}, "clock", "that the guard permits", 3'600'000'000},
    {"Jitter",
     [](auto& scans) {
       std::mt19937 random(3);
       std::exponential_distribution<> late_us(1.0 / 8000.0);
       for_each_scan(scans, [&](auto& s) { s.utime += std::lround(late_us(random)); });
     },
     "jitter", "time of measurement"},
    {"TwoDrivers",
     [](auto& scans) {
       std::vector<LaserScan> twice;
       for (const auto& scan : scans) twice.insert(twice.end(), {scan, scan});
       scans = twice;
     },
     "order", "second driver"},
    {"Gap",
     [](auto& scans) {
       for (std::size_t i = 100; i < scans.size(); ++i) scans[i].utime += 10 * kPeriodUs * 4;
     },
     "gaps", "loose cable"},
    {"Slow",
     [](auto& scans) {
       for (std::size_t i = 0; i < scans.size(); ++i) {
         scans[i].utime = kStartUs + static_cast<std::int64_t>(i) * 210'000;
       }
     },
     "rate", "baud rate"}};

INSTANTIATE_TEST_SUITE_P(OfADriver, MistakesOfLasers, testing::ValuesIn(kMistakes),
                         [](const auto& test) { return test.param.name; });

TEST(DriverCheck, DoesNotKnowTheSignOfALaserThatStands) {
  DriverCheck check("LASER_FRONT", kRangeMaxM);
  for (const LaserScan& scan : good_scans()) {
    check.add("LASER_FRONT", encode(to_message(scan)), scan.utime + kLatencyUs);
  }
  EXPECT_EQ(result_of(check.results(), "sign").verdict, Verdict::kUnknown);
  EXPECT_TRUE(all_are_good(check.results()));
}

TEST(DriverCheck, SaysWhenNothingOrInvalidMessagesArrive) {
  DriverCheck check("LASER_REAR", kRangeMaxM);
  EXPECT_THAT(bad(check.results()),
              testing::ElementsAre(HasSubstr("0 arrived: is the driver running")));
  const std::vector<std::uint8_t> bytes(20, 7);
  for (int i = 0; i < 5; ++i) check.add("LASER_REAR", bytes, kStartUs);
  EXPECT_THAT(bad(check.results()), testing::Contains(HasSubstr("5 are rejected")));
}

TEST(DriverCheck, RejectsAChannelOfNoDriver) {
  try {
    const DriverCheck check("POSE", kRangeMaxM);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("'POSE'"), HasSubstr("LASER_FRONT")));
  }
}

/// IMU messages at rest with noise, changed.
std::vector<std::string> bad_imu(const std::function<void(ImuReading&)>& change) {
  DriverCheck check("IMU", kRangeMaxM);
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0.0, 0.01);
  for (int i = 0; i < 500; ++i) {
    ImuReading reading{kStartUs + i * 10'000,
                       {noise(random), noise(random), noise(random)},
                       {noise(random), noise(random), 9.81 + noise(random)}};
    change(reading);
    check.add("IMU", encode(to_message(reading)), kStartUs + i * 10'000 + 2000);
  }
  return bad(check.results());
}

TEST(DriverCheck, FindsMistakesOfAnImu) {
  EXPECT_THAT(bad_imu([](ImuReading&) {}), testing::IsEmpty());
  EXPECT_THAT(bad_imu([](ImuReading& r) { r.linear_acceleration *= -1.0; }),
              testing::ElementsAre(HasSubstr("z up")));
  EXPECT_THAT(bad_imu([](ImuReading& r) { r.linear_acceleration /= 9.81; }),
              testing::ElementsAre(HasSubstr("m/s², with gravity")));
  EXPECT_THAT(bad_imu([](ImuReading& r) { r.angular_velocity.z() += 20.0; }),
              testing::ElementsAre(HasSubstr("not degrees")));
}

TEST(DriverCheck, FindsATiltRateOfTheOtherSign) {
  const auto bad_tilt = [](double sign) {
    DriverCheck check("TILT_FRONT", kRangeMaxM);
    for (int i = 0; i < 200; ++i) {
      const double phase = 0.05 * i;
      const TiltReading reading{kStartUs + i * 20'000, 0.5 * std::sin(phase),
                                sign * 1.25 * std::cos(phase)};
      check.add("TILT_FRONT", encode(to_message(reading)), reading.utime + 2000);
    }
    return bad(check.results());
  };
  EXPECT_THAT(bad_tilt(1.0), testing::IsEmpty());
  EXPECT_THAT(bad_tilt(-1.0), testing::ElementsAre(HasSubstr("other sign")));
}

/// A servo is read when its driver is scheduled, a base measures on its own.
TEST(DriverCheck, LetsTheStampsOfTiltsAloneBeIrregular) {
  std::mt19937 random(3);
  std::uniform_int_distribution<std::int64_t> late_us(0, 5000);
  DriverCheck tilts("TILT_REAR", kRangeMaxM);
  DriverCheck wheels("WHEEL_ODOMETRY", kRangeMaxM);
  for (int i = 0; i < 250; ++i) {
    const std::int64_t utime = kStartUs + i * 20'000 + late_us(random);
    tilts.add("TILT_REAR", encode(to_message(TiltReading{utime, 0.1, 0.0})), utime + 3000);
    wheels.add("WHEEL_ODOMETRY", encode(to_message(WheelOdometry{utime, {0.01 * i, 0.0, 0.0}})),
               utime + 3000);
  }
  EXPECT_THAT(bad(tilts.results()), testing::IsEmpty());
  EXPECT_THAT(bad(wheels.results()), testing::ElementsAre(HasSubstr("period")));
}

}  // namespace
}  // namespace adit
