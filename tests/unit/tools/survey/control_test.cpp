// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/tools/survey/survey_scene.hpp"
#include "tools/survey/control/control_file.hpp"
#include "tools/survey/control/control_points.hpp"
#include "tools/survey/control/height_adjustment.hpp"
#include "tools/survey/control/plan_network.hpp"
#include "tools/survey/files/grid_system.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

constexpr const char* kHeading = "name,easting_m,northing_m,elevation_m,place,x_m,y_m,z_m,sd_m\n";

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

std::string parse_error(const std::string& rows) {
  return error_of([&] { parse_control(kHeading + rows, "points.csv"); });
}

TEST(ControlFile, ReadsPointsLevelsAndPlaces) {
  const auto rows = parse_control(std::string(kHeading) +
                                      "# pegs\nP1, 456123.420,5612345.11,231.4,start\r\n\n"
                                      "P2,456171.0,5612371.9,,time 1054252911.5,,,,0.05\n"
                                      "L3,,,230.9,map,54.2,12.1,-0.35\n"
                                      "T4,456180.9,5612399.0,,scan 12,3.4,-1.25,0.87\n",
                                  "points.csv");
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0].name, "P1");
  EXPECT_EQ(rows[0].plan, Eigen::Vector2d(456123.42, 5612345.11));
  EXPECT_EQ(rows[0].elevation_m, 231.4);
  EXPECT_EQ(rows[0].place, ControlRow::Place::kStart);
  EXPECT_EQ(rows[1].utime, 1'054'252'911'500'000);
  EXPECT_EQ(rows[1].sd_m, 0.05);
  EXPECT_FALSE(rows[1].elevation_m);
  EXPECT_FALSE(rows[2].plan);
  EXPECT_EQ(rows[2].offset, Eigen::Vector3d(54.2, 12.1, -0.35));
  EXPECT_EQ(rows[3].scan, 12);
}

TEST(ControlFile, NamesTheLineOfAMistake) {
  EXPECT_THAT(parse_error("A,1,2,3,start\nB,1.5x,2,3,map\n"),
              HasSubstr("points.csv:3: easting_m is no number: '1.5x'"));
  EXPECT_THAT(parse_error("A,1,,3,start\n"), HasSubstr("easting without northing"));
  EXPECT_THAT(parse_error("A,1,2,3,portal\n"), HasSubstr("place is start, map"));
  EXPECT_THAT(parse_error("A,,,,start\n"), HasSubstr("neither"));
  EXPECT_THAT(parse_error("A,1,2,3,start,0,0,0,-1\n"), HasSubstr("sd_m"));
  EXPECT_THAT(parse_error(""), HasSubstr("no control point"));
  EXPECT_THAT(error_of([] { parse_control("name,easting,northing_m,place\n", "p.csv"); }),
              HasSubstr("unknown column 'easting'; did you mean 'easting_m'?"));
}

TEST(ControlFile, RejectsAPointThatIsGivenTwice) {
  EXPECT_THAT(parse_error("A,1,2,3,start\nA,5,6,7,map,1,1,1\n"), HasSubstr("same name"));
  EXPECT_THAT(parse_error("A,1,2,3,start\nB,1,2,3,map,1,1,1\n"), HasSubstr("same coordinates"));
  EXPECT_THAT(parse_error("A,1,2,3,start\nB,5,6,7,start\n"), HasSubstr("same place"));
}

TEST(GridSystem, ComesFromProj) {
  const GridSystem utm = grid_system("EPSG:25832");
  EXPECT_TRUE(utm.is_projected);
  EXPECT_EQ(utm.crs_name, "urn:ogc:def:crs:EPSG::25832");
  // On the central meridian the scale is 0.9996; 100 km east of it 0.9996 (1 + x²/2R²).
  const auto central = grid_factors(utm, {500000.0, 5600000.0});
  ASSERT_TRUE(central);
  EXPECT_NEAR(central->scale, 0.9996, 1e-7);
  EXPECT_NEAR(central->convergence_rad, 0.0, 1e-9);
  const auto east = grid_factors(utm, {600000.0, 5600000.0});
  ASSERT_TRUE(east);
  EXPECT_NEAR(east->scale, 0.9996 * (1.0 + 0.5 * std::pow(100e3 / 6.38e6, 2)), 2e-6);
  EXPECT_NEAR(std::abs(east->convergence_rad), 0.0189, 5e-4);  // Δλ sin φ
  EXPECT_TRUE(east->in_area);
}

TEST(GridSystem, RejectsWhatHasNoMetres) {
  EXPECT_THAT(error_of([] { grid_system("EPSG:4326"); }), HasSubstr("degrees"));
  EXPECT_THAT(error_of([] { grid_system("EPSG:2272"); }), HasSubstr("not in metres"));
  EXPECT_THAT(error_of([] { grid_system("EPSG:99999999"); }), HasSubstr("no coordinate system"));
  EXPECT_FALSE(grid_system("local").is_projected);
}

/// Points of a mission along a bent path, with the coordinates that `grid_of` gives.
std::vector<ControlPoint> points_with(
    const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& grid_of) {
  std::vector<ControlPoint> points;
  for (const auto& p :
       {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(40.0, 5.0), Eigen::Vector2d(55.0, 42.0)}) {
    ControlPoint point;
    point.row.name = "P";
    point.row.plan = grid_of(p);
    point.p_map = {p.x(), p.y(), 0.1 * p.x()};
    points.push_back(point);
  }
  return points;
}

Eigen::Vector2d turned(const Eigen::Vector2d& p) { return Pose2{0.0, 0.0, 0.6} * p; }
const Eigen::Vector2d kCorner(456100.0, 5612300.0);

std::string implausible(const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& grid_of,
                        const std::string& crs = "EPSG:25832") {
  return error_of([&] { require_plausible(points_with(grid_of), grid_system(crs), "points.csv"); });
}

TEST(ControlPoints, NameTheLikelyMistake) {
  const auto right = [](const Eigen::Vector2d& p) { return Eigen::Vector2d(kCorner + turned(p)); };
  EXPECT_EQ(implausible(right), "");
  EXPECT_THAT(implausible([&](const auto& p) { return Eigen::Vector2d(right(p).reverse()); }),
              HasSubstr("look exchanged"));
  EXPECT_THAT(implausible([](const auto& p) { return Eigen::Vector2d(8.4 + 1e-5 * p.x(), 50.6); }),
              HasSubstr("look like degrees"));
  EXPECT_THAT(implausible([&](const auto& p) { return Eigen::Vector2d(right(p) / 0.3048); }),
              HasSubstr("look like feet"));
  EXPECT_THAT(implausible([&](const auto& p) { return Eigen::Vector2d(right(p).x() + 2e6, 5e5); }),
              HasSubstr("outside of the area"));
}

TEST(ControlPoints, NameTheLikelyMistakeOnAMinesOwnGrid) {
  const auto right = [](const Eigen::Vector2d& p) { return turned(p); };
  EXPECT_EQ(implausible(right, "local"), "");
  EXPECT_THAT(
      implausible([&](const auto& p) { return Eigen::Vector2d(right(p).reverse()); }, "local"),
      HasSubstr("look exchanged"));
  EXPECT_THAT(
      implausible([&](const auto& p) { return Eigen::Vector2d(right(p) / 0.3048); }, "local"),
      HasSubstr("feet"));
  EXPECT_THAT(implausible([&](const auto& p) { return Eigen::Vector2d(1.5 * right(p)); }, "local"),
              HasSubstr("another unit"));
}

TEST(ControlPoints, FixNoBearingAlone) {
  auto points = points_with(turned);
  points.resize(1);
  EXPECT_THAT(error_of([&] { require_plausible(points, grid_system("local"), "p.csv"); }),
              HasSubstr("needs two points"));
}

TEST(ControlPoints, HaveElevationsInFeet) {
  auto points = points_with(turned);
  for (ControlPoint& point : points) point.row.elevation_m = point.p_map.z() / 0.3048;
  EXPECT_THAT(error_of([&] { require_plausible(points, grid_system("local"), "p.csv"); }),
              HasSubstr("elevations look like feet"));
}

TEST(PlanFit, FindsTheMotionAndTheScaleItLeavesOut) {
  const std::vector<Eigen::Vector2d> from{{0.0, 0.0}, {10.0, 0.0}, {10.0, 20.0}};
  const Pose2 T{3.0, -2.0, 1.1};
  std::vector<Eigen::Vector2d> to;
  for (const Eigen::Vector2d& p : from) to.push_back(T * p);
  const PlanFit fit = fit_plan(from, to);
  EXPECT_NEAR((fit.T_to_from.vector() - T.vector()).norm(), 0.0, 1e-9);
  EXPECT_NEAR(fit.rms_m, 0.0, 1e-9);
  EXPECT_NEAR(fit.scale, 1.0, 1e-12);
}

/// A chain of local maps along x whose measured headings drift, in a grid where it is straight.
class DriftingChain : public testing::Test {
 protected:
  DriftingChain() {
    const Eigen::Matrix3d information = Eigen::Vector3d(1e4, 1e4, 1e4).asDiagonal();
    std::vector<SurveyGraph::Node> nodes;
    Pose2 T_map_local;
    for (int i = 0; i < kMaps; ++i) {
      if (i > 0) {
        const Pose2 step{5.0, 0.0, 0.01};
        T_map_local = T_map_local * step;
        graph_.constraints.push_back({{i - 1, i, step, information}});
      }
      graph_.poses.push_back(T_map_local);
      SurveyGraph::Node node;
      node.id = i;
      node.T_map_local = {T_map_local, 0.0};
      node.utime = test::kSurveyUtime + i;
      nodes.push_back(node);
    }
    free_network_ = SurveyGraph(nodes);
  }

  /// True places of local maps, on a line to the north-east; one may be wrong.
  [[nodiscard]] std::vector<ControlPoint> points(const std::vector<int>& maps,
                                                 int wrong = -1) const {
    std::vector<ControlPoint> points;
    for (const int map : maps) {
      ControlPoint point;
      point.row.plan = true_place(map);
      if (map == wrong) *point.row.plan += Eigen::Vector2d(0.3, 0.0);
      point.node = static_cast<std::size_t>(map);
      point.p_map = free_network_.nodes()[point.node].T_map_local.translation();
      points.push_back(point);
    }
    return points;
  }
  static Eigen::Vector2d true_place(int map) {
    return Eigen::Vector2d(1000.0, 2000.0) +
           5.0 * map * Eigen::Vector2d(std::sqrt(0.5), std::sqrt(0.5));
  }

  static constexpr int kMaps = 21;
  MapGraph graph_;
  SurveyGraph free_network_{std::vector<SurveyGraph::Node>{}};
  const MinePlane plane_{{1000.0, 2000.0}, 1.0};
};

TEST_F(DriftingChain, BendsToTheControlPoints) {
  const PlanNetwork network(points({0, 10, 20}), plane_, free_network_, graph_);
  for (const int map : {0, 5, 10, 15, 20}) {
    const Eigen::Vector2d p = network.T_survey_local(map).translation() + plane_.origin;
    // Between points the drift of 0.01 rad per local map bends the chain by 0.3 m.
    EXPECT_NEAR((p - true_place(map)).norm(), 0.0, map % 10 == 0 ? 0.05 : 0.4) << map;
  }
}

TEST_F(DriftingChain, IsLeastSureFarFromThePoints) {
  const PlanNetwork network(points({0, 10}), plane_, free_network_, graph_);
  const auto covariances = network.covariances({0, 5, 10, 20});
  const auto largest = [&](std::size_t i) { return covariances[i].topLeftCorner<2, 2>().trace(); };
  EXPECT_NEAR(largest(0), 2.0 * (4e-4 + 1e-4), 2e-4);  // of the point and of finding it
  EXPECT_GT(largest(1), largest(0));
  EXPECT_GT(largest(3), 10.0 * largest(2));
}

TEST_F(DriftingChain, FindsABlunder) {
  MapGraph straight = graph_;
  for (MapConstraint& constraint : straight.constraints)
    constraint.measured.T_from_to = {5.0, 0.0, 0.0};
  const PlanNetwork right(points({0, 5, 10, 15, 20}), plane_, free_network_, straight);
  for (const auto& residual : right.residuals()) EXPECT_LT(residual.test.value(), 1.0);
  const PlanNetwork wrong(points({0, 5, 10, 15, 20}, 10), plane_, free_network_, straight);
  const auto residuals = wrong.residuals();
  for (const std::size_t i : {0U, 1U, 3U, 4U})
    EXPECT_LT(residuals[i].test.value(), residuals[2].test.value());
  EXPECT_GT(residuals[2].test.value(), 13.82);
}

TEST_F(DriftingChain, HasNoTestWithTwoPoints) {
  const PlanNetwork network(points({0, 20}), plane_, free_network_, graph_);
  for (const auto& residual : network.residuals()) EXPECT_FALSE(residual.test);
}

/// Heights of a random walk of 0.01 m² per local map.
class HeightChain : public testing::Test {
 protected:
  static SurveyGraph graph() {
    std::vector<SurveyGraph::Node> nodes = test::graph_along_x(11, 5.0).nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i)
      nodes[i].z_variance = 0.01 * static_cast<double>(i);
    return SurveyGraph(nodes);
  }
  /// Covariances of a random walk.
  static Eigen::MatrixXd covariances(const std::vector<HeightObservation>& observations) {
    Eigen::MatrixXd with(11, static_cast<Eigen::Index>(observations.size()));
    for (Eigen::Index i = 0; i < 11; ++i) {
      for (std::size_t k = 0; k < observations.size(); ++k)
        with(i, static_cast<Eigen::Index>(k)) =
            0.01 * static_cast<double>(
                       std::min<std::size_t>(static_cast<std::size_t>(i), observations[k].node));
    }
    return with;
  }
};

TEST_F(HeightChain, IsStretchedBetweenTwoElevations) {
  const std::vector<HeightObservation> given{{0, 100.0, 1e-6}, {10, 101.0, 1e-6}};
  const HeightSolution solution = adjust_heights(graph(), given, covariances(given));
  for (Eigen::Index i = 0; i <= 10; ++i) {
    const auto at = static_cast<double>(i);
    EXPECT_NEAR(solution.z_m[i], 100.0 + 0.1 * at, 1e-3);
    EXPECT_NEAR(solution.variance[i], 0.01 * at * (10.0 - at) / 10.0, 1e-4);  // a Brownian bridge
  }
}

TEST_F(HeightChain, IsShiftedByOneElevation) {
  const std::vector<HeightObservation> given{{5, 50.0, 4e-4}};
  const HeightSolution solution = adjust_heights(graph(), given, covariances(given));
  for (Eigen::Index i = 0; i <= 10; ++i) {
    EXPECT_NEAR(solution.z_m[i], 50.0, 1e-9);
    EXPECT_NEAR(solution.variance[i], 4e-4 + 0.01 * std::abs(static_cast<double>(i) - 5.0), 1e-9);
  }
  EXPECT_TRUE(std::isnan(solution.test[0]));
}

TEST_F(HeightChain, FindsAWrongElevation) {
  std::vector<HeightObservation> given;
  for (std::size_t node = 0; node <= 10; node += 2) given.push_back({node, 10.0, 4e-4});
  given[3].z_m += 1.0;
  const HeightSolution solution = adjust_heights(graph(), given, covariances(given));
  Eigen::Index largest = 0;
  solution.test.maxCoeff(&largest);
  EXPECT_EQ(largest, 3);
  EXPECT_GT(solution.test[3], 10.83);
}

}  // namespace
}  // namespace adit
