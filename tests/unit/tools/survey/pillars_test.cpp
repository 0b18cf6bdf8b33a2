// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/plan/pillars.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kRoomCellM = 0.1;

/// A room of 20 m by 20 m, 2 m high, with pillars: 4 m by 6 m, and 1.5 m by 5 m, on the walls of
/// which the returns are: in cells that reach from 0.05 m within to 0.05 m beyond them. Nothing is
/// seen of the rock behind.
ColumnGrid room() {
  ColumnGrid grid{kRoomCellM, Grid2<SurveyColumn>(CellBox{{-5, -5}, {206, 206}})};
  for (std::size_t i = 0; i < grid.columns.size(); ++i) {
    // Walls through the middles of cells.
    const Eigen::Vector2d p = kRoomCellM * grid.columns.cell(i).cast<double>();
    const auto in = [&](double x0, double x1, double y0, double y1) {
      return p.x() > x0 && p.x() < x1 && p.y() > y0 && p.y() < y1;
    };
    const auto is_rock = [&](double by_m) {
      return !in(by_m, 20.0 - by_m, by_m, 20.0 - by_m) ||
             in(4.0 - by_m, 8.0 + by_m, 4.0 - by_m, 10.0 + by_m) ||
             in(13.0 - by_m, 14.5 + by_m, 10.0 - by_m, 15.0 + by_m);
    };
    SurveyColumn& column = grid.columns[i];
    if (is_rock(-0.5 * kRoomCellM - 1e-9)) continue;
    column.kind = SurveyColumn::Kind::kWall;
    if (is_rock(0.5 * kRoomCellM)) continue;
    column.kind = SurveyColumn::Kind::kVoid;
    column.floor_m = 0.0F;
    column.roof_m = 2.0F;
  }
  return grid;
}

TEST(Pillars, HaveTheirAreasAndWidths) {
  const auto pillars = pillars_of(room());
  ASSERT_EQ(pillars.size(), 2U);
  EXPECT_NEAR(pillars[0].area_m2.value, 7.5, 0.1);  // corners of contours are cut
  EXPECT_NEAR(pillars[0].width_m, 1.5, 0.11);       // a cell
  EXPECT_NEAR(pillars[0].height_m, 2.0, 1e-6);
  EXPECT_TRUE(pillars[0].is_slender());
  EXPECT_NEAR(pillars[1].area_m2.value, 24.0, 0.1);
  EXPECT_NEAR(pillars[1].width_m, 4.0, 0.11);
  EXPECT_FALSE(pillars[1].is_slender());
}

/// The room, of whose larger pillar the wall at x = 8 m is not seen from y = 4.5 m on.
ColumnGrid room_unseen_for(double length_m) {
  ColumnGrid grid = room();
  for (std::size_t i = 0; i < grid.columns.size(); ++i) {
    const Eigen::Vector2d p = kRoomCellM * grid.columns.cell(i).cast<double>();
    if (grid.columns[i].kind == SurveyColumn::Kind::kWall && std::abs(p.x() - 8.0) < 0.3 &&
        p.y() > 4.5 && p.y() < 4.5 + length_m)
      grid.columns[i] = {};
  }
  return grid;
}

TEST(Pillars, AreLessCertainWhereTheirWallWasNotSeen) {
  const Pillar whole = pillars_of(room()).back();
  EXPECT_EQ(whole.unseen_m, 0.0);
  EXPECT_TRUE(whole.is_closed());
  const Pillar part = pillars_of(room_unseen_for(1.8)).back();
  EXPECT_NEAR(part.gap_m, 1.8 - 0.6, 0.25);  // what is near the ends counts as seen
  EXPECT_TRUE(part.is_closed());
  EXPECT_GT(part.area_m2.sd, whole.area_m2.sd);
  const Pillar open = pillars_of(room_unseen_for(4.0)).back();
  EXPECT_NEAR(open.unseen_m, 4.0 - 0.6, 0.25);
  EXPECT_FALSE(open.is_closed());
  EXPECT_GT(open.area_m2.sd, part.area_m2.sd);
}

TEST(Pillars, AreNoneWhereNothingWasSeen) {
  ColumnGrid grid = room();
  for (std::size_t i = 0; i < grid.columns.size(); ++i) {
    const Eigen::Vector2d p = kRoomCellM * grid.columns.cell(i).cast<double>();
    if (grid.columns[i].kind == SurveyColumn::Kind::kWall && p.x() > 12.0 && p.x() < 16.0 &&
        p.y() > 9.0 && p.y() < 16.0)
      grid.columns[i] = {};
  }
  EXPECT_EQ(pillars_of(grid).size(), 1U);
}

TEST(Pillars, GiveTheExtractionRatio) {
  const Measured void_area{400.0 - 31.5, 1.0};
  const Extraction result = extraction(pillars_of(room()), void_area);
  EXPECT_NEAR(result.ratio.value, 1.0 - 31.5 / 400.0, 0.001);
  EXPECT_GT(result.ratio.sd, 0.0);
  EXPECT_TRUE(std::isnan(extraction({}, void_area).ratio.value));
}

TEST(Pillars, AreATable) {
  const std::string table = pillar_table(pillars_of(room()), SurveyFrame::local());
  EXPECT_THAT(table, testing::StartsWith("pillar,x_m,y_m,"));
  EXPECT_THAT(table, testing::HasSubstr("\n1,13.8"));
}

}  // namespace
}  // namespace adit
