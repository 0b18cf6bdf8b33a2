// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/recovery.hpp"

#include <vector>

#include <gmock/gmock.h>

namespace adit {
namespace {

using testing::ElementsAre;
using Action = Recovery::Action;
using Evidence = Recovery::Evidence;

constexpr Recovery::Options kCanBackOff{true, false, false};
constexpr Recovery::Options kCanRejoin{true, true, false};
constexpr Recovery::Options kShortCut{true, false, true};

/// The actions for a row of equal rejections, up to the first kAbandon.
std::vector<Action> actions(Recovery& recovery, const Recovery::Rejection& rejection,
                            const Recovery::Options& options) {
  std::vector<Action> chosen;
  while (chosen.empty() || chosen.back() != Action::kAbandon) {
    chosen.push_back(recovery.choose(rejection, options));
  }
  return chosen;
}

TEST(Recovery, TriesAllViewpointsForUnobservedGround) {
  Recovery recovery;
  EXPECT_THAT(actions(recovery, {Evidence::kUnobserved, 2.0, "shadow"}, kCanBackOff),
              ElementsAre(Action::kScanBeside, Action::kApproach, Action::kScanOtherLaser,
                          Action::kBackOff, Action::kBackOff, Action::kAbandon));
  EXPECT_TRUE(recovery.is_uncertain());
}

/// The same laser at the same pose shows the same.
TEST(Recovery, HasOneViewpointLessWithOneLaser) {
  Recovery recovery;
  const Recovery::Options one_laser{.can_back_off = true, .has_other_laser = false};
  EXPECT_THAT(actions(recovery, {Evidence::kUnobserved, 2.0, "shadow"}, one_laser),
              ElementsAre(Action::kScanBeside, Action::kApproach, Action::kBackOff,
                          Action::kBackOff, Action::kAbandon));
}

TEST(Recovery, ChoosesAViewpointAgainThatItsDriveMissed) {
  Recovery recovery;
  const Recovery::Rejection shadow{Evidence::kUnobserved, 2.0, "shadow"};
  EXPECT_EQ(recovery.choose(shadow, kCanBackOff), Action::kScanBeside);
  recovery.note_missed_viewpoint();
  EXPECT_EQ(recovery.choose(shadow, kCanBackOff), Action::kScanBeside);
  EXPECT_EQ(recovery.choose(shadow, kCanBackOff), Action::kApproach);
  EXPECT_EQ(recovery.choose(shadow, kCanBackOff), Action::kScanOtherLaser);
  EXPECT_EQ(recovery.choose(shadow, kCanBackOff), Action::kBackOff);
  recovery.note_missed_viewpoint();
  EXPECT_EQ(recovery.back_offs(), 0);
  EXPECT_EQ(recovery.choose(shadow, kCanBackOff), Action::kAbandon);  // six rejections
}

TEST(Recovery, AbandonsAfterTwoObservations) {
  Recovery recovery;
  EXPECT_THAT(actions(recovery, {Evidence::kObserved, 2.0, "rubble"}, kCanBackOff),
              ElementsAre(Action::kBackOff, Action::kAbandon));
  EXPECT_FALSE(recovery.is_uncertain());
  EXPECT_EQ(recovery.evidence(), "rubble Again: rubble");
}

TEST(Recovery, RescansOnceAfterFailedDrives) {
  Recovery recovery;
  EXPECT_THAT(actions(recovery, {Evidence::kDriveFailed, 0.0, "beside the path"}, kCanBackOff),
              ElementsAre(Action::kRescan, Action::kBackOff, Action::kBackOff, Action::kAbandon));
}

TEST(Recovery, RejoinsTheTraversedPathOnTheReturn) {
  Recovery recovery;
  recovery.set_target(std::nullopt, true);
  EXPECT_THAT(actions(recovery, {Evidence::kUnobserved, 2.0, "shadow"}, kCanRejoin),
              ElementsAre(Action::kRejoin, Action::kRejoin, Action::kRejoin, Action::kAbandon));
}

TEST(Recovery, AbandonsAShortCutHomeInsteadOfBackingOff) {
  Recovery recovery;
  recovery.set_target(std::nullopt, true);
  EXPECT_THAT(actions(recovery, {Evidence::kUnobserved, 2.0, "shadow"}, kShortCut),
              ElementsAre(Action::kScanOtherLaser, Action::kAbandon));
}

TEST(Recovery, RescansOnceWithoutATraversedPath) {
  Recovery recovery;
  EXPECT_THAT(actions(recovery, {Evidence::kObserved, 0.5, "rubble"}, {}),
              ElementsAre(Action::kRescan, Action::kAbandon));
}

TEST(Recovery, ResetsForAnotherTargetOnly) {
  Recovery recovery;
  EXPECT_TRUE(recovery.set_target(3, false));
  (void)recovery.choose({Evidence::kObserved, 0.5, "rubble"}, kCanBackOff);
  EXPECT_FALSE(recovery.set_target(3, false));
  EXPECT_EQ(recovery.rejections(), 1);
  EXPECT_TRUE(recovery.set_target(4, false));
  EXPECT_EQ(recovery.rejections(), 0);
}

}  // namespace
}  // namespace adit
