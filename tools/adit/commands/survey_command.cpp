// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <fmt/format.h>

#include "common/command_line/command_line.hpp"
#include "common/config/bounds.hpp"
#include "common/text/message_text.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/adit/run_progress.hpp"
#include "tools/survey/compare/compare_surveys.hpp"
#include "tools/survey/survey.hpp"

namespace adit {
namespace {

constexpr const char* kSurveyDetails =
    R"(Input: the folder of a mission (adit mission, adit report), or its logs.

Outputs in DIR, for CAD and GIS:
  plan.pdf                          plan sheet on A3 or A1, to scale, with a statement of its accuracy
  survey.gpkg, .geojson, .dxf       walls, pillars, contours, tunnels, sections, junctions, frontiers,
                                    hazards, path, 3D scans, traverse with 95 % ellipses, control
  floor.tif, roof.tif, height.tif   elevation of floor and roof, and their distance (GeoTIFF)
  deviation.tif, occupancy.tif      standard deviations of floor, roof and place; reflecting cells
  sections.csv, .svg, outlines.csv  cross-sections: width, height, area, perimeter
  profiles.csv, .svg                floor and roof along the centre lines
  void.ply, void.obj                mesh of the void, open where nothing was seen
  report.pdf                        accuracy budget, traverse with its ellipses and misclosures, clearance
  loops.csv, clearance.csv          misclosures of all loops; what passes each section
  pillars.csv                       area, width and height of pillars
  water.csv                         standing water, hollows with depth and spill, what a level floods
  cloud.las                         all points (LAS 1.4) with scan, time and standard deviations
  control.csv                       residuals and tests of the control points, with --control
  approaches.csv                    distances from given lines, with --keep-clear

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
  adit survey mission --out survey --water-level -0.4  what is flooded at that elevation
  adit survey mission --out survey --control points.csv --crs EPSG:25832
  adit survey mission --out survey --control points.csv --crs EPSG:25832 --keep-clear old_workings.dxf
  adit survey compare survey_2025 survey_2026 --out change      what fell, what moved)";

constexpr const char* kCompareDetails =
    R"(OLDER, NEWER: folders of adit survey, in one coordinate system. Without control both missions begin at the same place.

Outputs in DIR:
  change.pdf     map of significant change on A3, with the regions and what they are
  changes.csv    the regions: surface, distance, area, volume with its standard deviation
  change.gpkg    the same with their outlines (GeoPackage)
  change.tif     distance of floor, roof and walls, each with its level of detection (GeoTIFF)

Distances are measured along the normals of the older surface (M3C2): positive into the void, negative where rock
is gone. A distance is significant above its level of detection at 95 %, which has the scatter of the returns and
the registration. Each scan of NEWER is registered to OLDER by the clouds and held by its neighbours, so that the
drift of both missions drops out; with --by-coordinates nothing is moved, and the level of detection has the standard deviations of both surveys.)";

constexpr const char* kCompareExamples =
    R"(  adit survey compare survey_2025 survey_2026 --out change
  adit survey compare survey_2025 survey_2026 --out change --by-coordinates    also the motion of long stretches)";

constexpr std::size_t kRegionsPrinted = 10;

void survey(const SurveyOptions& options) {
  if (options.mission.empty()) throw std::invalid_argument("MISSION is required");
  if (options.folder.empty()) throw std::invalid_argument("--out is required");
  std::optional<RunProgress> progress(std::in_place, options.folder);
  const SurveyResult result = write_survey(
      options, [&](const std::string& step, double done) { progress->update(step, done); });
  progress.reset();
  print_survey(result, options.folder);
}

void compare(const CompareOptions& options) {
  std::optional<RunProgress> progress(std::in_place, options.folder);
  const CompareResult result = compare_surveys(
      options, [&](const std::string& step, double done) { progress->update(step, done); });
  progress.reset();
  for (const std::string& warning : result.warnings) print_error("adit", warning);
  for (const std::string& statement : result.statements)
    std::cout << message_line(statement) << "\n";
  for (std::size_t i = 0; i < std::min(result.regions.size(), kRegionsPrinted); ++i) {
    const ChangeRegion& region = result.regions[i];
    const Eigen::Vector3d p = result.origin + region.p;
    std::cout << fmt::format(
        "{:3}: {:+.2f} ± {:.2f} m³ on {:.1f} m² at {:.1f}, {:.1f}, {:.1f}: {}\n", i + 1,
        region.volume_m3, 1.96 * region.volume_sd_m3, region.area_m2, p.x(), p.y(), p.z(),
        region.meaning());
  }
  if (result.regions.size() > kRegionsPrinted)
    std::cout << fmt::format("and {} smaller ones: changes.csv\n",
                             result.regions.size() - kRegionsPrinted);
  std::cout << std::flush;
}

void add_compare_command(CLI::App& survey_command) {
  CLI::App* command = add_command(survey_command, "compare",
                                  "Compare two surveys of one mine: what fell, what moved");
  set_help(*command, {kCompareDetails, "", kCompareExamples});
  const auto options = std::make_shared<CompareOptions>();
  command->add_option("OLDER", options->older, "Folder of the older survey")
      ->type_name("DIR")
      ->required();
  command->add_option("NEWER", options->newer, "Folder of the newer survey")
      ->type_name("DIR")
      ->required();
  command->add_option("--out", options->folder, "Output folder; created if it does not exist")
      ->type_name("DIR")
      ->required();
  command->add_flag("--by-coordinates", options->by_coordinates,
                    "Compare where the coordinates place the scans, without registration");
  command->callback([options] { compare(*options); });
}

}  // namespace

void print_survey(const SurveyResult& result, const std::filesystem::path& folder) {
  for (const std::string& warning : result.warnings) print_error("adit", warning);
  std::cout << message_line(fmt::format(
                   "{}: {} 3D scans, {} points, {:.0f} m of tunnels, {} sections; void {:.0f} ± "
                   "{:.0f} m³ (95 %)",
                   folder.string(), result.scans, result.points, result.length_m, result.sections,
                   result.void_space.volume_m3.value, 1.96 * result.void_space.volume_m3.sd))
            << "\n"
            << message_line(result.frame) << "\n"
            << fmt::format("Largest standard deviation: {:.3f} m in plan, {:.3f} m in height\n",
                           result.plan_sd_max_m, result.z_sd_max_m)
            << fmt::format("Mesh: {:.0f} m² in {} parts; {} borders where nothing was seen\n",
                           result.mesh.area_m2, result.mesh.parts, result.mesh.border_loops)
            << std::flush;
}

void add_survey_command(CLI::App& adit) {
  CLI::App* command =
      add_command(adit, "survey",
                  "Survey a mine from a mission: elevations, sections, volume, for CAD and GIS");
  set_help(*command, {kSurveyDetails, "", kSurveyExamples});
  const auto options = std::make_shared<SurveyOptions>();
  command->add_option("MISSION", options->mission, "Folder of a mission, or its LCM logs")
      ->type_name("DIR");
  command->add_option("--out", options->folder, "Output folder; created if it does not exist")
      ->type_name("DIR");
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
  command->add_option("--sheet", options->sheet, "Paper of the plan: A3 or A1")
      ->type_name("SIZE")
      ->capture_default_str()
      ->check(CLI::IsMember({"A3", "A1"}));
  command
      ->add_option("--water-level", options->water_level_m,
                   "Elevation of water [m]: what it floods, and what it spills over")
      ->type_name("Z")
      ->check(number_in(within(-10'000.0, 10'000.0)));
  command
      ->add_option("--keep-clear", options->keep_clear,
                   "Other workings, property lines, boreholes (any vector file): how near the "
                   "workings come to each")
      ->type_name("FILE")
      ->check(CLI::ExistingFile);
  command->require_subcommand(0, 1);
  add_compare_command(*command);
  command->callback([options, command] {
    if (command->get_subcommands().empty()) survey(*options);
  });
}

}  // namespace adit
