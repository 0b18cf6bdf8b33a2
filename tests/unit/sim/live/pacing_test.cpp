// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/live/pacing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace adit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Kind = Pacing::Decision::Kind;

constexpr std::int64_t kStart = 1'000'000'000;  // simulated
constexpr std::int64_t kSecond = 1'000'000;
constexpr std::int64_t kAheadMaxUs = 200'000;  // the default
constexpr std::int64_t kStep = 10'000;

TEST(Pacing, IsUnlimitedByDefault) {
  Pacing pacing({});
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(pacing.decide(kStart + i * kStep, 0).kind, Kind::kStep);
}

TEST(Pacing, FollowsScaledRealTime) {
  Pacing pacing({.factor = 4.0, .wait_for = {}});
  EXPECT_EQ(pacing.decide(kStart, 77).kind, Kind::kStep);
  const auto early = pacing.decide(kStart + kStep, 77 + 500);
  EXPECT_EQ(early.kind, Kind::kWaitForClock);
  EXPECT_EQ(early.wait_us, kStep / 4 - 500);
  EXPECT_EQ(pacing.decide(kStart + kStep, 77 + kStep / 4).kind, Kind::kStep);
}

TEST(Pacing, CatchesUpShortDelaysOnly) {
  Pacing pacing({.factor = 1.0, .wait_for = {}});
  EXPECT_EQ(pacing.decide(kStart, 0).kind, Kind::kStep);
  EXPECT_EQ(pacing.decide(kStart + kStep, 50'000).kind, Kind::kStep);  // 40 ms late
  EXPECT_EQ(pacing.decide(kStart + 5 * kStep, 50'000).kind, Kind::kStep);
  EXPECT_EQ(pacing.decide(kStart + 6 * kStep, 9 * kSecond).kind, Kind::kStep);
  const auto next = pacing.decide(kStart + 7 * kStep, 9 * kSecond);
  EXPECT_EQ(next.kind, Kind::kWaitForClock);
  EXPECT_EQ(next.wait_us, kStep);
}

TEST(Pacing, DoesNotBeginBeforeAllStagesHaveAnswered) {
  Pacing pacing({.factor = {}, .wait_for = {"mapping", "scan_matching"}});
  EXPECT_EQ(pacing.decide(kStart + kStep, 0).kind, Kind::kWaitForStages);
  pacing.done("mapping", kStart);
  EXPECT_EQ(pacing.decide(kStart + kStep, 0).kind, Kind::kWaitForStages);
  pacing.done("scan_matching", kStart);
  EXPECT_EQ(pacing.decide(kStart + kStep, 0).kind, Kind::kStep);
}

TEST(Pacing, DoesNotWaitForAnExcludedStage) {
  Pacing pacing({.factor = {}, .wait_for = {"mapping", "scan_matching"}});
  pacing.done("mapping", kStart);
  pacing.done("scan_matching", kStart);
  EXPECT_EQ(pacing.decide(kStart + kSecond, 0).kind, Kind::kWaitForStages);
  pacing.exclude("mapping", kStart + kStep);
  pacing.exclude("nobody", kStart + kStep);
  pacing.done("mapping", kStart + kStep);  // its last answer, which was in transit
  pacing.done("scan_matching", kStart + kSecond);
  EXPECT_EQ(pacing.decide(kStart + kSecond, 0).kind, Kind::kStep);
  EXPECT_THAT(pacing.newly_timed_out(100 * kSecond), IsEmpty());
}

TEST(Pacing, WaitsAgainForAnExcludedStageOnceItAnswers) {
  Pacing pacing({.factor = {}, .wait_for = {"mapping"}, .outage_max_s = {}});
  pacing.done("mapping", kStart);
  pacing.exclude("mapping", kStart);
  EXPECT_EQ(pacing.decide(kStart + 100 * kSecond, 0).kind, Kind::kStep);
  pacing.done("mapping", kStart + 100 * kSecond);
  EXPECT_EQ(pacing.decide(kStart + 100 * kSecond + kAheadMaxUs, 0).kind, Kind::kStep);
  EXPECT_EQ(pacing.decide(kStart + 101 * kSecond, 0).kind, Kind::kWaitForStages);
}

TEST(Pacing, ExcludesAStageForTheMaximumOutage) {
  Pacing pacing({.factor = {}, .wait_for = {"mapping"}, .outage_max_s = 10.0});
  pacing.done("mapping", kStart);
  pacing.exclude("mapping", kStart + kSecond);
  EXPECT_EQ(pacing.decide(kStart + 11 * kSecond, 0).kind, Kind::kStep);
  EXPECT_EQ(pacing.decide(kStart + 11 * kSecond + kStep, 0).kind, Kind::kWaitForStages);
  EXPECT_THAT(pacing.newly_timed_out(Pacing::kStageTimeoutUs), ElementsAre("mapping"));
  pacing.done("mapping", kStart + 11 * kSecond);
  EXPECT_EQ(pacing.decide(kStart + 11 * kSecond + kStep, 0).kind, Kind::kStep);
}

TEST(Pacing, LimitsTheLeadOverTheSlowestStage) {
  Pacing pacing({.factor = {}, .wait_for = {"mapping", "scan_matching"}});
  pacing.done("mapping", kStart + kSecond);
  pacing.done("scan_matching", kStart);
  EXPECT_EQ(pacing.decide(kStart + kAheadMaxUs, 0).kind, Kind::kStep);
  EXPECT_EQ(pacing.decide(kStart + kAheadMaxUs + kStep, 0).kind, Kind::kWaitForStages);
  pacing.done("scan_matching", kStart + kStep);
  EXPECT_EQ(pacing.decide(kStart + kAheadMaxUs + kStep, 0).kind, Kind::kStep);
}

TEST(Pacing, WaitsForClockAndStages) {
  Pacing pacing({.factor = 1.0, .wait_for = {"mapping"}});
  pacing.done("mapping", kStart);
  EXPECT_EQ(pacing.decide(kStart, 0).kind, Kind::kStep);
  EXPECT_EQ(pacing.decide(kStart + kStep, 0).kind, Kind::kWaitForClock);
  EXPECT_EQ(pacing.decide(kStart + kSecond, 2 * kSecond).kind, Kind::kWaitForStages);
}

TEST(Pacing, IgnoresOldAnswersAndThoseOfOtherStages) {
  Pacing pacing({.factor = {}, .wait_for = {"mapping"}});
  pacing.done("mapping", kStart + kSecond);
  pacing.done("mapping", kStart);
  pacing.done("guard", kStart);
  EXPECT_EQ(pacing.decide(kStart + kSecond + kStep, 0).kind, Kind::kStep);
}

TEST(Pacing, ReportsAStaleStageOnceUntilItAnswers) {
  Pacing pacing({.factor = {}, .wait_for = {"mapping", "scan_matching"}});
  pacing.done("scan_matching", kStart);
  EXPECT_EQ(pacing.decide(kStart + kStep, 0).kind, Kind::kWaitForStages);
  EXPECT_THAT(pacing.newly_timed_out(Pacing::kStageTimeoutUs - 1), IsEmpty());
  EXPECT_THAT(pacing.newly_timed_out(Pacing::kStageTimeoutUs), ElementsAre("mapping"));
  EXPECT_THAT(pacing.newly_timed_out(2 * Pacing::kStageTimeoutUs), IsEmpty());
  pacing.done("mapping", kStart);
  EXPECT_EQ(pacing.decide(kStart + kSecond, 3 * Pacing::kStageTimeoutUs).kind,
            Kind::kWaitForStages);
  EXPECT_THAT(pacing.newly_timed_out(4 * Pacing::kStageTimeoutUs),
              ElementsAre("mapping", "scan_matching"));
}

TEST(Pacing, UsesTheCompleteLeadOverAStage) {
  Pacing pacing({.factor = {}, .wait_for = {"mapping"}, .ahead_max_s = 0.1});
  pacing.done("mapping", kStart);
  EXPECT_EQ(pacing.decide(kStart + 100'000, 0).kind, Kind::kStep);
  EXPECT_EQ(pacing.decide(kStart + 100'001, 0).kind, Kind::kWaitForStages);
}

}  // namespace
}  // namespace adit
