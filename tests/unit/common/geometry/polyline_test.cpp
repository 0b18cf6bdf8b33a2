// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/polyline.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(Polyline, InterpolatesAlongItsLength) {
  const Polyline line({{0.0, 0.0}, {3.0, 0.0}, {3.0, 4.0}});
  EXPECT_DOUBLE_EQ(line.length_m(), 7.0);
  EXPECT_EQ(line.at(1.0), Eigen::Vector2d(1.0, 0.0));
  EXPECT_EQ(line.at(5.0), Eigen::Vector2d(3.0, 2.0));
  EXPECT_EQ(line.at(-1.0), Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(line.at(9.0), Eigen::Vector2d(3.0, 4.0));
}

TEST(Polyline, HasADirectionAtItsEndsAndBends) {
  const Polyline line({{0.0, 0.0}, {3.0, 0.0}, {3.0, 4.0}});
  EXPECT_EQ(line.chord_at(0.0, 1.0), Eigen::Vector2d(1.0, 0.0));
  EXPECT_EQ(line.chord_at(3.0, 1.0), Eigen::Vector2d(1.0, 1.0));
  EXPECT_EQ(Polyline({{1.0, 1.0}}).chord_at(0.0, 1.0), Eigen::Vector2d(0.0, 0.0));
}

}  // namespace
}  // namespace adit
