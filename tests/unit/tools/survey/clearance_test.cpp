// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/section/clearance.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace adit {
namespace {

/// A section 3 m wide and 2 m high around a point 0.9 m above the floor, with a block on the floor
/// from its right wall: 0.8 m wide and 0.6 m high.
CrossSection section() {
  CrossSection section;
  for (std::size_t i = 0; i < SectionOutline::kRays; ++i) {
    const Eigen::Vector2d d = SectionOutline::direction(i);
    double distance = std::numeric_limits<double>::infinity();
    const auto meet = [&](double at, double direction) {
      const double t = at / direction;
      return t > 0.0 && std::isfinite(t) ? t : std::numeric_limits<double>::infinity();
    };
    distance = std::min({meet(1.5, d.x()), meet(-1.5, d.x()), meet(1.1, d.y()), meet(-0.9, d.y())});
    const double top = meet(-0.3, d.y());  // of the block
    if (top * d.x() < -0.7) distance = std::min(distance, top);
    const double side = meet(-0.7, d.x());
    if (side * d.y() < -0.3) distance = std::min(distance, side);
    section.outline.rays[i] = {distance, 0.01};
  }
  section.measures = measure(section.outline, 0.004);
  section.plane.width_expected_m = 3.0;
  return section;
}

TEST(Clearance, IsThatOfTheBestPlace) {
  const auto person = clearance_of(section(), {"person", 0.7, 1.9});
  ASSERT_TRUE(person);
  EXPECT_TRUE(person->fits());
  EXPECT_NEAR(person->above_m, 0.1, 0.03);    // rays cut corners
  EXPECT_NEAR(person->offset_m, 0.4, 0.08);   // between the block and the left wall
  EXPECT_NEAR(person->beside_m, 0.75, 0.12);  // of 2.2 m less 0.7 m; rays cut the upper corner
}

TEST(Clearance, IsNegativeWhereItDoesNotFit) {
  const auto high = clearance_of(section(), {"rig", 1.0, 2.5});
  ASSERT_TRUE(high);
  EXPECT_FALSE(high->fits());
  EXPECT_NEAR(high->above_m, -0.5, 0.03);
  // Over the block there are 1.4 m.
  const auto wide = clearance_of(section(), {"car", 2.6, 1.5});
  ASSERT_TRUE(wide);
  EXPECT_NEAR(wide->above_m, -0.1, 0.05);
}

TEST(Clearance, IsUnknownWhereTheOutlineIs) {
  CrossSection open = section();
  for (std::size_t i = 0; i < 20; ++i) open.outline.rays[i] = {};
  open.measures = measure(open.outline, 0.004);
  EXPECT_FALSE(clearance_of(open, {"person", 0.7, 1.9}));
}

TEST(Clearance, IsATable) {
  const std::string table = clearance_table({section()}, usual_envelopes({}), SurveyFrame::local());
  EXPECT_THAT(table, testing::HasSubstr(",person,0.70,1.90,yes,"));
  EXPECT_THAT(table, testing::HasSubstr(",robot,1.20,1.00,yes,"));
}

}  // namespace
}  // namespace adit
