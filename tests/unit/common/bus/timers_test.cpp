// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/timers.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::int64_t kSecond = 1'000'000;

int ticks_due(Timers& timers, std::int64_t utime) {
  int ticks = 0;
  while (timers.next(utime)) ++ticks;
  return ticks;
}

TEST(Timers, TickImmediatelyAndThenOncePerPeriod) {
  Timers timers;
  timers.add(kSecond, {});
  EXPECT_EQ(ticks_due(timers, 100 * kSecond), 1);
  EXPECT_EQ(ticks_due(timers, 101 * kSecond - 1), 0);
  EXPECT_EQ(ticks_due(timers, 101 * kSecond), 1);
}

TEST(Timers, AreDueEarliestFirst) {
  Timers timers;
  timers.add(3 * kSecond, {});
  timers.add(2 * kSecond, {});
  EXPECT_EQ(ticks_due(timers, 0), 2);
  EXPECT_EQ(timers.next(3 * kSecond)->due_utime, 2 * kSecond);
  EXPECT_EQ(timers.next(3 * kSecond)->due_utime, 3 * kSecond);
}

TEST(Timers, MakeUpForAShortGap) {
  Timers timers;
  timers.add(kSecond, {});
  EXPECT_EQ(ticks_due(timers, 0), 1);
  EXPECT_EQ(ticks_due(timers, 8 * kSecond), 8);
}

TEST(Timers, SkipTheTicksOfALongGap) {
  Timers timers;
  timers.add(kSecond, {});
  EXPECT_EQ(ticks_due(timers, 0), 1);
  EXPECT_EQ(ticks_due(timers, 1'000'000 * kSecond), 1);
}

TEST(Timers, FollowAClockThatIsSetBack) {
  Timers timers;
  timers.add(kSecond, {});
  EXPECT_EQ(ticks_due(timers, 1000 * kSecond), 1);
  EXPECT_EQ(ticks_due(timers, 500 * kSecond), 1);
  EXPECT_EQ(ticks_due(timers, 501 * kSecond), 1);
}

TEST(Timers, ReportTheTimeToTheNextTick) {
  Timers timers;
  EXPECT_FALSE(timers.wait_us(0));
  timers.add(3 * kSecond, {});
  timers.add(kSecond, {});
  EXPECT_EQ(timers.wait_us(0), 0);
  ticks_due(timers, 0);
  EXPECT_EQ(timers.wait_us(kSecond / 4), 3 * kSecond / 4);
  EXPECT_EQ(timers.wait_us(2 * kSecond), 0);
}

TEST(Timers, ThrowForANonPositivePeriod) {
  EXPECT_THROW(Timers().add(0, {}), std::invalid_argument);
}

}  // namespace
}  // namespace adit
