// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// survey_table MISSIONS..: surveys missions in simulated mines and compares sections, elevations,
// places, volume, mesh, water and pillars with the true mesh, and the errors with the stated
// standard deviations, as tables in Markdown. With --control the surveys are tied to a grid by true
// places of the robot with random errors, and --blunder adds an error to one of them.
#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/files/file_utils.hpp"
#include "tests/eval/markdown.hpp"
#include "tests/eval/survey/body_errors.hpp"
#include "tests/eval/survey/survey_errors.hpp"
#include "tests/eval/survey/survey_truth.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

struct Row {
  std::size_t sections = 0;
  SurveyErrors width_m;
  SurveyErrors height_m;
  SurveyErrors area_share;  ///< of the true area
  SurveyErrors floor_m;
  SurveyErrors roof_m;
  SurveyErrors plan_m;  ///< of each axis of local maps
  SurveyErrors volume_share;
  BodyErrors bodies;

  void add(const Row& other) {
    sections += other.sections;
    width_m.add(other.width_m);
    height_m.add(other.height_m);
    area_share.add(other.area_share);
    floor_m.add(other.floor_m);
    roof_m.add(other.roof_m);
    plan_m.add(other.plan_m);
    volume_share.add(other.volume_share);
    bodies.add(other.bodies);
  }
};

/// Shape: each section is compared where it is by the true pose of its local map.
void add_sections(const MineSurvey& survey, const SurveyTruth& truth, bool verbose, Row& row) {
  for (const CrossSection& section : survey.sections()) {
    const std::size_t node = survey.graph().node_near_in_survey(section.plane.p_survey);
    const auto T_world = truth.T_world_survey_at(node);
    if (!T_world) continue;
    if (section.has_width()) ++row.sections;
    const SectionOutline real = truth.outline(section, *T_world);
    const SectionMeasures measures = measure(real, 0.0);
    const SectionMeasures& measured = section.measures;
    const auto add = [](const Measured& estimate, const Measured& value, SurveyErrors& errors) {
      if (std::isfinite(estimate.value) && std::isfinite(value.value))
        errors.add(estimate.value - value.value, estimate.sd);
    };
    if (section.has_width()) add(measured.width_m, measures.width_m, row.width_m);
    add(measured.height_m, measures.height_m, row.height_m);
    if (section.has_area() && measures.is_closed()) {
      const double area_m2 = measures.area_m2.value;
      row.area_share.add(measured.area_m2.value / area_m2 - 1.0, measured.area_m2.sd / area_m2);
    }
    if (verbose) {
      std::cerr << format(
          "tunnel %d at %.0f m%s: width %.3f of %.3f, height %.3f of %.3f, area %.2f of %.2f, seen "
          "%.2f\n",
          section.plane.tunnel, section.plane.chainage_m, section.has_area() ? "" : " (open)",
          measured.width_m.value, measures.width_m.value, measured.height_m.value,
          measures.height_m.value, measured.area_m2.value, measures.area_m2.value,
          measured.seen_share);
    }
  }
}

/// Elevations of physical points above the start: where a column really is, is known from the true
/// pose of its local map.
void add_elevations(const MineSurvey& survey, const SurveyTruth& truth, Row& row) {
  constexpr std::size_t kEvery = 37;  // of the columns, which are alike beside each other
  const ColumnGrid& grid = survey.columns();
  std::size_t count = 0;
  for (std::size_t i = 0; i < grid.columns.size(); ++i) {
    const SurveyColumn& column = grid.columns[i];
    if (column.kind != SurveyColumn::Kind::kVoid || count++ % kEvery != 0) continue;
    const Eigen::Vector2d p = centre_of(grid.columns.cell(i), grid.cell_m);
    const auto T_world = truth.T_world_survey_at(survey.graph().node_near_in_survey(p));
    if (!T_world) continue;
    const double base_m =
        std::isfinite(column.floor_m) ? column.floor_m + 0.7 : column.roof_m - 0.7;
    const Eigen::Vector3d inside = *T_world * Eigen::Vector3d(p.x(), p.y(), base_m);
    const auto add = [&](float z_m, float sd_m, bool up, SurveyErrors& errors) {
      const auto real = truth.surface_z_m(inside, up);
      if (!std::isfinite(z_m) || !real) return;
      errors.add(z_m + truth.T_world_survey().z_m - *real, sd_m);
    };
    add(column.floor_m, column.floor_sd_m, false, row.floor_m);
    add(column.roof_m, column.roof_sd_m, true, row.roof_m);
  }
}

void add_places(const MineSurvey& survey, const SurveyTruth& truth, Row& row) {
  for (std::size_t node = 0; node < survey.graph().nodes().size(); ++node) {
    const auto T_world = truth.T_world_survey_at(node);
    if (!T_world) continue;
    const SurveyGraph::Node& at = survey.graph().nodes()[node];
    const Eigen::Vector2d p = at.T_survey_local.plan.translation();
    const Eigen::Vector2d real = truth.T_world_survey().plan.inverse() * (T_world->plan * p);
    for (int axis = 0; axis < 2; ++axis) {
      if (at.covariance(axis, axis) > 0.0)
        row.plan_m.add(p[axis] - real[axis], std::sqrt(at.covariance(axis, axis)));
    }
  }
}

/// The true volume above the surveyed cells of void and of wall beside it.
void add_volume(const MineSurvey& survey, const SurveyTruth& truth, bool verbose, Row& row) {
  const ColumnGrid& filled = survey.filled_columns();
  const CellBox& box = filled.columns.box();
  constexpr int kReach = 4;  // cells of wall beside void
  Grid2<float> middle(CellBox{box.from.array() - kReach, box.to.array() + kReach},
                      SurveyColumn::kNone);
  for (std::size_t i = 0; i < filled.columns.size(); ++i) {
    const SurveyColumn& column = filled.columns[i];
    if (column.kind != SurveyColumn::Kind::kVoid || !std::isfinite(column.height_m())) continue;
    const Eigen::Vector2i cell = filled.columns.cell(i);
    for (int x = -kReach; x <= kReach; ++x) {
      for (int y = -kReach; y <= kReach; ++y) {
        const Eigen::Vector2i beside = cell + Eigen::Vector2i(x, y);
        const bool nearest = x == 0 && y == 0;
        const bool is_wall = filled.columns.get(beside).kind == SurveyColumn::Kind::kWall;
        float& at = middle.at(beside);
        if (nearest || (is_wall && !std::isfinite(at)))
          at = column.floor_m + 0.5F * column.height_m();
      }
    }
  }
  constexpr int kParts = 2;  // of a cell along each axis
  double volume_m3 = 0.0;
  double area_m2 = 0.0;
  for (std::size_t i = 0; i < middle.size(); ++i) {
    if (!std::isfinite(middle[i])) continue;
    const Eigen::Vector2d corner = filled.cell_m * middle.cell(i).cast<double>();
    const std::size_t node = survey.graph().node_near_in_survey(corner);
    const auto T_world = truth.T_world_survey_at(node);
    if (!T_world) continue;
    for (int part = 0; part < kParts * kParts; ++part) {
      const double side = filled.cell_m / kParts;
      const Eigen::Vector2d p =
          corner + side * Eigen::Vector2d(part % kParts + 0.5, part / kParts + 0.5);
      const Eigen::Vector3d inside = *T_world * Eigen::Vector3d(p.x(), p.y(), middle[i]);
      const auto roof = truth.surface_z_m(inside, true);
      const auto floor = truth.surface_z_m(inside, false);
      if (!roof || !floor) continue;
      volume_m3 += (*roof - *floor) * side * side;
      area_m2 += side * side;
    }
  }
  const VoidVolume& measured = survey.void_space();
  if (verbose) {
    std::cerr << format("volume %.1f of %.1f m3, area %.1f of %.1f m2, filled %.1f m2\n",
                        measured.volume_m3.value, volume_m3, measured.area_m2.value, area_m2,
                        measured.filled_m2);
  }
  row.volume_share.add(measured.volume_m3.value / volume_m3 - 1.0,
                       measured.volume_m3.sd / volume_m3);
}

// Surveys with control.

struct ControlOptions {
  int points = 0;
  double sd_m = 0.02;
  double blunder_m = 0.0;  ///< of the easting of the second point
};

/// A mine's own grid: turned, shifted and raised.
const LevelPose kGridWorld{{3500.0, 8200.0, 0.7}, 231.5};

/// Control points at the robot during 3D scans that are spread over the mission. `seed`: of their
/// errors.
std::string control_text(const SurveyInput& input, const ControlOptions& options, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> error(0.0, options.sd_m);
  std::string text = "name,easting_m,northing_m,elevation_m,place,sd_m\n";
  const std::size_t scans = input.clouds().size();
  for (int i = 0; i < options.points; ++i) {
    const std::size_t at = (scans - 1) * static_cast<std::size_t>(i) /
                           static_cast<std::size_t>(std::max(1, options.points - 1)) / 2;
    const auto pose = interpolate_in_space(input.truth(), input.clouds()[at].utime);
    if (!pose) continue;
    const Eigen::Vector3d p = kGridWorld * pose->position();
    text += format("P%d,%.4f,%.4f,%.4f,time %.6f,%.3f\n", i,
                   p.x() + error(random) + (i == 1 ? options.blunder_m : 0.0),
                   p.y() + error(random), p.z() + error(random),
                   1e-6 * static_cast<double>(input.clouds()[at].utime), options.sd_m);
  }
  return text;
}

/// `number`: of the mission in the table.
Row score(const std::filesystem::path& mission, unsigned number, const ControlOptions& control,
          bool verbose) {
  SurveyOptions options;
  options.mission = {mission};
  const test::ScratchFolder scratch;
  std::optional<LevelPose> T_grid_world;
  if (control.points > 0) {
    options.control = scratch / "control.csv";
    options.crs = "local";
    write_text_file(control_text(SurveyInput(mission_logs({mission})), control, number),
                    options.control);
    T_grid_world = kGridWorld;
  }
  const MineSurvey survey(options);
  const SurveyTruth truth(survey, T_grid_world);
  if (verbose) std::cerr << control_table(survey.datum().residuals);
  Row row;
  add_sections(survey, truth, verbose, row);
  add_elevations(survey, truth, row);
  add_places(survey, truth, row);
  add_volume(survey, truth, verbose, row);
  row.bodies = body_errors(survey, truth);
  return row;
}

void print_row(const std::string& name, const Row& row) {
  std::cout << "| " << name << " | " << row.sections << " | " << row.width_m.text() << " | "
            << row.height_m.text() << " | " << row.area_share.text(100.0) << " | "
            << row.floor_m.text() << " | " << row.roof_m.text() << " | " << row.plan_m.text()
            << " | " << row.volume_share.text(100.0) << " |\n"
            << std::flush;
}

void print_bodies(const std::string& name, const BodyErrors& errors) {
  const double stray_share = static_cast<double>(errors.strays) /
                             static_cast<double>(std::max<std::size_t>(1, errors.triangles));
  std::cout << "| " << name << " | " << errors.mesh_m.magnitude_text()
            << format(", %.1f %%", 100.0 * stray_share) << " | " << errors.flooded_m.text() << " | "
            << errors.pillars_m2.text(100.0) << " | " << errors.open_pillars_m2.text(100.0)
            << format(" | %zu of %zu |\n", errors.not_pillars, errors.pillars);
}

void print_tables(const std::vector<std::filesystem::path>& missions, const ControlOptions& control,
                  bool verbose) {
  std::cout << "Errors: median of magnitudes (95 % quantile, mean), share within the stated 95 % "
               "interval.\n\n";
  print_heading(
      "| mission | sections | width (m) | height (m) | area (%) | floor (m) | roof (m) | local "
      "maps in plan, by axis (m) | volume (%) |");
  std::vector<std::pair<std::string, BodyErrors>> bodies;
  Row sum;
  for (unsigned number = 1; const std::filesystem::path& mission : missions) {
    const Row row = score(mission, number++, control, verbose);
    print_row(mission.filename().string(), row);
    sum.add(row);
    bodies.emplace_back(mission.filename().string(), row.bodies);
  }
  if (missions.size() > 1) {
    print_row("all", sum);
    bodies.emplace_back("all", sum.bodies);
  }
  std::cout << "\nOf the mesh the share of triangles without a true surface within 0.3 m.\n\n";
  print_heading(
      "| mission | mesh along its normals (m), strays | water to three levels: volume over area "
      "(m) | area of closed pillars (%) | of open ones (%) | pillars that are none |");
  for (const auto& [name, errors] : bodies) print_bodies(name, errors);
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app("Compares surveys with the true mines, as a table in Markdown");
  std::vector<std::filesystem::path> missions;
  bool verbose = false;
  adit::ControlOptions control;
  app.add_option("MISSIONS", missions, "Folders or logs of simulated missions")->required();
  app.add_flag("--verbose", verbose, "Print each section to standard error");
  app.add_option("--control", control.points, "Number of control points; 0: none");
  app.add_option("--control-sd", control.sd_m, "Standard deviation of their coordinates [m]");
  app.add_option("--blunder", control.blunder_m, "Error of the easting of the second one [m]");
  CLI11_PARSE(app, argc, argv);
  adit::print_tables(missions, control, verbose);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "survey_table: " << error.what() << "\n";
  return 2;
}
