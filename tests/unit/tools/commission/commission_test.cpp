// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/commission/motion_check.hpp"
#include "tools/commission/stop_check.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using Verdict = CheckResult::Verdict;

constexpr std::int64_t kStart = 1'700'000'000'000'000;

const StopCause& cause(const std::string& name) {
  return *std::ranges::find(stop_causes(), name, &StopCause::name);
}

/// A robot whose wheels turn at 0.2 m/s; what happens is at 2 s.
struct Run {
  std::string reason;           ///< of STOP from 2 s on; empty: none
  double stands_after_s = 0.3;  ///< after 2 s; beyond 8 s: never
  bool commands = true;         ///< from 2 s on
  bool guard = true;            ///< from 2 s on
};

CheckResult check(const std::string& name, const Run& run) {
  StopCheck check(cause(name));
  for (int ms = 0; ms < 10'000; ms += 50) {
    const std::int64_t utime = kStart + ms * 1000;
    const bool before = ms < 2000;
    if (before || run.guard)
      check.add(StopOrder{utime, !before && !run.reason.empty(), run.reason}, utime);
    if (before || run.commands) check.add(DriveCommand{utime, 0.2, 0.0}, utime);
    VehicleState state;
    state.speed_m_s = ms < 500 || ms >= 2000 + 1000.0 * run.stands_after_s ? 0.0 : 0.2;
    check.add(state, utime);
  }
  return check.result();
}

TEST(StopCheck, PassesWhenTheWheelsStandInTime) {
  EXPECT_EQ(check("obstacle", {"obstacle 0.30 m ahead on the commanded arc"}).verdict,
            Verdict::kGood);
  EXPECT_EQ(check("laser", {"laser front: no scan"}).verdict, Verdict::kGood);
  EXPECT_EQ(check("supervisor", {"no supervisor for 3.00 s"}).verdict, Verdict::kGood);
  EXPECT_EQ(check("operator", {"", 0.3, false}).verdict, Verdict::kGood);
  EXPECT_EQ(check("guard", {"", 0.3, true, false}).verdict, Verdict::kGood);
}

TEST(StopCheck, FailsWhenTheyStandTooLateOrNever) {
  const CheckResult late = check("obstacle", {"obstacle 0.30 m ahead", 0.8});
  EXPECT_EQ(late.verdict, Verdict::kBad);
  EXPECT_THAT(late.text, HasSubstr("0.80 s"));
  const CheckResult never = check("guard", {"", 100.0, true, false});
  EXPECT_EQ(never.verdict, Verdict::kBad);
  EXPECT_THAT(never.text, HasSubstr("still turn"));
}

TEST(StopCheck, FailsWhenTheGuardStatesAnotherReason) {
  const CheckResult other = check("obstacle", {"laser front: no scan"});
  EXPECT_EQ(other.verdict, Verdict::kBad);
  EXPECT_THAT(other.text, HasSubstr("but: laser front"));
}

TEST(StopCheck, FailsWithoutMotion) {
  StopCheck check(cause("obstacle"));
  check.add(VehicleState{}, kStart);
  EXPECT_THAT(check.result().text, HasSubstr("never reported"));
}

/// Drives along an arc, as POSE and wheels report it.
CheckResults check_motion(MotionCheck::Motion motion, double amount, const Pose2& T_odom_end,
                          double rolled_m) {
  MotionCheck check(motion, amount);
  constexpr int kSteps = 100;
  for (int i = 0; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    const std::int64_t utime = kStart + i * 100'000;
    check.add_pose({1.0 + share * T_odom_end.x, share * T_odom_end.y, share * T_odom_end.theta},
                   utime);
    check.add_speed(i == 0 ? 0.0 : rolled_m / (kSteps * 0.1), utime);
  }
  EXPECT_FALSE(check.is_over());
  check.add_speed(0.0, kStart + 11'500'000);
  EXPECT_TRUE(check.is_over());
  return check.results();
}

bool all_good(const CheckResults& results) {
  return std::ranges::all_of(
      results, [](const CheckResult& result) { return result.verdict == Verdict::kGood; });
}

TEST(MotionCheck, PassesWhatWasDriven) {
  using Motion = MotionCheck::Motion;
  EXPECT_TRUE(all_good(check_motion(Motion::kForwards, 1.0, {1.05, 0.03, 0.02}, 1.02)));
  EXPECT_TRUE(all_good(check_motion(Motion::kLeft, 0.5 * std::numbers::pi, {0.9, 0.9, 1.5}, 1.5)));
}

TEST(MotionCheck, FailsWithWhatIsProbablyWrong) {
  using Motion = MotionCheck::Motion;
  const CheckResults exchanged = check_motion(Motion::kForwards, 1.0, {-1.0, 0.0, 0.0}, 1.0);
  EXPECT_FALSE(all_good(exchanged));
  EXPECT_THAT(exchanged[0].text, HasSubstr("exchanged"));
  const CheckResults wheels = check_motion(Motion::kForwards, 1.0, {1.0, 0.0, 0.0}, -1.0);
  EXPECT_THAT(wheels[2].text, HasSubstr("sign of the speed"));
  const CheckResults mirrored =
      check_motion(Motion::kLeft, 0.5 * std::numbers::pi, {0.9, 0.9, -1.5}, 1.5);
  EXPECT_THAT(mirrored[0].text, HasSubstr("wrong order"));
  EXPECT_THAT(MotionCheck(Motion::kLeft, 1.0).results()[0].text, HasSubstr("no POSE"));
}

}  // namespace
}  // namespace adit
