// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/input_staleness.hpp"

#include <cstdint>
#include <optional>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::int64_t kSecond = 1'000'000;

TEST(MonotonicTime, IgnoresStepsBack) {
  MonotonicTime time;
  EXPECT_EQ(time.advance_to(100 * kSecond), 0);
  EXPECT_EQ(time.advance_to(101 * kSecond), kSecond);
  EXPECT_EQ(time.advance_to(50 * kSecond), kSecond);
  EXPECT_EQ(time.advance_to(51 * kSecond), 2 * kSecond);
  EXPECT_EQ(time.monotonic_us(51 * kSecond - 10), 2 * kSecond - 10);
  EXPECT_EQ(time.monotonic_us(80 * kSecond), 2 * kSecond);  // in the future
}

TEST(LastReceived, IsStaleAfterItsTimeout) {
  LastReceived pose;
  EXPECT_EQ(pose.staleness("pose", 0, 0.25), "no pose received yet");
  EXPECT_EQ(pose.staleness_if_received("pose", 0, 0.25), std::nullopt);
  EXPECT_TRUE(pose.receive(kSecond));
  EXPECT_FALSE(pose.receive(kSecond - 1));
  EXPECT_EQ(pose.staleness("pose", kSecond + 250'000, 0.25), std::nullopt);
  EXPECT_EQ(pose.staleness("pose", kSecond + 310'000, 0.25), "pose stale for 0.31 s");
  EXPECT_EQ(pose.staleness_if_received("pose", 2 * kSecond, 0.25), "pose stale for 1.00 s");
  // The stamps of a sender whose clock starts at the epoch.
  EXPECT_EQ(pose.staleness("pose", 1'795'371'298 * kSecond, 0.25),
            "pose stale: its time stamps are more than a day old");
}

}  // namespace
}  // namespace adit
