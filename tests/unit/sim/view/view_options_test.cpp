// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view/view_options.hpp"

#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(ViewPose, IsMetresAndDegrees) {
  const Pose2 place = parse_view_pose("308.5,-2,90");
  EXPECT_EQ(place.x, 308.5);
  EXPECT_EQ(place.y, -2.0);
  EXPECT_DOUBLE_EQ(place.theta, std::numbers::pi / 2.0);
}

TEST(ViewPose, NormalisesHeadings) {
  EXPECT_NEAR(parse_view_pose("0,0,-270").theta, std::numbers::pi / 2.0, 1e-12);
}

TEST(ViewPose, RejectsTextThatIsNotThreeNumbers) {
  for (const char* text : {"", "1", "1,2", "1,2,", "1,2,3,4", "1,2,3 ", "1;2;3", "a,2,3", "1,,3",
                           "1,2,nan", "inf,2,3"}) {
    EXPECT_THROW(parse_view_pose(text), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace adit
