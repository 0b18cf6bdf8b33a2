// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/plan/tunnel_line.hpp"

#include <cmath>
#include <functional>
#include <stdexcept>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace adit {
namespace {

using testing::HasSubstr;

const TunnelLine kBent{"bent", {{0.0, 0.0}, {10.0, 0.0}, {10.0, 5.0}}, 3.0, false};

std::string error_of(const PlanDescription& plan) {
  try {
    tunnel_lines(plan);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(TunnelLine, IsParametrisedByDistance) {
  EXPECT_DOUBLE_EQ(kBent.length_m(), 15.0);
  EXPECT_EQ(kBent.at(4.0).p_world, Eigen::Vector2d(4.0, 0.0));
  EXPECT_EQ(kBent.at(12.0).p_world, Eigen::Vector2d(10.0, 2.0));
  EXPECT_DOUBLE_EQ(kBent.at(12.0).heading_rad, std::atan2(1.0, 0.0));
}

TEST(TunnelLine, ClampsDistancesToItsEnds) {
  EXPECT_EQ(kBent.at(-1.0).p_world, Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(kBent.at(99.0).p_world, Eigen::Vector2d(10.0, 5.0));
}

TEST(TunnelLine, PointsBesideItAreToItsLeft) {
  EXPECT_TRUE(kBent.beside(4.0, 1.0).isApprox(Eigen::Vector2d(4.0, 1.0)));
  EXPECT_TRUE(kBent.beside(12.0, 1.0).isApprox(Eigen::Vector2d(9.0, 2.0)));
}

TEST(TunnelLine, MeasuresTheDistanceOfAPoint) {
  EXPECT_DOUBLE_EQ(kBent.distance_m({4.0, -2.0}), 2.0);
  EXPECT_DOUBLE_EQ(kBent.distance_m({13.0, 9.0}), 5.0);
}

TEST(TunnelLine, GivesThePositionAlongAndAcross) {
  for (const auto& [p, s_m, across_m] : {std::tuple(Eigen::Vector2d(4.0, 1.0), 4.0, 1.0),
                                         {{4.0, -2.0}, 4.0, -2.0},
                                         {{9.0, 4.0}, 14.0, 1.0},
                                         {{13.0, 4.0}, 14.0, -3.0},
                                         {{-3.0, 0.0}, 0.0, 3.0}}) {
    EXPECT_DOUBLE_EQ(kBent.place_of(p).s_m, s_m);
    EXPECT_DOUBLE_EQ(kBent.place_of(p).across_m, across_m);
  }
}

TEST(TunnelLine, ReachesToItsWalls) {
  EXPECT_TRUE(kBent.contains({4.0, -1.5}));
  EXPECT_FALSE(kBent.contains({4.0, -1.6}));
}

TEST(TunnelLines, APanelBecomesEntriesAndSlantedCrosscuts) {
  PlanDescription plan;
  PanelDescription panel;
  panel.name = "p";
  panel.T_world_panel = {100.0, 0.0, std::atan2(1.0, 0.0)};  // entries run along y, the next to −x
  panel.entries = 3;
  panel.crosscuts = 2;
  panel.slant_rad = 0.5;
  plan.panels = {panel};
  const std::vector<TunnelLine> lines = tunnel_lines(plan);
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[2].name, "p_entry_2");
  EXPECT_TRUE(lines[2].points[0].isApprox(Eigen::Vector2d(76.0, 0.0)));
  EXPECT_EQ(lines[4].name, "p_crosscut_1");
  EXPECT_TRUE(lines[4].points[0].isApprox(Eigen::Vector2d(100.0, 30.0)));
  EXPECT_TRUE(lines[4].points[1].isApprox(Eigen::Vector2d(76.0, 30.0 + 24.0 * std::tan(0.5))));
}

TEST(TunnelLines, SayWhatIsWrong) {
  PlanDescription plan;
  plan.tunnels = {{"odd", {0.0, 0.0, 1.0}, 3.0, false}};
  EXPECT_THAT(error_of(plan), HasSubstr("'odd'"));
  plan.tunnels = {{"short", {0.0, 0.0}, 3.0, false}};
  EXPECT_THAT(error_of(plan), HasSubstr("'short'"));
  plan.tunnels = {{"none", {1.0, 1.0, 1.0, 1.0}, 3.0, false}};
  EXPECT_THAT(error_of(plan), HasSubstr("'none'"));
  plan.tunnels = {{"nan", {1.0, 1.0, std::nan(""), 1.0}, 3.0, false}};
  EXPECT_THAT(error_of(plan), HasSubstr("'nan'"));
  plan.tunnels = {{"twice", {0.0, 0.0, 1.0, 1.0}, 3.0, false},
                  {"twice", {0.0, 0.0, 1.0, 0.0}, 3.0, false}};
  EXPECT_THAT(error_of(plan), HasSubstr("'twice'"));
  plan.tunnels.clear();
  plan.panels = {{}};
  plan.panels[0].name = "p";
  plan.panels[0].crosscuts = 9;
  EXPECT_THAT(error_of(plan), HasSubstr("'p_crosscut_3'"));
}

TEST(TunnelLines, AnUnknownTunnelIsRejectedWithTheKnownNames) {
  try {
    find_tunnel({kBent}, "other", "pit 'deep'");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("pit 'deep'"));
    EXPECT_THAT(error.what(), HasSubstr("bent"));
  }
}

}  // namespace
}  // namespace adit
