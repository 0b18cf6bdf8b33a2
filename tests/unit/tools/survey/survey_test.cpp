// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/survey.hpp"

#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/files/file_utils.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/tools/report/synthetic_mission_log.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Survey : public testing::Test {
 protected:
  SurveyResult survey(const test::MissionLogOptions& log = {}, const SurveyOptions& given = {}) {
    test::write_mission_log(folder_ / "run.lcmlog", log);
    SurveyOptions options = given;
    options.mission = {folder_ / "run.lcmlog"};
    options.folder = out();
    return write_survey(options);
  }
  /// With control points at places of map along the tunnel, to the north of the grid.
  SurveyResult survey_with(const std::string& rows, const std::string& crs = "local") {
    SurveyOptions options;
    options.control = folder_ / "points.csv";
    options.crs = crs;
    write_text_file("name,easting_m,northing_m,elevation_m,place,x_m,y_m,z_m\n" + rows,
                    options.control);
    return survey({}, options);
  }
  [[nodiscard]] fs::path out() const { return folder_ / "survey"; }
  [[nodiscard]] std::string file(const std::string& name) const {
    return test::contents(out() / name);
  }

  test::ScratchFolder folder_;
};

TEST_F(Survey, WritesItsFiles) {
  const SurveyResult result = survey();
  EXPECT_EQ(result.scans, 2U);
  EXPECT_THAT(result.frame, HasSubstr("Local grid"));
  for (const char* name : {"floor.tif", "roof.tif", "height.tif", "deviation.tif", "occupancy.tif",
                           "sections.csv", "outlines.csv", "sections.svg", "profiles.csv",
                           "profiles.svg", "survey.gpkg", "survey.geojson", "survey.dxf",
                           "cloud.las", "plan.pdf", "report.pdf", "void.ply", "void.obj"}) {
    EXPECT_GT(file(name).size(), 100U) << name;
  }
  EXPECT_FALSE(fs::exists(out() / ".unfinished"));
}

TEST_F(Survey, DrawsItsPlanOnTheChosenPaper) {
  survey();
  EXPECT_THAT(file("plan.pdf"), HasSubstr("0 0 1190.55"));  // points of 420 mm
  survey({}, {.sheet = "A1"});
  EXPECT_THAT(file("plan.pdf"), HasSubstr("0 0 2383.93"));  // 841 mm
}

TEST_F(Survey, IsReproducible) {
  survey();
  const std::string cloud = file("cloud.las");
  const std::string sections = file("sections.csv");
  const std::string plan = file("survey.geojson");
  const std::string sheet = file("plan.pdf");
  survey();
  EXPECT_TRUE(file("cloud.las") == cloud);
  EXPECT_EQ(file("sections.csv"), sections);
  EXPECT_EQ(file("survey.geojson"), plan);
  EXPECT_TRUE(file("plan.pdf") == sheet);
}

TEST_F(Survey, SaysWhatTheLogLacks) {
  const SurveyResult result = survey({.omitted_channels = {"EXPLORATION"}});
  EXPECT_THAT(result.warnings, testing::Contains(HasSubstr("EXPLORATION")));
  EXPECT_EQ(result.sections, 0U);
}

TEST_F(Survey, RejectsALogWithoutScansOrMap) {
  EXPECT_THROW(survey({.omitted_channels = {"CLOUD"}}), std::runtime_error);
  EXPECT_THROW(survey({.omitted_channels = {"LOCAL_MAP", "POSE_GRAPH"}}), std::runtime_error);
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Survey, RejectsOptionsOutOfBounds) {
  EXPECT_THROW(survey({}, {.every_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(survey({}, {.cell_m = 5.0}), std::invalid_argument);
  EXPECT_THROW(survey({}, {.sheet = "A5"}), std::invalid_argument);
  EXPECT_THROW(survey({}, {.water_level_m = std::numeric_limits<double>::infinity()}),
               std::invalid_argument);
  EXPECT_THROW(write_survey({.mission = {folder_ / "none"}, .folder = out()}),
               std::invalid_argument);
  fs::create_directory(folder_ / "empty");
  EXPECT_THROW(write_survey({.mission = {folder_ / "empty"}, .folder = out()}), std::runtime_error);
}

TEST_F(Survey, TiesItselfToControlPoints) {
  const SurveyResult result =
      survey_with("A,1000,2000,50,start\nB,1000,2008,50,map,8,0,0\nC,1000,2004,50,map,4,0,0\n");
  ASSERT_EQ(result.control.size(), 3U);
  EXPECT_THAT(result.frame, HasSubstr("mine grid, by 3 control points"));
  for (const ControlResidual& point : result.control) {
    EXPECT_LT(point.residual.norm(), 0.1) << point.name;
    EXPECT_FALSE(point.is_suspect()) << point.name;
  }
  EXPECT_THAT(file("control.csv"), HasSubstr("\nB,1000.000,2008.000,50.000,"));
  EXPECT_THAT(file("survey.geojson"), HasSubstr("mine grid"));
}

TEST_F(Survey, WritesNothingForABadControlFile) {
  const std::string feet = "A,0,0,,start\nB,0,26.25,,map,8,0,0\n";
  EXPECT_THROW(survey_with(feet), std::runtime_error);
  EXPECT_THROW(survey_with("A,8.1,50.2,,start\nB,8.1,50.3,,map,8,0,0\n", "EPSG:25832"),
               std::runtime_error);
  EXPECT_THROW(survey_with("A,1,2,,start\nA,1,10,,map,8,0,0\n"), std::runtime_error);
  EXPECT_THROW(survey_with("A,1,2,,start\nB,1,10,,scan 99\n"), std::runtime_error);
  EXPECT_THROW(survey_with("A,1000,2000,,start\nB,1000,2008,,map,8,0,0\n", ""),
               std::invalid_argument);
  EXPECT_FALSE(fs::exists(out()));
}

}  // namespace
}  // namespace adit
