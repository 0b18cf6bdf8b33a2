// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/doubt_list.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

using Reason = MatchDoubt::Reason;

constexpr std::int64_t kOneSecond = 1'000'000;

/// A body that drives 1 m/s for 100 s, with a local map every 5 m.
class DoubtListTest : public testing::Test {
 protected:
  DoubtListTest() {
    for (int i = 0; i <= 100; ++i) path_.push_back({i * kOneSecond, {double(i), 0.0, 0.0}});
    for (int i = 0; i < 20; ++i) {
      LocalMap map;
      map.id = i;
      map.utime = 5 * i * kOneSecond;
      map.end_utime = 5 * (i + 1) * kOneSecond;
      maps_.push_back(map);
    }
  }

  void add(int from_s, int to_s, Reason reason) {
    doubts_.push_back({to_s * kOneSecond, from_s * kOneSecond, reason, 0});
  }
  [[nodiscard]] std::vector<DoubtfulStretch> stretches() const {
    return doubtful_stretches(doubts_, contradictions_, DistanceAlong(path_), maps_);
  }

  Trajectory path_;
  std::vector<LocalMap> maps_;
  Spool<MotionDoubt> doubts_;
  std::vector<MapContradiction> contradictions_;
};

TEST_F(DoubtListTest, JoinsMotionsThatAreClose) {
  add(10, 11, Reason::kLost);
  add(12, 13, Reason::kAmbiguous);
  add(13, 14, Reason::kLost);
  add(41, 42, Reason::kPoor);
  const auto list = stretches();
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].from_utime, 10 * kOneSecond);
  EXPECT_EQ(list[0].to_utime, 14 * kOneSecond);
  EXPECT_NEAR(list[0].from_m, 10.0, 1e-9);
  EXPECT_NEAR(list[0].to_m, 14.0, 1e-9);
  EXPECT_EQ(list[0].motions, 3U);
  EXPECT_EQ(list[0].reasons, (std::vector<std::string>{"lost", "ambiguous"}));
  EXPECT_EQ(list[0].local_maps, (std::vector<int>{1, 2}));  // map 1 ends at 10 s
  EXPECT_EQ(list[1].local_maps, (std::vector<int>{8}));
}

TEST_F(DoubtListTest, TellsStretchesInALine) {
  EXPECT_EQ(stretches_text(stretches()), "");
  add(10, 12, Reason::kLost);
  EXPECT_EQ(stretches_text(stretches()), "1 doubtful stretch: at 10 to 12 m (lost)");
  for (const int from_s : {20, 30, 40, 50, 60, 70}) add(from_s, from_s, Reason::kAmbiguous);
  EXPECT_EQ(stretches_text(stretches()),
            "7 doubtful stretches: at 10 to 12 m (lost), at 20 m (ambiguous), at 30 m (ambiguous), "
            "at 40 m (ambiguous), at 50 m (ambiguous) and 2 more, see summary.json");
}

/// In a straight tunnel without wheels the estimated path may be any length.
TEST_F(DoubtListTest, TellsHowLongTheMotionWasNotMeasured) {
  add(10, 40, Reason::kDegenerate);
  EXPECT_EQ(stretches_text(stretches()),
            "1 doubtful stretch: at 10 to 40 m (degenerate, for 30 s)");
}

TEST_F(DoubtListTest, MarksThePosesOfStretches) {
  add(10, 12, Reason::kLost);
  const auto inside = [list = stretches()](int s) { return in_stretches(list, s * kOneSecond); };
  EXPECT_FALSE(inside(9));
  EXPECT_TRUE(inside(10));
  EXPECT_TRUE(inside(12));
  EXPECT_FALSE(inside(13));
}

/// An error between maps 6 and 7 and one between maps 12 and 13.
TEST_F(DoubtListTest, ExplainsAllContradictionsByTheFewestStretches) {
  add(2, 3, Reason::kLost);
  contradictions_ = {{4, 8, 30.0}, {2, 7, 40.0}, {6, 9, 30.0}, {10, 13, 50.0}, {12, 15, 25.0}};
  const auto list = stretches();
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[0].local_maps, (std::vector<int>{6, 7}));
  EXPECT_EQ(list[0].from_utime, 30 * kOneSecond);
  EXPECT_EQ(list[0].to_utime, 40 * kOneSecond);
  EXPECT_EQ(list[0].motions, 0U);
  EXPECT_EQ(list[1].local_maps, (std::vector<int>{12, 13}));
  EXPECT_EQ(stretches_text(list),
            "3 doubtful stretches: at 30 to 40 m (contradictory), at 60 to 70 m (contradictory), "
            "at 2 to 3 m (lost)");
  EXPECT_TRUE(in_stretches(list, 2 * kOneSecond));
  EXPECT_TRUE(in_stretches(list, 35 * kOneSecond));
}

TEST_F(DoubtListTest, LeavesOutWhatLiesInEarlierRuns) {
  maps_.erase(maps_.begin(), maps_.begin() + 10);
  contradictions_ = {{4, 8, 30.0}};
  EXPECT_TRUE(stretches().empty());
  contradictions_ = {{4, 12, 30.0}};
  ASSERT_EQ(stretches().size(), 1U);
  EXPECT_EQ(stretches().front().local_maps, (std::vector<int>{10, 11, 12}));
}

/// A doubt every 10 m over 100 km, and as many contradictions: a person reads a few hundred.
TEST_F(DoubtListTest, JoinsNeighboursOfALongRun) {
  constexpr int kTens = 10'000;
  path_.clear();
  maps_.clear();
  for (int i = 0; i <= 10 * kTens; ++i) {
    path_.push_back({i * kOneSecond, {double(i), 0.0, 0.0}});
  }
  for (int i = 0; i < kTens; ++i) {
    LocalMap map;
    map.id = i;
    map.utime = 10 * i * kOneSecond;
    map.end_utime = 10 * (i + 1) * kOneSecond;
    maps_.push_back(map);
    add(10 * i + 4, 10 * i + 5, i % 2 == 0 ? Reason::kLost : Reason::kAmbiguous);
    if (i % 4 == 1) contradictions_.push_back({i - 1, i, 30.0});
  }
  const auto list = stretches();
  EXPECT_LE(list.size(), 2 * kStretchesMax);
  std::size_t motions = 0;
  std::size_t maps = 0;
  for (const DoubtfulStretch& stretch : list) {
    motions += stretch.motions;
    if (stretch.motions == 0) maps += stretch.local_maps.size();
  }
  EXPECT_EQ(motions, std::size_t{kTens}) << "each belongs to one stretch";
  EXPECT_EQ(maps, std::size_t{kTens / 2});
  EXPECT_EQ(list.back().reasons, (std::vector<std::string>{"lost", "ambiguous"}));
  EXPECT_LT(stretches_text(list).size(), 500U);
}

}  // namespace
}  // namespace adit
