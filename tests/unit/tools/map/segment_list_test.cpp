// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/segment_list.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

enum class Seen { kAll, kLost, kDegenerate };

/// Adds scans 0.1 m and 0.2 s apart.
class SegmentListTest : public testing::Test {
 protected:
  void add(int scans, Seen seen) {
    for (int i = 0; i < scans; ++i) {
      ScanMatch match;
      match.reference_utime = utime_;
      match.utime = utime_ += 200'000;
      match.status = seen == Seen::kLost ? ScanMatch::Status::kLost : ScanMatch::Status::kMatched;
      if (seen == Seen::kDegenerate) match.degenerate.resize(1);
      match.T_reference_body = {0.1, 0.0, 0.0};
      list_.add(match);
    }
  }

  std::int64_t utime_ = 1'000'000;
  SegmentList list_;
};

TEST_F(SegmentListTest, JoinsSegmentsOfOneKindThatAreClose) {
  add(10, Seen::kDegenerate);
  add(10, Seen::kAll);  // 1 m
  add(5, Seen::kLost);
  add(10, Seen::kDegenerate);
  ASSERT_EQ(list_.segments().size(), 2U);
  const auto& degenerate = list_.segments()[0];
  EXPECT_FALSE(degenerate.lost);
  EXPECT_FALSE(degenerate.filled);
  EXPECT_EQ(degenerate.scans, 20U);
  EXPECT_EQ(degenerate.intervals, 2U);
  EXPECT_NEAR(degenerate.length_m, 2.0, 1e-9);
  EXPECT_EQ(degenerate.from_utime, 1'000'000);
  EXPECT_EQ(degenerate.to_utime, utime_);
  EXPECT_TRUE(list_.segments()[1].lost);
  EXPECT_EQ(list_.segments()[1].scans, 5U);
}

TEST_F(SegmentListTest, KeepsDistantSegmentsApart) {
  add(10, Seen::kDegenerate);
  add(25, Seen::kAll);
  add(10, Seen::kDegenerate);
  EXPECT_EQ(list_.segments().size(), 2U);
  EXPECT_EQ(list_.joined_m(), SegmentList::kJoinedM);
}

TEST_F(SegmentListTest, IsBoundedForAnyLengthOfALog) {
  constexpr int kIntervals = 5000;
  for (int i = 0; i < kIntervals; ++i) {
    add(1, i % 2 == 0 ? Seen::kLost : Seen::kDegenerate);
    add(30, Seen::kAll);
  }
  EXPECT_LE(list_.segments().size(), SegmentList::kSegmentsMax);
  EXPECT_GT(list_.joined_m(), SegmentList::kJoinedM);
  std::size_t intervals = 0;
  double length_m = 0.0;
  for (const auto& segment : list_.segments()) {
    intervals += segment.intervals;
    length_m += segment.length_m;
  }
  EXPECT_EQ(intervals, kIntervals);  // nothing is forgotten
  EXPECT_NEAR(length_m, 0.1 * kIntervals, 1e-6);
}

}  // namespace
}  // namespace adit
