// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/survey.hpp"

#include <algorithm>
#include <cmath>
#include <future>

#include <fmt/format.h>

#include "common/files/file_utils.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "tools/map/result_folder.hpp"
#include "tools/survey/files/gdal_support.hpp"
#include "tools/survey/files/geotiff_file.hpp"
#include "tools/survey/files/las_file.hpp"
#include "tools/survey/files/mesh_file.hpp"
#include "tools/survey/files/vector_files.hpp"
#include "tools/survey/plan/survey_layers.hpp"
#include "tools/survey/raster/elevation_rasters.hpp"
#include "tools/survey/section/clearance.hpp"
#include "tools/survey/section/profile.hpp"
#include "tools/survey/section/section_sheets.hpp"
#include "tools/survey/section/section_table.hpp"
#include "tools/survey/sheet/plan_sheet.hpp"
#include "tools/survey/survey_statements.hpp"
#include "tools/survey/traverse/traverse_report.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

constexpr double kProfileEveryM = 0.5;

void write_rasters(const ColumnGrid& columns, const std::optional<OccupancyGrid>& occupied,
                   const SurveyFrame& frame, const fs::path& folder,
                   std::vector<std::string>& warnings) {
  const std::string& crs = frame.crs_wkt();
  if (columns.columns.size() == 0) {
    warnings.emplace_back("no rasters of elevation: no returns near the path");
  } else {
    write_geotiff(floor_raster(columns, frame), crs, folder / "floor.tif");
    write_geotiff(roof_raster(columns, frame), crs, folder / "roof.tif");
    write_geotiff(height_raster(columns, frame), crs, folder / "height.tif");
    write_geotiff(deviation_raster(columns, frame), crs, folder / "deviation.tif");
  }
  if (!occupied) {
    warnings.emplace_back("no occupancy.tif: the map has no scan, or exceeds the size of a grid");
    return;
  }
  write_geotiff(occupancy_raster(*occupied, frame), crs, folder / "occupancy.tif");
}

/// All points of the 3D scans, in the grid.
LasPoints las_points(const MineSurvey& survey) {
  return [&survey](const std::function<void(const LasPoint&)>& visit) {
    survey.cloud().for_each_point([&](const SurveyPoint& point) {
      const Eigen::Matrix3d covariance = survey.cloud().covariance(point);
      visit({survey.frame().in_grid(point.p_survey), point.utime,
             static_cast<std::uint32_t>(point.scan->number),
             static_cast<float>(position_sd_m(covariance)),
             static_cast<float>(std::sqrt(covariance(2, 2)))});
    });
  };
}

std::optional<LaserAlignment> alignment_of(const SurveyInput& input) {
  if (!input.lasers() || !input.lasers()->has_rear()) return std::nullopt;
  return laser_alignment(scan_rotations(input.cloud_matches(), input.map().full_map().graph,
                                        input.clouds(), *input.lasers()));
}

void add_accuracy(const SurveyGraph& graph, SurveyResult& result) {
  for (const SurveyGraph::Node& node : graph.nodes()) {
    result.plan_sd_max_m = std::max(result.plan_sd_max_m, position_sd_m(node.covariance));
    result.z_sd_max_m = std::max(result.z_sd_max_m, std::sqrt(node.z_variance));
  }
}

/// The mesh of the void in the grid, as PLY and OBJ.
void write_mesh(const MineSurvey& survey, const fs::path& folder, SurveyResult& result) {
  SurfaceMesh mesh = survey.mesh();
  result.mesh = check_mesh(mesh);
  if (mesh.triangles.empty()) {
    result.warnings.emplace_back("no mesh: the returns are too sparse");
    return;
  }
  for (Eigen::Vector3d& p : mesh.vertices) p = survey.frame().in_grid(p);
  const std::string comment =
      fmt::format("adit survey; side of the void; {:.1f} m2 in {} parts, {} borders",
                  result.mesh.area_m2, result.mesh.parts, result.mesh.border_loops);
  write_mesh_ply(mesh, comment, folder / "void.ply");
  write_mesh_obj(mesh, comment, folder / "void.obj");
}

}  // namespace

SurveyResult write_survey(const SurveyOptions& options, const SurveyProgress& progress) {
  const MineSurvey survey(options, progress);
  const SurveyFrame& frame = survey.frame();
  SurveyResult result;
  result.frame = frame.statement();
  result.scans = survey.cloud().scans().size();
  result.points = survey.cloud().points();
  for (const CentreLine& line : survey.lines()) result.length_m += line.line.length_m();
  result.sections = survey.sections().size();
  result.void_space = survey.void_space();
  result.warnings = survey.input().warnings();
  add_accuracy(survey.graph(), result);

  for (const ControlResidual& point : survey.datum().residuals) {
    if (point.is_suspect()) result.warnings.push_back(suspicion(point));
  }
  result.control = survey.datum().residuals;
  for (const CloseApproach& approach : survey.approaches()) {
    if (approach.may_meet()) result.warnings.push_back(encounter(approach));
  }
  result.alignment = alignment_of(survey.input());
  if (const std::string text = suspicion(result.alignment); !text.empty())
    result.warnings.push_back(text);

  if (progress) progress("writing", 0.0);
  const ResultFolder results(options.folder);
  const fs::path& folder = results.unfinished();
  // The largest file by far.
  std::future<void> las = std::async(
      std::launch::async, [&, crs = wkt1_of(frame.crs_wkt()), file = folder / "cloud.las"] {
        write_las(las_points(survey), crs, file);
      });
  write_rasters(survey.columns(), survey.occupied(), frame, folder, result.warnings);
  write_text_file(section_table(survey.sections(), frame), folder / "sections.csv");
  write_text_file(outline_table(survey.sections(), frame), folder / "outlines.csv");
  const auto along = profiles(survey.lines(), survey.columns(), kProfileEveryM);
  write_text_file(sections_svg(survey.sections(), frame), folder / "sections.svg");
  write_text_file(profile_table(along, frame), folder / "profiles.csv");
  write_text_file(water_table(survey.water(), frame), folder / "water.csv");
  write_text_file(pillar_table(survey.pillars(), frame), folder / "pillars.csv");
  write_text_file(profiles_svg(along, frame), folder / "profiles.svg");
  const std::vector<VectorLayer> layers = survey_layers(survey);
  write_geopackage(layers, frame.crs_wkt(), folder / "survey.gpkg");
  write_geojson(layers, frame.crs_name(), frame.statement(), folder / "survey.geojson");
  write_dxf(layers, folder / "survey.dxf");
  write_mesh(survey, folder, result);
  write_plan_sheet(layers, sheet_text(survey, result), options.sheet == "A1" ? kPaperA1 : kPaperA3,
                   folder / "plan.pdf");
  write_traverse_report(report_of(survey, result), layers, survey.graph(), frame,
                        folder / "report.pdf");
  write_text_file(loop_table(traverse_loops(survey.input().map().full_map().graph)),
                  folder / "loops.csv");
  write_text_file(clearance_table(survey.sections(), envelopes_of(survey), frame),
                  folder / "clearance.csv");
  if (!survey.given_lines().empty())
    write_text_file(approach_table(survey.approaches(), frame), folder / "approaches.csv");
  if (!result.control.empty())
    write_text_file(control_table(result.control), folder / "control.csv");
  las.get();
  results.publish();
  if (progress) progress("writing", 1.0);
  return result;
}

}  // namespace adit
