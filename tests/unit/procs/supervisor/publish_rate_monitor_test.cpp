// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/management/publish_rate_monitor.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::int64_t kMs = 1000;

/// A monitor with one message per period for five seconds.
PublishRateMonitor publishing_each(std::int64_t period_us, double rate_hz) {
  PublishRateMonitor rate(rate_hz);
  for (std::int64_t t = 0; t <= 5000 * kMs; t += period_us) rate.on_message(t);
  return rate;
}

TEST(PublishRateMonitor, IsMetAtTheRequiredRate) {
  EXPECT_TRUE(publishing_each(200 * kMs, 5.0).is_met(5000 * kMs));
  EXPECT_TRUE(publishing_each(200 * kMs, 5.0).is_met(5199 * kMs));  // just before the next
  EXPECT_TRUE(publishing_each(10 * kMs, 100.0).is_met(5000 * kMs));
}

TEST(PublishRateMonitor, IsNotMetAtALowerRate) {
  EXPECT_FALSE(publishing_each(260 * kMs, 5.0).is_met(5000 * kMs));  // nine take 2.08 s
  EXPECT_FALSE(publishing_each(20 * kMs, 100.0).is_met(5000 * kMs));
}

TEST(PublishRateMonitor, IsNotMetAfterTheLastMessage) {
  const PublishRateMonitor rate = publishing_each(200 * kMs, 5.0);
  EXPECT_TRUE(rate.is_met(5400 * kMs));  // nine messages in two seconds
  EXPECT_FALSE(rate.is_met(5500 * kMs));
}

TEST(PublishRateMonitor, RequiresOneMessageInTwoPeriodsBelowOneHertz) {
  PublishRateMonitor rate(0.1);
  EXPECT_FALSE(rate.is_met(0));
  rate.on_message(0);
  EXPECT_TRUE(rate.is_met(20'000 * kMs));
  EXPECT_FALSE(rate.is_met(20'001 * kMs));
}

TEST(PublishRateMonitor, IgnoresTimeBlockedOnTheDisk) {
  PublishRateMonitor rate(0.2);
  rate.on_message(0);
  std::int64_t now = 0;
  const auto wait = [&](int seconds) {
    for (int i = 0; i < seconds; ++i) rate.add_blocked_time(now += 1000 * kMs, 1000 * kMs);
  };
  wait(25);
  EXPECT_TRUE(rate.is_met(now));
  EXPECT_TRUE(rate.is_met(now + 10'000 * kMs));
  EXPECT_FALSE(rate.is_met(now + 10'001 * kMs));
  wait(35);
  EXPECT_TRUE(rate.is_met(now + 10'000 * kMs));
  wait(11);  // blocked time counts after a minute
  EXPECT_FALSE(rate.is_met(now));
  rate.on_message(now);
  wait(25);
  EXPECT_TRUE(rate.is_met(now));
}

TEST(PublishRateMonitor, IsNotMetAfterReset) {
  PublishRateMonitor rate = publishing_each(200 * kMs, 5.0);
  rate.reset();
  EXPECT_FALSE(rate.is_met(5000 * kMs));
}

}  // namespace
}  // namespace adit
