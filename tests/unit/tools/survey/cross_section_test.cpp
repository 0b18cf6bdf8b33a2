// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/section/cross_section.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/tools/survey/survey_scene.hpp"

namespace adit {
namespace {

std::vector<CentreLine> line_along_x(double to_m, bool to_junction = false) {
  return {{1, 0, 1, 4.0, false, to_junction, Polyline({{0.0, 0.0}, {to_m, 0.0}})}};
}

class CrossSections : public testing::Test {
 protected:
  std::vector<CrossSection> sections_of(const Cloud& cloud, double every_m = 5.0) {
    clouds_ = test::stored({cloud});
    const RegisteredCloud registered(clouds_, graph_);
    const auto path = test::path_along_x(0.0, 10.0);
    return cross_sections(registered, section_planes(line_along_x(10.0), path, every_m));
  }

  SurveyGraph graph_ = test::graph_along_x(3, 5.0);
  CloudStore clouds_;
};

TEST_F(CrossSections, MeasureABoxTunnel) {
  const auto sections = sections_of(test::scan_of_tunnel(-1.0, 11.0, {2.0, 2.2}));
  ASSERT_EQ(sections.size(), 3U);
  for (const CrossSection& section : sections) {
    EXPECT_TRUE(section.has_area());
    EXPECT_NEAR(section.measures.width_m.value, 4.0, 1e-3);
    EXPECT_NEAR(section.measures.height_m.value, 2.2, 1e-3);
    EXPECT_NEAR(section.measures.area_m2.value, 8.8, 0.05);  // corners between rays are cut
    EXPECT_NEAR(section.floor_m.value, 0.0, 1e-3);
    EXPECT_NEAR(section.roof_m.value, 2.2, 1e-3);
  }
  EXPECT_DOUBLE_EQ(sections[1].plane.chainage_m, 5.0);
}

TEST_F(CrossSections, IgnoreASurfaceBehindTheWall) {
  Cloud cloud = test::scan_of_tunnel(-1.0, 11.0);
  const Cloud beyond = test::scan_of_tunnel(-1.0, 11.0, {4.0, 2.0});
  cloud.lines.insert(cloud.lines.end(), beyond.lines.begin(), beyond.lines.end());
  for (const CrossSection& section : sections_of(cloud))
    EXPECT_NEAR(section.measures.width_m.value, 4.0, 0.01);
}

TEST_F(CrossSections, EndAtTheRoofBelowOtherWorkings) {
  Cloud cloud = test::scan_of_tunnel(-1.0, 11.0);
  for (CloudLine line : test::scan_of_tunnel(-1.0, 11.0).lines) {
    for (Eigen::Vector3f& p : line.points) p.z() += 6.0F;
    cloud.lines.insert(cloud.lines.end(), {line, line});  // seen more often
  }
  for (const CrossSection& section : sections_of(cloud)) {
    EXPECT_NEAR(section.measures.height_m.value, 2.0, 0.01);
    EXPECT_NEAR(section.roof_m.value, 2.0, 0.01);
  }
}

TEST_F(CrossSections, AreEmptyWithoutReturnsBeside) {
  EXPECT_EQ(sections_of(test::scan_of_tunnel(-1.0, 3.0)).size(), 1U);
}

TEST_F(CrossSections, HaveNoWidthInAJunction) {
  const auto path = test::path_along_x(0.0, 10.0);
  const auto planes = section_planes(line_along_x(10.0, true), path, 5.0);
  ASSERT_EQ(planes.size(), 3U);
  EXPECT_FALSE(planes[1].in_junction);
  EXPECT_TRUE(planes[2].in_junction);
}

TEST_F(CrossSections, TakeOverTheUncertaintyOfHeightsFromTheGraph) {
  std::vector<SurveyGraph::Node> nodes = graph_.nodes();
  for (SurveyGraph::Node& node : nodes) node.z_variance = 0.09;
  graph_ = SurveyGraph(nodes);
  for (const CrossSection& section : sections_of(test::scan_of_tunnel(-1.0, 11.0))) {
    EXPECT_GE(section.floor_m.sd, 0.3);
    EXPECT_LT(section.floor_m.sd, 0.31);
    EXPECT_LT(section.measures.height_m.sd, 0.1);  // both ends move together
  }
}

TEST(CentreLines, FollowTheLocalMapsNearThem) {
  std::vector<SurveyGraph::Node> nodes = test::graph_along_x(3, 5.0).nodes();
  for (SurveyGraph::Node& node : nodes)
    node.T_survey_local = LevelPose{{100.0, 50.0, 0.5 * M_PI}, 0.0} * node.T_map_local;
  CorridorGraph corridors;
  corridors.nodes = {{{0.0, 0.0}, CorridorNode::Kind::kJunction},
                     {{10.0, 0.0}, CorridorNode::Kind::kDeadEnd}};
  corridors.corridors = {{0, 1, 10.0, 4.0, {{0.0, 0.0}, {10.0, 0.0}}}};
  const auto lines = centre_lines(corridors, SurveyGraph(nodes));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].from_junction);
  EXPECT_FALSE(lines[0].to_junction);
  EXPECT_NEAR((lines[0].line.points().back() - Eigen::Vector2d(100.0, 60.0)).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace adit
