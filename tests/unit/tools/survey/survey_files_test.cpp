// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/geometry/local_crs.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/survey/files/contour_lines.hpp"
#include "tools/survey/files/geotiff_file.hpp"
#include "tools/survey/files/vector_files.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::Not;

/// What a command prints; empty where it is not installed.
std::string output_of(const std::string& command) {
  std::string text;
  FILE* const pipe = popen((command + " 2>/dev/null").c_str(), "r");
  if (pipe == nullptr) return text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe))
    text.push_back(static_cast<char>(c));
  pclose(pipe);
  return text;
}

std::string local_wkt() { return local_crs_wkt("mine grid", "a peg"); }

std::vector<VectorLayer> two_layers() {
  using Field = VectorLayer::Field;
  return {{"stations",
           VectorLayer::Geometry::kPoint,
           {{"name", Field::Type::kText}, {"z_sd_m", Field::Type::kNumber}},
           {{{{1.0, 2.0, -3.0}}, {std::string("A \"1\""), 0.25}, "A \"1\""},
            {{{4.0, 2.0, -3.0}}, {std::string("B"), AttributeValue()}, ""}}},
          {"walls",
           VectorLayer::Geometry::kLine,
           {{"number", Field::Type::kInteger}},
           {{{{0.0, 0.0, 1.0}, {5.0, 0.0, 1.5}}, {std::int64_t{3}}, ""}}}};
}

class SurveyFiles : public testing::Test {
 protected:
  test::ScratchFolder folder_;
};

TEST_F(SurveyFiles, RastersAreGeoTiffs) {
  const Raster raster{3,
                      2,
                      0.5,
                      {100.0, 201.0},
                      {{"floor elevation", "m", {1.0F, 2.0F, 3.0F, 4.0F, 5.0F, std::nanf("")}}}};
  write_geotiff(raster, local_wkt(), folder_ / "floor.tif");
  const std::string info = output_of("gdalinfo -stats " + (folder_ / "floor.tif").string());
  if (info.empty()) GTEST_SKIP() << "no gdalinfo";
  EXPECT_THAT(info, HasSubstr("Size is 3, 2"));
  EXPECT_THAT(info, HasSubstr("mine grid"));
  EXPECT_THAT(info, HasSubstr("Origin = (100.000000000000000,201.000000000000000)"));
  EXPECT_THAT(info, HasSubstr("Pixel Size = (0.500000000000000,-0.500000000000000)"));
  EXPECT_THAT(info, HasSubstr("Minimum=1.000, Maximum=5.000"));
  EXPECT_THAT(info, HasSubstr("Description = floor elevation"));
}

TEST_F(SurveyFiles, GeoPackagesHaveATableForEachLayer) {
  write_geopackage(two_layers(), local_wkt(), folder_ / "survey.gpkg");
  const std::string info = output_of("ogrinfo -al " + (folder_ / "survey.gpkg").string());
  if (info.empty()) GTEST_SKIP() << "no ogrinfo";
  EXPECT_THAT(info, HasSubstr("Layer name: stations"));
  EXPECT_THAT(info, HasSubstr("POINT Z (1 2 -3)"));
  EXPECT_THAT(info, HasSubstr("z_sd_m (Real) = 0.25"));
  EXPECT_THAT(info, HasSubstr("z_sd_m (Real) = (null)"));
  EXPECT_THAT(info, HasSubstr("LINESTRING Z (0 0 1,5 0 1.5)"));
  EXPECT_THAT(info, HasSubstr("mine grid"));
}

/// Pairs of lines, a code and a value, by AutoCAD's DXF reference; ~ is a space that does not
/// break.
TEST_F(SurveyFiles, DrawingsHaveLayersAndTexts) {
  write_dxf(two_layers(), folder_ / "survey.dxf");
  const std::string dxf = test::contents(folder_ / "survey.dxf");
  EXPECT_THAT(dxf, HasSubstr("\n  8\nSTATIONS\n"));
  EXPECT_THAT(dxf, HasSubstr("\n  8\nSTATIONS_TEXT\n"));
  EXPECT_THAT(dxf, HasSubstr("\n  8\nWALLS\n"));
  EXPECT_THAT(dxf, HasSubstr("\nA\\~1\n"));
  EXPECT_THAT(dxf, HasSubstr("EOF"));
}

TEST_F(SurveyFiles, GeoJsonNamesItsCoordinateSystem) {
  write_geojson(two_layers(), local_wkt(), "Local grid.", folder_ / "survey.geojson");
  const auto json = nlohmann::json::parse(test::contents(folder_ / "survey.geojson"));
  EXPECT_EQ(json["crs"]["properties"]["name"], local_wkt());
  ASSERT_EQ(json["features"].size(), 3U);
  EXPECT_EQ(json["features"][0]["properties"]["layer"], "stations");
  EXPECT_TRUE(json["features"][1]["properties"]["z_sd_m"].is_null());
  EXPECT_EQ(json["features"][2]["geometry"]["coordinates"][1][2], 1.5);
}

TEST_F(SurveyFiles, FailWithoutAPart) {
  const auto missing = folder_.path() / "no_such_folder";
  EXPECT_THROW(write_geopackage(two_layers(), local_wkt(), missing / "a.gpkg"), std::runtime_error);
  EXPECT_THROW(
      write_geotiff({1, 1, 1.0, {0.0, 0.0}, {{"", "", {1.0F}}}}, local_wkt(), missing / "a.tif"),
      std::runtime_error);
  EXPECT_THROW(write_dxf(two_layers(), missing / "a.dxf"), std::runtime_error);
}

TEST(ContourLines, FollowAPlane) {
  Raster raster{20, 10, 0.5, {0.0, 5.0}, {{"", "", {}}}};
  for (int row = 0; row < 10; ++row) {
    for (int column = 0; column < 20; ++column)
      raster.bands[0].values.push_back(0.5F * (static_cast<float>(column) + 0.5F));  // z = x
  }
  const auto lines = contour_lines(raster, 0.0, 4.0);
  ASSERT_EQ(lines.size(), 2U);
  for (const ContourLine& line : lines) {
    for (const Eigen::Vector2d& p : line.points) EXPECT_NEAR(p.x(), line.level, 1e-6);
    EXPECT_NEAR(line.length_m(), 5.0, 0.6);  // to the centres of the outer cells, or their rims
  }
}

}  // namespace
}  // namespace adit
