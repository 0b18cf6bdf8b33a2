// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/timing/clock_filter.hpp"

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/timing/scan_counter.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStartUs = 1'000'000'000;

/// An arrival after the least delay, 4 ms, plus what is distributed exponentially with a mean of
/// 3 ms.
class DelayedArrivals {
 public:
  std::int64_t of(double true_us) { return std::llround(true_us + 4000.0 + delay_us_(random_)); }

 private:
  std::mt19937 random_{5};
  std::exponential_distribution<> delay_us_{1.0 / 3000.0};
};

class ClockFilterDrift : public testing::TestWithParam<double> {};

TEST_P(ClockFilterDrift, IsFoundBelowDelaysOfMilliseconds) {
  const double rate = 1.0 + GetParam();
  DelayedArrivals arrivals;
  ClockFilter filter;
  double worst_us = 0.0;
  for (int i = 0; i < 75 * 120; ++i) {
    const auto device_us = static_cast<std::int64_t>(i) * 13'333;
    const double true_us = static_cast<double>(kStartUs) + rate * static_cast<double>(device_us);
    filter.add(device_us, arrivals.of(true_us));
    if (i < 75 * 10) continue;
    const double error_us = filter.arrival_us(static_cast<double>(device_us)) - true_us - 4000.0;
    worst_us = std::max(worst_us, std::abs(error_us));
  }
  EXPECT_LT(worst_us, 150.0);  // of 3000 µs: the least of some hundred delays is some 10 µs
  EXPECT_NEAR(filter.rate(), rate, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(OfTheDevice, ClockFilterDrift,
                         testing::Values(0.0, 0.003, -0.003, 1e-5, 0.009));

TEST(ClockFilter, IsNeverAboveAnArrival) {
  DelayedArrivals arrivals;
  ClockFilter filter;
  std::vector<std::pair<std::int64_t, std::int64_t>> points;
  for (int i = 0; i < 2000; ++i) {
    const auto device_us = static_cast<std::int64_t>(i) * 13'333;
    points.emplace_back(device_us, arrivals.of(1.002 * static_cast<double>(device_us)));
    filter.add(points.back().first, points.back().second);
  }
  for (const auto& [device_us, arrival_us] : points) {
    // The points between those of the hull are above it but for the change of the slope since.
    EXPECT_LE(filter.arrival_us(static_cast<double>(device_us)),
              static_cast<double>(arrival_us) + 20.0);
  }
}

TEST(ClockFilter, BeginsAgainWhenTheDeviceDoes) {
  ClockFilter filter;
  filter.add(5'000'000, kStartUs);
  filter.add(6'000'000, kStartUs + 1'000'000);
  filter.add(0, kStartUs + 9'000'000);  // switched on again
  EXPECT_DOUBLE_EQ(filter.arrival_us(1000.0), static_cast<double>(kStartUs) + 9'001'000.0);
}

/// Scans of which three of four are not sent, as by a slow line, and a tenth are lost.
TEST(ScanCounter, CountsScansThatDoNotArrive) {
  constexpr double kPeriodUs = 13'333.333;
  constexpr double kTruePeriodUs = kPeriodUs * 1.004;
  ScanCounter counter(kPeriodUs);
  std::mt19937 random(2);
  std::exponential_distribution<> delay_us(1.0 / 500.0);
  double worst_us = 0.0;
  for (int scan = 0; scan < 75 * 60; scan += 4) {
    if (random() % 10 == 0) continue;
    const double true_us = static_cast<double>(kStartUs) + scan * kTruePeriodUs;
    const auto found = counter.arrival_us(std::llround(true_us + delay_us(random)));
    ASSERT_TRUE(found);
    if (scan > 75 * 5) {
      worst_us = std::max(worst_us, std::abs(static_cast<double>(*found) - true_us));
    }
  }
  EXPECT_LT(worst_us, 100.0);
  EXPECT_NEAR(counter.period_us(), kTruePeriodUs, 0.2);
}

TEST(ScanCounter, FindsThePhaseAfterALateBeginning) {
  ScanCounter counter(10'000.0);
  std::int64_t late_us = 7'000;  // of the first scans
  for (std::int64_t scan = 0; scan < 200; ++scan) {
    if (scan == 5) late_us = 0;
    const auto found = counter.arrival_us(kStartUs + scan * 10'000 + late_us);
    ASSERT_TRUE(found) << scan;
    if (scan <= 5) continue;
    EXPECT_NEAR(static_cast<double>(*found - kStartUs - scan * 10'000), 0.0, 300.0);
  }
}

/// A driver that hangs just after its start reads several scans at once. Counted one after the
/// other they would shift the phase, which the slope of the filter then takes for a wrong period.
TEST(ScanCounter, IsNotShiftedByScansThatAreReadAtOnceWhileItSettles) {
  ScanCounter counter(10'000.0);
  for (std::int64_t scan = 0; scan < 400; ++scan) {
    const bool hangs = scan >= 50 && scan < 54;
    const std::int64_t arrival_us = kStartUs + (hangs ? 54 : scan) * 10'000 - (hangs ? 100 : 0);
    const auto found = counter.arrival_us(arrival_us);
    if (scan < 60) continue;
    ASSERT_TRUE(found) << scan;
    EXPECT_NEAR(static_cast<double>(*found - kStartUs - scan * 10'000), 0.0, 300.0) << scan;
  }
}

/// A counter of scans every 10 ms that has seen 500 of them, in time.
ScanCounter settled_counter() {
  ScanCounter counter(10'000.0);
  for (std::int64_t scan = 0; scan < 500; ++scan) {
    EXPECT_TRUE(counter.arrival_us(kStartUs + scan * 10'000));
  }
  return counter;
}

TEST(ScanCounter, KnowsAScanThatIsLateByAlmostAPeriod) {
  ScanCounter counter = settled_counter();
  EXPECT_EQ(counter.arrival_us(kStartUs + 5'009'000), kStartUs + 5'000'000);
  EXPECT_EQ(counter.arrival_us(kStartUs + 5'010'000), kStartUs + 5'010'000);
}

TEST(ScanCounter, DropsAScanRatherThanTakeTheTimeOfAnother) {
  ScanCounter counter = settled_counter();
  ASSERT_TRUE(counter.arrival_us(kStartUs + 5'009'800));  // scan 500, almost with the next
  EXPECT_FALSE(counter.arrival_us(kStartUs + 5'010'000));
  const auto next = counter.arrival_us(kStartUs + 5'020'000);
  ASSERT_TRUE(next);
  EXPECT_NEAR(static_cast<double>(*next), static_cast<double>(kStartUs + 5'020'000), 200.0);
}

TEST(ScanCounter, BeginsAgainWhenAllScansContradictItsPhase) {
  ScanCounter counter = settled_counter();
  int found = 0;
  for (std::int64_t scan = 500; scan < 520; ++scan) {
    // The mirror lost half a turn, less each time than a period.
    if (counter.arrival_us(kStartUs + 4'985'000 + (scan - 500) * 100)) ++found;
  }
  EXPECT_GT(found, 5);
}

}  // namespace
}  // namespace adit
