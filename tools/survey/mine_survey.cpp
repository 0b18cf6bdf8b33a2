// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/mine_survey.hpp"

#include <cmath>
#include <future>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>

#include <fmt/format.h>
#include <malloc.h>

#include "tools/map/full_map.hpp"
#include "tools/survey/plan/hazard_marks.hpp"

namespace adit {
namespace {

const SurveyOptions& checked(const SurveyOptions& options) {
  for (const std::filesystem::path& path : options.mission) {
    if (!std::filesystem::exists(path))
      throw std::invalid_argument(fmt::format("{}: no such file or folder", path.string()));
  }
  if (!(options.every_m >= kSectionEveryMinM && options.every_m <= kSectionEveryMaxM)) {
    throw std::invalid_argument(fmt::format("the distance between cross-sections is {} to {} m",
                                            kSectionEveryMinM, kSectionEveryMaxM));
  }
  if (!(options.cell_m >= kSurveyCellMinM && options.cell_m <= kSurveyCellMaxM)) {
    throw std::invalid_argument(
        fmt::format("the side of a cell is {} to {} m", kSurveyCellMinM, kSurveyCellMaxM));
  }
  if (options.sheet != "A3" && options.sheet != "A1")
    throw std::invalid_argument("the sheet of the plan is A3 or A1");
  if (options.water_level_m && !std::isfinite(*options.water_level_m))
    throw std::invalid_argument("the level of the water is not a number");
  if (options.control.empty() && !options.crs.empty())
    throw std::invalid_argument("--crs needs --control: nothing ties the mission to a grid");
  if (!options.control.empty() && options.crs.empty()) {
    throw std::invalid_argument(
        fmt::format("{}: coordinates of which system? Add --crs EPSG:n, or --crs local for a "
                    "mine's own grid",
                    options.control.string()));
  }
  return options;
}

/// Where temporary files are: beside the result, if there is to be one.
std::filesystem::path scratch_of(const SurveyOptions& options) {
  return options.folder.empty() ? std::filesystem::temp_directory_path()
                                : absolute(options.folder).parent_path();
}

SurveyDatum datum_of(const SurveyOptions& options, const SurveyInput& input) {
  SurveyDatum free = free_datum(input);
  if (options.control.empty()) return free;
  const std::string file = options.control.string();
  const GridSystem grid = grid_system(options.crs);
  const auto points = find_control(read_control(options.control), input, free.graph, file);
  require_plausible(points, grid, file);
  return controlled_datum(input, free.graph, points, grid);
}

/// Places of the body on the ground, in survey: each placed by the local map of its time.
std::vector<Eigen::Vector3d> path_in_survey(const MissionMap& map, const SurveyGraph& graph) {
  std::vector<Eigen::Vector3d> path;
  for (const TimedPose& pose : map.path())
    path.push_back(graph.T_survey_map(graph.node_at(pose.utime)) * pose.position());
  return path;
}

/// Whether a scan of a laser is the first one from nearly the same place: others show the same.
class NewPlaces {
 public:
  bool add(const std::string& channel, const Pose2& T_survey_body) {
    const Eigen::Vector2i cell = cell_of(T_survey_body.translation(), kCellM);
    const auto sector = static_cast<int>(std::floor(wrap_angle(T_survey_body.theta) / kSectorRad));
    return seen_.emplace(channel, cell.x(), cell.y(), sector).second;
  }

 private:
  static constexpr double kCellM = 0.3;
  static constexpr double kSectorRad = 0.2;

  std::set<std::tuple<std::string, int, int, int>> seen_;
};

/// The scans of the level lasers, each at the place of its local map in survey. Nothing if the
/// poses exceed the size of a grid.
std::optional<OccupancyGrid> occupancy(const SurveyInput& input, const SurveyGraph& graph) {
  FullMap placed;
  placed.visit_scans = [&](const FullMap&, const FullMap::UseScan& use) {
    NewPlaces places;
    for (const SurveyGraph::Node& node : graph.nodes()) {
      const LocalMap& map = *input.map().full_map().local_maps[static_cast<std::size_t>(node.id)];
      for (const LocalScan& scan : map.scans) {
        const Pose2 T_survey_body = node.T_survey_local.plan * scan.T_local_body;
        if (!places.add(scan.channel, T_survey_body)) continue;
        if (!use({&scan.channel, &scan.scan, T_survey_body})) return false;
      }
    }
    return true;
  };
  OccupancyGrid grid{OccupancyGridParams{}};
  if (!insert_scans(placed, input.log_info().lasers, grid) || grid.observed_box().empty())
    return std::nullopt;
  return grid;
}

std::vector<CentreLine> lines_of(const SurveyInput& input, const SurveyGraph& graph) {
  if (!input.exploration()) return {};
  return centre_lines(input.exploration()->corridors, graph);
}

void report(const SurveyProgress& progress, const char* step, double done) {
  if (progress) progress(step, done);
}

}  // namespace

MineSurvey::MineSurvey(const SurveyOptions& options, const SurveyProgress& progress)
    : input_(
          mission_logs(checked(options).mission),
          [&](double done) { report(progress, "reading", done); }, scratch_of(options)),
      datum_(datum_of(options, input_)),
      given_lines_(options.keep_clear.empty()
                       ? std::vector<GivenLine>{}
                       : read_given_lines(options.keep_clear, datum_.frame.crs_wkt())),
      cloud_(input_.clouds(), datum_.graph),
      path_(path_in_survey(input_.map(), datum_.graph)),
      lines_(lines_of(input_, datum_.graph)) {
  report(progress, "measuring", 0.0);
  // The mesh takes as long as all others together. It is made here, and they in the other thread,
  // since CGAL takes edges of equal rank by their addresses, which only the heap of the main thread
  // gives in the same order each time.
  std::future<void> others =
      std::async(std::launch::async, [&] { measure_all_but_mesh(options, progress); });
  mesh_ = void_mesh(cloud_);
  malloc_trim(0);  // the triangulation
  others.get();
}

void MineSurvey::measure_all_but_mesh(const SurveyOptions& options,
                                      const SurveyProgress& progress) {
  occupied_ = occupancy(input_, datum_.graph);
  report(progress, "measuring", 0.1);
  columns_ = column_grid(cloud_, path_, {.cell_m = options.cell_m});
  filled_columns_ = with_gaps_filled(columns_, occupied_ ? &*occupied_ : nullptr);
  void_space_ = void_volume(columns_, filled_columns_);
  report(progress, "measuring", 0.5);
  std::optional<double> level_m = options.water_level_m;
  if (level_m) *level_m -= datum_.frame.origin().z();
  water_ = mine_water(columns_, filled_columns_, occupied_ ? &*occupied_ : nullptr,
                      hazard_marks(input_.hazards(), datum_.graph), level_m);
  pillars_ = pillars_of(filled_columns_);
  approaches_ = approaches_to(given_lines_, filled_columns_, datum_.graph, datum_.frame);
  report(progress, "measuring", 0.7);
  sections_ = cross_sections(cloud_, section_planes(lines_, path_, options.every_m));
  report(progress, "measuring", 0.9);
}

}  // namespace adit
