// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/survey_statements.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>

#include <fmt/format.h>

#include "common/bus/node/version.hpp"
#include "common/text/message_text.hpp"
#include "tools/report/text_format.hpp"

namespace adit {
namespace {

double in_degrees(double rad) { return rad * 180.0 / std::numbers::pi; }

/// Empty without pillars.
std::string pillar_statement(const MineSurvey& survey) {
  const std::vector<Pillar>& pillars = survey.pillars();
  if (pillars.empty()) return {};
  const Extraction extracted = extraction(pillars, survey.void_space().area_m2);
  const auto closed = std::ranges::count_if(pillars, &Pillar::is_closed);
  const auto open = std::ssize(pillars) - closed;
  std::string statement = fmt::format(
      "Pillars: {}, {:.0f} m² together, {} narrower than high, the narrowest {:.1f} m; extraction "
      "ratio {:.1f} ± {:.1f} % (95 %), ribs not counted as rock.",
      pillars.size(), extracted.pillars_m2, std::ranges::count_if(pillars, &Pillar::is_slender),
      pillars.front().width_m, 100.0 * extracted.ratio.value, 196.0 * extracted.ratio.sd);
  if (open > 0) {
    statement += fmt::format(
        " {} of them {} not seen from all around: workings may begin there, and the area is an "
        "upper bound.",
        open, open == 1 ? "was" : "were");
  }
  return statement;
}

/// Empty without lines to keep clear.
std::string approach_statement(const MineSurvey& survey) {
  if (survey.approaches().empty()) return {};
  const CloseApproach& nearest = survey.approaches().front();
  return fmt::format(
      "Of {} given lines {} ({}) is nearest to the workings: {:.2f} ± {:.2f} m (95 %) in plan, "
      "without the uncertainty of the line (approaches.csv).",
      survey.given_lines().size(), quote(nearest.name), nearest.layer, nearest.distance_m.value,
      1.96 * nearest.distance_m.sd);
}

/// Empty without water.
std::string water_statement(const MineSurvey& survey) {
  std::string statement;
  for (const auto kind :
       {SurveyedWater::Kind::kSeen, SurveyedWater::Kind::kFlooded, SurveyedWater::Kind::kHollow}) {
    std::size_t bodies = 0;
    double area_m2 = 0.0;
    double volume_m3 = 0.0;
    for (const SurveyedWater& water : survey.water()) {
      if (water.kind != kind) continue;
      ++bodies;
      area_m2 += water.area_m2.value;
      volume_m3 += water.volume_m3.value;
    }
    if (bodies == 0) continue;
    statement += fmt::format("{}{}: {}, {:.1f} m²", statement.empty() ? "Water: " : "; ",
                             name_of(kind), bodies, area_m2);
    if (kind != SurveyedWater::Kind::kSeen) statement += fmt::format(", {:.2f} m³", volume_m3);
  }
  return statement.empty() ? statement : statement + " (water.csv).";
}

}  // namespace

std::string suspicion(const ControlResidual& point) {
  const Eigen::Vector3d& v = point.residual;
  return fmt::format(
      "control point {} does not fit: residuals {:.2f}, {:.2f}, {:.2f} m; a blunder, or the others "
      "lean on one (control.csv)",
      quote(point.name), v.x(), v.y(), v.z());
}

std::string suspicion(const std::optional<LaserAlignment>& alignment) {
  static constexpr std::array<const char*, 3> kAxes{
      "roll", "pitch", "yaw, of which the pose graph has taken a part"};
  std::string off;
  for (int axis = 0; alignment && axis < 3; ++axis) {
    if (!alignment->is_off(axis)) continue;
    off += fmt::format("{}{:+.2f} ± {:.2f}° in {}", off.empty() ? "" : ", ",
                       in_degrees(alignment->rotation_rad[axis]),
                       1.96 * in_degrees(alignment->sd_rad[axis]),
                       kAxes[static_cast<std::size_t>(axis)]);
  }
  if (off.empty()) return off;
  return fmt::format(
      "the front laser stands otherwise than configured, or the rear one does: {} (95 %, front "
      "less rear, {} pairs of 3D scans); coordinates are less certain than stated",
      off, alignment->matches);
}

std::string alignment_statement(const std::optional<LaserAlignment>& alignment) {
  if (!alignment) return {};
  const Eigen::Vector3d off = in_degrees(1.0) * alignment->rotation_rad;
  const Eigen::Vector3d sd = 1.96 * in_degrees(1.0) * alignment->sd_rad;
  return fmt::format(
      "Mount of the front laser against the rear one, by {} pairs of 3D scans (95 %): roll {:+.2f} "
      "± {:.2f}°, pitch {:+.2f} ± {:.2f}°, yaw {:+.2f} ± {:.2f}°; the pose graph has taken a part "
      "of the yaw.",
      alignment->matches, off.x(), sd.x(), off.y(), sd.y(), off.z(), sd.z());
}

std::string encounter(const CloseApproach& approach) {
  return fmt::format(
      "the workings come within {:.2f} ± {:.2f} m (95 %) of {} ({}), in plan: they "
      "may meet (approaches.csv)",
      approach.distance_m.value, 1.96 * approach.distance_m.sd, quote(approach.name),
      approach.layer);
}

PlanSheetText sheet_text(const MineSurvey& survey, const SurveyResult& result) {
  const LogInfo& log_info = survey.input().log_info();
  PlanSheetText text;
  text.title = "Mine plan";
  text.date = date_text(log_info.last_utime);
  text.identity = fmt::format("adit {}; mission of {} to {}; {} 3D scans, {} points", version(),
                              date_text(log_info.first_utime), date_text(log_info.last_utime),
                              result.scans, result.points);
  text.grid_north = !result.control.empty();
  text.statements.push_back(result.frame);
  text.statements.push_back(fmt::format(
      "Accuracy, from the covariances of the adjusted pose graph: at 95 % local maps are within "
      "{:.2f} m in plan (worst direction) and {:.2f} m in elevation, relative to {}.",
      2.45 * result.plan_sd_max_m, 1.96 * result.z_sd_max_m,
      result.control.empty() ? "the start" : "the control"));
  text.statements.push_back(fmt::format(
      "Workings: {:.0f} m of tunnels; area {:.0f} ± {:.0f} m², void {:.0f} ± {:.0f} m³ (95 %). "
      "{:.0f} m² of floor or roof were not seen and are interpolated.",
      result.length_m, result.void_space.area_m2.value, 1.96 * result.void_space.area_m2.sd,
      result.void_space.volume_m3.value, 1.96 * result.void_space.volume_m3.sd,
      result.void_space.filled_m2));
  for (const std::string& statement :
       {pillar_statement(survey), water_statement(survey), approach_statement(survey)}) {
    if (!statement.empty()) text.statements.push_back(statement);
  }
  for (const ControlResidual& point : result.control) {
    if (point.is_suspect()) text.statements.push_back("Warning: " + suspicion(point));
  }
  if (const std::string warning = suspicion(result.alignment); !warning.empty())
    text.statements.push_back("Warning: " + warning);
  return text;
}

std::vector<Envelope> envelopes_of(const MineSurvey& survey) {
  return usual_envelopes(survey.input().vehicle());
}

TraverseReport report_of(const MineSurvey& survey, const SurveyResult& result) {
  constexpr double kTightM = 0.2;
  const MapGraph& graph = survey.input().map().full_map().graph;
  TraverseReport report;
  report.text = sheet_text(survey, result);
  if (const std::string aligned = alignment_statement(result.alignment); !aligned.empty())
    report.text.statements.push_back(aligned);
  report.budget = accuracy_budget(graph, survey.cloud());
  report.loops = traverse_loops(graph);
  for (const Envelope& envelope : envelopes_of(survey)) {
    report.envelopes.push_back(
        fmt::format("{} {:.1f} × {:.1f} m", envelope.name, envelope.width_m, envelope.height_m));
    for (const CrossSection& section : survey.sections()) {
      const auto clearance = clearance_of(section, envelope);
      if (!clearance || (clearance->above_m > kTightM && clearance->beside_m > kTightM)) continue;
      report.narrow.push_back(
          {fmt::format("T{} {:.0f} m", section.plane.tunnel, section.plane.chainage_m),
           envelope.name, clearance->above_m, clearance->beside_m});
    }
  }
  std::ranges::stable_sort(report.narrow, {},
                           [](const NarrowPlace& at) { return std::min(at.above_m, at.beside_m); });
  return report;
}

}  // namespace adit
