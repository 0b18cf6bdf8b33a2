// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/time_statistics.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(TimeStatistics, AreZeroWithoutTimes) {
  const TimeStatistics times;
  EXPECT_EQ(times.count(), 0U);
  EXPECT_EQ(times.mean_ms(), 0.0);
  EXPECT_EQ(times.max_ms(), 0.0);
  EXPECT_EQ(times.quantile_ms(0.99), 0.0);
}

TEST(TimeStatistics, FindQuantilesToHalfAPercent) {
  TimeStatistics times;
  for (int i = 1000; i > 0; --i) times.add(0.01 * i);
  EXPECT_EQ(times.count(), 1000U);
  EXPECT_NEAR(times.mean_ms(), 5.005, 1e-9);
  EXPECT_EQ(times.max_ms(), 10.0);
  for (const double share : {0.1, 0.5, 0.9, 0.99}) {
    const double exact = 10.0 * share;
    EXPECT_NEAR(times.quantile_ms(share), exact, 0.005 * exact + 0.01) << share;  // and a time
  }
  EXPECT_LE(times.quantile_ms(1.0), times.max_ms());
}

TEST(TimeStatistics, TakeAnyTime) {
  TimeStatistics times;
  times.add(0.0);
  times.add(1e12);
  EXPECT_EQ(times.max_ms(), 1e12);
  EXPECT_LT(times.quantile_ms(0.1), 2e-3);
}

}  // namespace
}  // namespace adit
