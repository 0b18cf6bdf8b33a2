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
    doubts_.push_back({to_s * kOneSecond, from_s * kOneSecond, reason, {}});
  }
  [[nodiscard]] std::vector<DoubtfulStretch> stretches() const {
    return doubtful_stretches(doubts_, path_, maps_);
  }

  Trajectory path_;
  std::vector<LocalMap> maps_;
  std::vector<MatchDoubt> doubts_;
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

TEST_F(DoubtListTest, MarksThePosesOfStretches) {
  add(10, 12, Reason::kLost);
  const std::vector<bool> inside = in_stretches(stretches(), path_);
  EXPECT_FALSE(inside[9]);
  EXPECT_TRUE(inside[10]);
  EXPECT_TRUE(inside[12]);
  EXPECT_FALSE(inside[13]);
}

}  // namespace
}  // namespace adit
