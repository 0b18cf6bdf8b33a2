// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/input/cloud_store.hpp"

#include <gtest/gtest.h>

#include "tests/unit/tools/survey/survey_scene.hpp"

namespace adit {
namespace {

TEST(CloudStore, GivesLinesBackBitForBit) {
  CloudStore store;
  // More than the block that stays in memory, and an empty one between them.
  const Cloud first = test::scan_of_tunnel(-10.0, 10.0);
  const Cloud last = test::scan_of_tunnel(0.0, 3.0);
  for (const Cloud& cloud : {first, Cloud{}, last}) store.push_back(cloud);
  ASSERT_EQ(store.size(), 3U);
  EXPECT_EQ(store.points(0), first.points());
  EXPECT_EQ(store.points(1), 0U);
  EXPECT_TRUE(store.lines(1).empty());
  for (const auto& [i, cloud] : {std::pair(0U, &first), std::pair(2U, &last)}) {
    EXPECT_EQ(store[i].utime, cloud->utime);
    EXPECT_EQ(store[i].lines.front().origin, cloud->lines.front().origin);
    const auto lines = store.lines(i);
    ASSERT_EQ(lines.size(), cloud->lines.size());
    for (std::size_t k = 0; k < lines.size(); ++k) {
      EXPECT_EQ(lines[k].utime, cloud->lines[k].utime);
      EXPECT_EQ(lines[k].origin, cloud->lines[k].origin);
      EXPECT_EQ(lines[k].points, cloud->lines[k].points);
    }
  }
}

TEST(CloudStore, LeavesOutMisses) {
  Cloud cloud = test::scan_of_tunnel(0.0, 1.0);
  cloud.lines.front().misses.emplace_back(1.0F, 0.0F, 0.0F);
  CloudStore store;
  store.push_back(cloud);
  EXPECT_TRUE(store.lines(0).front().misses.empty());
}

}  // namespace
}  // namespace adit
