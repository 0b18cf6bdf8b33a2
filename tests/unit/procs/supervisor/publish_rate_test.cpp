// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/keeping/publish_rate.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::int64_t kMs = 1000;

/// Messages each period for five seconds.
PublishRate heard_each(std::int64_t period_us, double rate_hz) {
  PublishRate rate(rate_hz);
  for (std::int64_t t = 0; t <= 5000 * kMs; t += period_us) rate.heard(t);
  return rate;
}

TEST(PublishRate, IsKeptByWhoPublishesAsOften) {
  EXPECT_TRUE(heard_each(200 * kMs, 5.0).is_kept(5000 * kMs));
  EXPECT_TRUE(heard_each(200 * kMs, 5.0).is_kept(5199 * kMs));  // just before the next
  EXPECT_TRUE(heard_each(10 * kMs, 100.0).is_kept(5000 * kMs));
}

TEST(PublishRate, IsNotKeptByWhoPublishesLess) {
  EXPECT_FALSE(heard_each(260 * kMs, 5.0).is_kept(5000 * kMs));  // nine take 2.08 s
  EXPECT_FALSE(heard_each(20 * kMs, 100.0).is_kept(5000 * kMs));
}

TEST(PublishRate, EndsWithTheMessages) {
  const PublishRate rate = heard_each(200 * kMs, 5.0);
  EXPECT_TRUE(rate.is_kept(5400 * kMs));  // nine of two seconds
  EXPECT_FALSE(rate.is_kept(5500 * kMs));
}

TEST(PublishRate, OfLessThanOneEachSecondAsksForOneInTwoPeriods) {
  PublishRate rate(0.1);
  EXPECT_FALSE(rate.is_kept(0));
  rate.heard(0);
  EXPECT_TRUE(rate.is_kept(20'000 * kMs));
  EXPECT_FALSE(rate.is_kept(20'001 * kMs));
}

TEST(PublishRate, DoesNotCountTheTimeThatItWaitsForTheDisk) {
  PublishRate rate(0.2);
  rate.heard(0);
  std::int64_t now = 0;
  const auto wait = [&](int seconds) {
    for (int i = 0; i < seconds; ++i) rate.excuse(now += 1000 * kMs, 1000 * kMs);
  };
  wait(25);
  EXPECT_TRUE(rate.is_kept(now));
  EXPECT_TRUE(rate.is_kept(now + 10'000 * kMs));
  EXPECT_FALSE(rate.is_kept(now + 10'001 * kMs));
  wait(35);
  EXPECT_TRUE(rate.is_kept(now + 10'000 * kMs));
  wait(11);  // a minute is over: what waits for so long will not come back
  EXPECT_FALSE(rate.is_kept(now));
  rate.heard(now);
  wait(25);
  EXPECT_TRUE(rate.is_kept(now));
}

TEST(PublishRate, BeginsAnewForAnotherProcess) {
  PublishRate rate = heard_each(200 * kMs, 5.0);
  rate.forget();
  EXPECT_FALSE(rate.is_kept(5000 * kMs));
}

}  // namespace
}  // namespace adit
