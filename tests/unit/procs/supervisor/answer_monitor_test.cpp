// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/management/answer_monitor.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::int64_t kMs = 1000;
constexpr std::int64_t kSecond = 1'000'000;

/// Input with a period over a duration, for a process with a timeout of 5 s.
class AnswerMonitorTest : public testing::Test {
 protected:
  void give_input(std::int64_t period_us, std::int64_t duration_us) {
    for (const std::int64_t end = now_ + duration_us; now_ < end; now_ += period_us) {
      monitor_.on_input(now_);
    }
  }

  std::int64_t now_ = 1000 * kSecond;
  AnswerMonitor monitor_{5.0};
};

TEST_F(AnswerMonitorTest, FindsAProcessThatIgnoresItsInput) {
  give_input(13 * kMs, 5 * kSecond);
  EXPECT_FALSE(monitor_.is_ignored());
  give_input(13 * kMs, 20 * kMs);
  EXPECT_TRUE(monitor_.is_ignored());
  monitor_.on_answer();
  EXPECT_FALSE(monitor_.is_ignored());
  EXPECT_FALSE(monitor_.is_unanswered());
}

/// As mapping, while the robot waits for the order to start.
TEST_F(AnswerMonitorTest, ExpectsTheFirstAnswerAtAnyTimeIfAnswersMayComeLate) {
  monitor_ = AnswerMonitor(5.0, true);
  for (int run = 0; run < 2; ++run) {
    monitor_.reset(now_, 1.0);
    give_input(13 * kMs, 1000 * kSecond);
    EXPECT_FALSE(monitor_.is_ignored());
    monitor_.on_answer();
    give_input(13 * kMs, 4 * kSecond);
    EXPECT_FALSE(monitor_.is_ignored());
    give_input(13 * kMs, 2 * kSecond);
    EXPECT_TRUE(monitor_.is_ignored());
  }
}

TEST_F(AnswerMonitorTest, ExpectsNothingWithoutInput) {
  give_input(13 * kMs, 4 * kSecond);
  now_ += 100 * kSecond;  // the input has ended
  EXPECT_FALSE(monitor_.is_ignored());
  monitor_.on_input(now_);
  EXPECT_FALSE(monitor_.is_ignored());
}

TEST_F(AnswerMonitorTest, ExpectsNoAnswerToEachOfManyRequests) {
  for (int i = 0; i < 100; ++i) {  // a request that is answered after 4 s, with others meanwhile
    give_input(kSecond, 4 * kSecond);
    EXPECT_FALSE(monitor_.is_ignored());
    monitor_.on_answer();
  }
}

TEST_F(AnswerMonitorTest, ExpectsNoAnswerToARequestNowAndThen) {
  for (int i = 0; i < 100; ++i) {
    monitor_.on_input(now_);
    EXPECT_FALSE(monitor_.is_ignored());
    now_ += 6 * kSecond;
  }
}

TEST_F(AnswerMonitorTest, FindsOneThatIgnoresARepeatedRequest) {
  for (int i = 0; i < 3; ++i, now_ += 2 * kSecond) monitor_.on_input(now_);
  EXPECT_FALSE(monitor_.is_ignored());
  monitor_.on_input(now_);
  EXPECT_TRUE(monitor_.is_ignored());
}

TEST_F(AnswerMonitorTest, GivesAStartedProcessTime) {
  give_input(13 * kMs, 6 * kSecond);
  monitor_.reset(now_, 10.0);
  EXPECT_FALSE(monitor_.is_ignored());
  give_input(13 * kMs, 14 * kSecond);
  EXPECT_FALSE(monitor_.is_ignored());
  give_input(13 * kMs, 2 * kSecond);
  EXPECT_TRUE(monitor_.is_ignored());
}

TEST_F(AnswerMonitorTest, IgnoresTimeBlockedOnTheDisk) {
  for (int i = 0; i < 60; ++i) {
    give_input(100 * kMs, kSecond);
    monitor_.add_blocked_time(kSecond);
    EXPECT_FALSE(monitor_.is_ignored());
  }
  for (int i = 0; i < 6; ++i) {  // blocked time counts after a minute
    give_input(100 * kMs, kSecond);
    monitor_.add_blocked_time(kSecond);
  }
  EXPECT_TRUE(monitor_.is_ignored());
}

}  // namespace
}  // namespace adit
