// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/section/section_outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace adit {
namespace {

using std::numbers::pi;

SectionOutline circle(double radius_m, double sd_m = 0.0) {
  SectionOutline outline;
  for (SectionOutline::Ray& ray : outline.rays) ray = {radius_m, sd_m};
  return outline;
}

/// Around its middle.
SectionOutline rectangle(double width_m, double height_m) {
  SectionOutline outline;
  for (std::size_t i = 0; i < SectionOutline::kRays; ++i) {
    const Eigen::Vector2d d = SectionOutline::direction(i).cwiseAbs();
    const double to_side = d.x() > 1e-12 ? 0.5 * width_m / d.x() : 1e9;
    const double to_end = d.y() > 1e-12 ? 0.5 * height_m / d.y() : 1e9;
    outline.rays[i] = {std::min(to_side, to_end), 0.0};
  }
  return outline;
}

void hide(SectionOutline& outline, std::size_t from, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) outline.rays[(from + i) % SectionOutline::kRays] = {};
}

TEST(SectionOutline, MeasuresACircle) {
  const SectionMeasures measures = measure(circle(2.0), 0.0);
  EXPECT_DOUBLE_EQ(measures.width_m.value, 4.0);
  EXPECT_DOUBLE_EQ(measures.height_m.value, 4.0);
  // Polygons of 120 corners within a circle.
  EXPECT_NEAR(measures.area_m2.value, 60.0 * 4.0 * std::sin(2.0 * pi / 120.0), 1e-9);
  EXPECT_NEAR(measures.perimeter_m.value, 240.0 * 2.0 * std::sin(pi / 120.0), 1e-9);
  EXPECT_DOUBLE_EQ(measures.seen_share, 1.0);
  EXPECT_TRUE(measures.is_closed());
}

TEST(SectionOutline, MeasuresARectangle) {
  const SectionMeasures measures = measure(rectangle(4.0, 2.0), 0.0);
  EXPECT_DOUBLE_EQ(measures.width_m.value, 4.0);
  EXPECT_DOUBLE_EQ(measures.height_m.value, 2.0);
  EXPECT_NEAR(measures.area_m2.value, 8.0, 0.02);  // corners between rays are cut
  EXPECT_NEAR(measures.perimeter_m.value, 12.0, 0.2);
}

TEST(SectionOutline, PropagatesIndependentErrorsOfRays) {
  const SectionMeasures measures = measure(circle(2.0, 0.01), 0.0);
  EXPECT_NEAR(measures.width_m.sd, std::sqrt(2.0) * 0.01, 1e-9);
  // Each ray moves its sector of the circle.
  EXPECT_NEAR(measures.area_m2.sd, std::sqrt(120.0) * 0.01 * 4.0 * pi / 120.0, 1e-4);
}

TEST(SectionOutline, PropagatesTheCommonErrorOfRanges) {
  const SectionMeasures measures = measure(circle(2.0), 0.01);
  EXPECT_NEAR(measures.width_m.sd, 0.02, 1e-9);
  EXPECT_NEAR(measures.area_m2.sd, 4.0 * pi * 0.01, 1e-3);  // the circumference times the error
  EXPECT_NEAR(measures.perimeter_m.sd, 2.0 * pi * 0.01, 1e-9);
}

TEST(SectionOutline, IsOpenWhereASideTunnelBegins) {
  SectionOutline outline = rectangle(4.0, 2.0);
  hide(outline, 115, 11);  // 33° around the left
  const SectionMeasures measures = measure(outline, 0.0);
  EXPECT_FALSE(measures.is_closed());
  EXPECT_TRUE(std::isnan(measures.width_m.value));
  EXPECT_DOUBLE_EQ(measures.height_m.value, 2.0);
  EXPECT_NEAR(measures.gap_max_rad, 12.0 * SectionOutline::kStepRad, 1e-9);
}

TEST(SectionOutline, ClosesSmallGapsByAStraightLine) {
  SectionOutline outline = rectangle(4.0, 2.0);
  hide(outline, SectionOutline::kUp, 2);
  outline.close_small_gaps();
  EXPECT_NEAR(outline.rays[SectionOutline::kUp].distance_m, 1.0, 1e-9);
  EXPECT_GT(outline.rays[SectionOutline::kUp].sd_m, 0.0);
  SectionOutline wide = rectangle(4.0, 2.0);
  hide(wide, SectionOutline::kUp, 3);
  wide.close_small_gaps();
  EXPECT_FALSE(wide.rays[SectionOutline::kUp].seen());
}

TEST(SectionOutline, IsLessSureOfAnAreaWithAGap) {
  SectionOutline outline = rectangle(4.0, 2.0);
  hide(outline, 5, 5);  // around a corner
  const SectionMeasures measures = measure(outline, 0.0);
  EXPECT_TRUE(measures.is_closed());
  EXPECT_LT(std::abs(measures.area_m2.value - 8.0), 1.96 * measures.area_m2.sd);
}

}  // namespace
}  // namespace adit
