// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/grid/occupancy_grid.hpp"
#include "tools/survey/control/survey_datum.hpp"
#include "tools/survey/frame/registered_cloud.hpp"
#include "tools/survey/frame/survey_frame.hpp"
#include "tools/survey/frame/survey_graph.hpp"
#include "tools/survey/input/survey_input.hpp"
#include "tools/survey/mesh/void_mesh.hpp"
#include "tools/survey/plan/approaches.hpp"
#include "tools/survey/plan/pillars.hpp"
#include "tools/survey/raster/column_grid.hpp"
#include "tools/survey/raster/void_volume.hpp"
#include "tools/survey/section/cross_section.hpp"
#include "tools/survey/water/mine_water.hpp"

namespace adit {

// Bounds of the options below.
inline constexpr double kSectionEveryMinM = 0.2;
inline constexpr double kSectionEveryMaxM = 1000.0;
inline constexpr double kSurveyCellMinM = 0.05;
inline constexpr double kSurveyCellMaxM = 1.0;

struct SurveyOptions {
  std::vector<std::filesystem::path> mission = {};  ///< folder of a mission, or its logs
  std::filesystem::path folder = {};                ///< created if it does not exist
  std::filesystem::path control = {};               ///< file of control points; empty: a local grid
  std::string crs = {};                             ///< of the control points: "EPSG:n" or "local"
  double every_m = 5.0;                             ///< between cross-sections
  double cell_m = 0.1;                              ///< of rasters
  std::string sheet = "A3";                         ///< or A1: paper of the plan
  /// Vector file with other workings, a property line, boreholes; empty: none.
  std::filesystem::path keep_clear = {};
  /// Elevation in the grid up to which water is to stand; nothing: not asked for.
  std::optional<double> water_level_m = {};
};

/// Names the present step and how much of it is done, 0 to 1.
using SurveyProgress = std::function<void(const std::string& step, double done)>;

/// Everything that is measured of a mine, in the frame of the survey. Neither copied nor moved,
/// since its parts refer to each other.
class MineSurvey {
 public:
  /// Throws std::invalid_argument for options out of bounds, and std::runtime_error if a log cannot
  /// be read, or has no map or no 3D scan, and for a file of control
  /// points that cannot be right (see require_plausible), or of lines (see read_given_lines).
  explicit MineSurvey(const SurveyOptions& options, const SurveyProgress& progress = {});
  MineSurvey(const MineSurvey&) = delete;
  MineSurvey& operator=(const MineSurvey&) = delete;

  [[nodiscard]] const SurveyInput& input() const { return input_; }
  [[nodiscard]] const SurveyGraph& graph() const { return datum_.graph; }
  [[nodiscard]] const SurveyDatum& datum() const { return datum_; }
  [[nodiscard]] const SurveyFrame& frame() const { return datum_.frame; }
  [[nodiscard]] const RegisteredCloud& cloud() const { return cloud_; }
  /// Places of the body on the ground, with their local maps.
  [[nodiscard]] const std::vector<Eigen::Vector3d>& path() const { return path_; }
  [[nodiscard]] const std::vector<CentreLine>& lines() const { return lines_; }
  [[nodiscard]] const ColumnGrid& columns() const { return columns_; }
  /// The same without gaps.
  [[nodiscard]] const ColumnGrid& filled_columns() const { return filled_columns_; }
  [[nodiscard]] const std::vector<CrossSection>& sections() const { return sections_; }
  /// Of the void.
  [[nodiscard]] const SurfaceMesh& mesh() const { return mesh_; }
  [[nodiscard]] const VoidVolume& void_space() const { return void_space_; }
  [[nodiscard]] const std::vector<Pillar>& pillars() const { return pillars_; }
  /// Of the workings to each line that is to be kept clear, the nearest first.
  [[nodiscard]] const std::vector<CloseApproach>& approaches() const { return approaches_; }
  /// Those lines, in the grid.
  [[nodiscard]] const std::vector<GivenLine>& given_lines() const { return given_lines_; }
  /// What stands, hollows, and what is flooded at the level that was asked for.
  [[nodiscard]] const std::vector<SurveyedWater>& water() const { return water_; }
  /// Scans of the level lasers at the places of their local maps; nothing if the poses exceed the
  /// size of a grid.
  [[nodiscard]] const std::optional<OccupancyGrid>& occupied() const { return occupied_; }

 private:
  void measure_all_but_mesh(const SurveyOptions& options, const SurveyProgress& progress);

  SurveyInput input_;
  SurveyDatum datum_;
  std::vector<GivenLine> given_lines_;
  RegisteredCloud cloud_;
  std::vector<Eigen::Vector3d> path_;
  std::vector<CentreLine> lines_;
  std::optional<OccupancyGrid> occupied_;
  ColumnGrid columns_;
  ColumnGrid filled_columns_;
  std::vector<CrossSection> sections_;
  SurfaceMesh mesh_;
  VoidVolume void_space_;
  std::vector<SurveyedWater> water_;
  std::vector<Pillar> pillars_;
  std::vector<CloseApproach> approaches_;
};

}  // namespace adit
