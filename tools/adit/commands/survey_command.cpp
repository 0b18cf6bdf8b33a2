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
#include "common/text/message_text.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/adit/run_progress.hpp"
#include "tools/survey/survey.hpp"

namespace adit {
namespace {

constexpr const char* kSurveyDetails =
    R"(Input: the folder of a mission (adit mission, adit report), or its logs.

Outputs in DIR:
  floor.tif, roof.tif, height.tif   elevation of floor and roof, and their distance (GeoTIFF)
  deviation.tif                     standard deviations of floor, roof and place, from the pose graph
  occupancy.tif                     share of scans that each cell reflected
  sections.csv, outlines.csv        cross-sections along the centre lines of the tunnels

Everything has a standard deviation that follows from the covariances of the pose graph. Without control the
coordinate system is a local grid: metres from the start of the mission.)";

constexpr const char* kSurveyExamples =
    R"(  adit mission random --seed 7 --in-process --out mission
  adit survey mission --out survey
  adit survey mission --out survey --every 2           a cross-section every 2 m)";

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
      ->type_name("DIR|FILE")
      ->required();
  command->add_option("--out", options->folder, "Output folder; created if it does not exist")
      ->type_name("DIR")
      ->required();
  command->add_option("--control", options->control, "Control points with grid coordinates (CSV)")
      ->type_name("FILE");
  command
      ->add_option("--crs", options->crs,
                   "Coordinate system of the control points: EPSG:n or local")
      ->type_name("CRS");
  command->add_option("--every", options->every_m, "Distance between cross-sections [m]")
      ->capture_default_str();
  command->add_option("--cell", options->cell_m, "Side of a cell of the rasters [m]")
      ->capture_default_str();
  command->callback([options] { survey(*options); });
}

}  // namespace adit
