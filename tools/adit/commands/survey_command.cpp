// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/command_line/command_line.hpp"
#include "common/config/bounds.hpp"
#include "common/text/message_text.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/adit/run_progress.hpp"
#include "tools/survey/survey.hpp"

namespace adit {
namespace {

constexpr const char* kSurveyDetails =
    R"(Input: the folder of a mission (adit mission, adit report), or its logs.

Outputs in DIR, for CAD and GIS:
  plan.pdf                          plan sheet on A3, to scale, with a statement of its accuracy
  survey.gpkg, .geojson, .dxf       walls, pillars, contours, tunnels, sections, junctions, frontiers,
                                    hazards, path, 3D scans, traverse with 95 % ellipses, control
  floor.tif, roof.tif, height.tif   elevation of floor and roof, and their distance (GeoTIFF)
  deviation.tif, occupancy.tif      standard deviations of floor, roof and place; reflecting cells
  sections.csv, .svg, outlines.csv  cross-sections: width, height, area, perimeter
  profiles.csv, .svg                floor and roof along the centre lines
  cloud.las                         all points (LAS 1.4) with scan, time and standard deviations
  control.csv                       residuals and tests of the control points, with --control

Without control the coordinate system is a local grid: metres from the start of the mission. Control points
are comma-separated values; the first line names the columns:
  name,easting_m,northing_m,elevation_m,place,x_m,y_m,z_m,sd_m
place is where the mission saw the point: start, time SECONDS (the robot then), scan NUMBER (x, y, z in its
level frame), or map (x, y, z in the local grid). Two points need easting and northing; a level has only an
elevation. They are observations of the pose graph, which is adjusted again. See docs/howto/survey.md.)";

constexpr const char* kSurveyExamples =
    R"(  adit mission random --seed 7 --in-process --out mission
  adit survey mission --out survey
  adit survey mission --out survey --every 2           a cross-section every 2 m
  adit survey mission --out survey --control points.csv --crs EPSG:25832)";

void survey(const SurveyOptions& options) {
  std::optional<RunProgress> progress(std::in_place, options.folder);
  const SurveyResult result = write_survey(
      options, [&](const std::string& step, double done) { progress->update(step, done); });
  progress.reset();
  for (const std::string& warning : result.warnings) print_error("adit", warning);
  std::cout << message_line(fmt::format(
                   "{}: {} 3D scans, {} points, {:.0f} m of tunnels, {} sections; void {:.0f} ± "
                   "{:.0f} m³ (95 %)",
                   options.folder.string(), result.scans, result.points, result.length_m,
                   result.sections, result.void_space.volume_m3.value,
                   1.96 * result.void_space.volume_m3.sd))
            << "\n"
            << message_line(result.frame) << "\n"
            << fmt::format("Largest standard deviation: {:.3f} m in plan, {:.3f} m in height\n",
                           result.plan_sd_max_m, result.z_sd_max_m)
            << std::flush;
}

}  // namespace

void add_survey_command(CLI::App& adit) {
  CLI::App* command =
      add_command(adit, "survey",
                  "Survey a mine from a mission: elevations, sections, volume, for CAD and GIS");
  set_help(*command, {kSurveyDetails, "", kSurveyExamples});
  const auto options = std::make_shared<SurveyOptions>();
  command->add_option("MISSION", options->mission, "Folder of a mission, or its LCM logs")
      ->type_name("DIR")
      ->required();
  command->add_option("--out", options->folder, "Output folder; created if it does not exist")
      ->type_name("DIR")
      ->required();
  command->add_option("--control", options->control, "Control points with grid coordinates (CSV)")
      ->type_name("FILE");
  command
      ->add_option("--crs", options->crs,
                   "Coordinate system of the control points: EPSG:n or local")
      ->type_name("NAME");
  command->add_option("--every", options->every_m, "Distance between cross-sections [m]")
      ->capture_default_str()
      ->check(number_in(within(kSectionEveryMinM, kSectionEveryMaxM)));
  command->add_option("--cell", options->cell_m, "Side of a cell of the rasters [m]")
      ->capture_default_str()
      ->check(number_in(within(kSurveyCellMinM, kSurveyCellMaxM)));
  command->callback([options] { survey(*options); });
}

}  // namespace adit
