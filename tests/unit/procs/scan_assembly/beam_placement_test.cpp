// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/beam_placement.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(InterpolationBuffer, InterpolatesInAnyOrderOfInsertion) {
  InterpolationBuffer<double> buffer;
  EXPECT_FALSE(buffer.at(0));
  EXPECT_TRUE(buffer.add(2000, 3.0));
  EXPECT_TRUE(buffer.add(1000, 1.0));
  EXPECT_FALSE(buffer.add(2000, 9.0));
  EXPECT_DOUBLE_EQ(*buffer.at(1500), 2.0);
  EXPECT_DOUBLE_EQ(*buffer.at(1000), 1.0);
  EXPECT_DOUBLE_EQ(*buffer.at(0), 1.0);
  EXPECT_DOUBLE_EQ(*buffer.at(5000), 3.0);
}

TEST(InterpolationBuffer, InterpolatesHeadingsOverTheShorterArc) {
  InterpolationBuffer<Pose2> buffer;
  buffer.add(0, {1.0, 2.0, 3.1});
  buffer.add(1000, {1.0, 2.0, -3.1});
  EXPECT_NEAR(std::abs(buffer.at(500)->theta), std::numbers::pi, 1e-12);
}

}  // namespace
}  // namespace adit
