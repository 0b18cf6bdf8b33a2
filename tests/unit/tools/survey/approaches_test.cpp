// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/plan/approaches.hpp"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/files/file_utils.hpp"
#include "common/geometry/local_crs.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/tools/survey/survey_scene.hpp"
#include "tools/survey/raster/void_volume.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// A grid 500 m east and 200 m north of survey, whose lengths are 0.99 times those of the mine.
SurveyFrame mine_grid() {
  const std::string wkt = local_crs_wkt("mine grid", "a peg");
  return {{500.0, 200.0, 10.0}, 0.99, wkt, wkt, "a grid"};
}

class Approaches : public testing::Test {
 protected:
  Approaches()
      : clouds_(test::stored({test::scan_of_tunnel(0.0, 10.0, {2.0, 2.2})})),
        columns_(with_gaps_filled(
            column_grid(RegisteredCloud(clouds_, graph_), test::path_along_x(0.0, 10.0)),
            nullptr)) {}

  /// Of points in survey.
  CloseApproach to(std::vector<Eigen::Vector2d> points, bool is_area = false) {
    for (Eigen::Vector2d& p : points) p = frame_.in_grid(p);
    const auto found = approaches_to({{"old", "A", points, is_area}}, columns_, graph_, frame_);
    return found.at(0);
  }

  SurveyFrame frame_ = mine_grid();
  SurveyGraph graph_ = test::graph_along_x(3, 5.0);
  CloudStore clouds_;
  ColumnGrid columns_;
};

TEST_F(Approaches, MeasureTheDistanceFromTheNearestWall) {
  const CloseApproach line = to({{-20.0, 7.0}, {30.0, 7.0}});
  EXPECT_NEAR(line.distance_m.value, 5.0, 0.1);  // a cell; the tunnel is 4 m wide
  EXPECT_NEAR(line.p_wall.y(), 2.0, 0.1);
  EXPECT_NEAR(line.p_given.y(), 7.0, 1e-9);
  EXPECT_FALSE(line.may_meet());
  const CloseApproach borehole = to({{5.0, -3.5}});
  EXPECT_NEAR(borehole.distance_m.value, 1.5, 0.1);
  EXPECT_NEAR(borehole.p_wall.x(), 5.0, 0.5);
}

TEST_F(Approaches, AreNoneWhereTheWorkingsMeetIt) {
  EXPECT_EQ(to({{5.0, -9.0}, {5.0, 9.0}}).distance_m.value, 0.0);  // through both walls
  EXPECT_EQ(to({{3.0, 0.3}, {6.0, 0.3}}).distance_m.value, 0.0);   // within the tunnel
  EXPECT_TRUE(to({{3.0, 0.3}, {6.0, 0.3}}).may_meet());
}

TEST_F(Approaches, TellWhetherTheWorkingsLieWithinAnArea) {
  EXPECT_TRUE(
      to({{-9.0, -9.0}, {20.0, -9.0}, {20.0, 9.0}, {-9.0, 9.0}, {-9.0, -9.0}}, true).within);
  EXPECT_FALSE(to({{0.0, 5.0}, {9.0, 5.0}, {9.0, 9.0}, {0.0, 9.0}, {0.0, 5.0}}, true).within);
}

TEST_F(Approaches, AreATableInTheGrid) {
  const std::string table = approach_table({to({{5.0, 7.0}, {5.0, 8.0}})}, frame_);
  EXPECT_THAT(table, HasSubstr("\n\"old\",\"A\","));
  EXPECT_THAT(table, HasSubstr(",504.95,"));  // 500 + 0.99 · 5
}

class GivenLines : public testing::Test {
 protected:
  std::vector<GivenLine> read(const std::string& geojson, const std::string& wkt) {
    write_text_file(geojson, folder_ / "lines.geojson");
    return read_given_lines(folder_ / "lines.geojson", wkt);
  }
  static std::string collection(const std::string& geometry) {
    return R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": )"
           R"({"name": "Old drift"}, "geometry": )" +
           geometry + "}]}";
  }

  test::ScratchFolder folder_;
};

constexpr const char* kUtm32 =
    R"(PROJCS["WGS 84 / UTM zone 32N",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",9],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["metre",1]])";

TEST_F(GivenLines, AreTransformedIntoTheGrid) {
  const auto lines = read(
      collection(R"({"type": "LineString", "coordinates": [[9.0, 50.0], [9.0, 50.001]]})"), kUtm32);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].name, "Old drift");
  EXPECT_FALSE(lines[0].is_area);
  EXPECT_NEAR(lines[0].points[0].x(), 500000.0, 1e-3);     // the central meridian
  EXPECT_NEAR(lines[0].points[0].y(), 5538630.703, 0.01);  // its arc at 50°, times 0.9996
  EXPECT_NEAR(lines[0].points[1].y() - lines[0].points[0].y(), 111.18, 0.01);
}

TEST_F(GivenLines, MayBeAreasAndPoints) {
  const auto lines = read(
      collection(
          R"({"type": "GeometryCollection", "geometries": [{"type": "Point", "coordinates": [9, 50]},)"
          R"({"type": "MultiPolygon", "coordinates": [[[[9, 50], [9.1, 50], [9, 50.1], [9, 50]]]]}]})"),
      kUtm32);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].points.size(), 1U);
  EXPECT_TRUE(lines[1].is_area);
  EXPECT_EQ(lines[1].points.size(), 4U);
}

TEST_F(GivenLines, AreRejectedWithOneLine) {
  const std::string wkt = local_crs_wkt("mine grid", "a peg");
  EXPECT_THAT([&] { read(collection(R"({"type": "Point", "coordinates": [9, 50]})"), wkt); },
              ThrowsMessage<std::runtime_error>(HasSubstr("a grid that nothing ties to it")));
  EXPECT_THAT([&] { read(R"({"type": "FeatureCollection", "features": []})", kUtm32); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no point, line or area")));
  write_text_file("not a drawing", folder_ / "a.dxf");
  EXPECT_THAT([&] { read_given_lines(folder_ / "a.dxf", kUtm32); },
              ThrowsMessage<std::runtime_error>(HasSubstr("a.dxf")));
}

}  // namespace
}  // namespace adit
