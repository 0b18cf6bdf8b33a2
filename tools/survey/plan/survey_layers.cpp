// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/plan/survey_layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "common/geometry/order_statistics.hpp"
#include "common/geometry/symmetric_eigen.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "tools/report/text_format.hpp"
#include "tools/survey/plan/hazard_marks.hpp"
#include "tools/survey/plan/outlines.hpp"
#include "tools/survey/plan/pillars.hpp"

namespace adit {
namespace {

using Field = VectorLayer::Field;
using Geometry = VectorLayer::Geometry;
constexpr Field::Type kInteger = Field::Type::kInteger;
constexpr Field::Type kNumber = Field::Type::kNumber;
constexpr Field::Type kText = Field::Type::kText;

/// The cell itself and those beside it, where a place is on the line between void and wall.
const std::array<Eigen::Vector2i, 9> kBeside{
    Eigen::Vector2i(0, 0),  Eigen::Vector2i(1, 0),  Eigen::Vector2i(-1, 0),
    Eigen::Vector2i(0, 1),  Eigen::Vector2i(0, -1), Eigen::Vector2i(1, 1),
    Eigen::Vector2i(-1, 1), Eigen::Vector2i(1, -1), Eigen::Vector2i(-1, -1)};

/// Builds the layers of one survey.
class LayerBuilder {
 public:
  explicit LayerBuilder(const MineSurvey& survey) : survey_(survey) {}

  [[nodiscard]] VectorLayer walls() const;
  [[nodiscard]] VectorLayer pillars() const;
  [[nodiscard]] VectorLayer floor_contours() const;
  [[nodiscard]] VectorLayer centre_lines() const;
  [[nodiscard]] VectorLayer sections() const;
  [[nodiscard]] VectorLayer junctions() const;
  [[nodiscard]] VectorLayer frontiers() const;
  [[nodiscard]] VectorLayer hazards() const;
  [[nodiscard]] VectorLayer path() const;
  [[nodiscard]] VectorLayer scans() const;
  [[nodiscard]] VectorLayer traverse() const;
  [[nodiscard]] VectorLayer control() const;
  [[nodiscard]] VectorLayer given_lines() const;
  [[nodiscard]] VectorLayer approaches() const;

 private:
  /// A place of map, in survey, on the ground.
  [[nodiscard]] Eigen::Vector3d on_floor(const Eigen::Vector2d& p_map) const {
    const SurveyGraph& graph = survey_.graph();
    const std::size_t node = graph.node_near(p_map);
    const Eigen::Vector2d p = graph.T_survey_map(node).plan * p_map;
    return {p.x(), p.y(), floor_z_m(p, graph.nodes()[node].T_survey_local.z_m)};
  }
  /// Of the floor where it is seen there or beside, otherwise the given height.
  [[nodiscard]] double floor_z_m(const Eigen::Vector2d& p_survey, double otherwise_m) const {
    const ColumnGrid& grid = survey_.filled_columns();
    const Eigen::Vector2i cell = cell_of(p_survey, grid.cell_m);
    for (const Eigen::Vector2i& beside : kBeside) {
      const SurveyColumn column = grid.columns.get(cell + beside);
      if (std::isfinite(column.floor_m)) return static_cast<double>(column.floor_m);
    }
    return otherwise_m;
  }
  [[nodiscard]] Eigen::Vector3d in_grid(const Eigen::Vector3d& p_survey) const {
    return survey_.frame().in_grid(p_survey);
  }
  [[nodiscard]] Eigen::Vector3d in_grid(const Eigen::Vector2d& p_survey, double z_m) const {
    return in_grid(Eigen::Vector3d(p_survey.x(), p_survey.y(), z_m));
  }

  const MineSurvey& survey_;
};

VectorLayer LayerBuilder::walls() const {
  VectorLayer layer{"walls", Geometry::kLine, {{"length_m", kNumber}}, {}};
  for (const VoidOutline& outline : void_outlines(survey_.filled_columns())) {
    if (outline.is_pillar) continue;
    VectorFeature feature{{}, {outline.length_m}, ""};
    for (const Eigen::Vector2d& p : outline.points)
      feature.points.push_back(in_grid(p, floor_z_m(p, outline.z_m)));
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

VectorLayer LayerBuilder::pillars() const {
  VectorLayer layer{"pillars",
                    Geometry::kLine,
                    {{"pillar", kInteger},
                     {"area_m2", kNumber},
                     {"area_sd_m2", kNumber},
                     {"width_m", kNumber},
                     {"height_m", kNumber},
                     {"slender", kText},
                     {"unseen_m", kNumber},
                     {"gap_m", kNumber},
                     {"closed", kText}},
                    {}};
  std::int64_t number = 0;
  for (const Pillar& pillar : survey_.pillars()) {
    VectorFeature feature{
        {},
        {++number, pillar.area_m2.value, pillar.area_m2.sd, pillar.width_m, known(pillar.height_m),
         std::string(pillar.is_slender() ? "yes" : "no"), pillar.unseen_m, pillar.gap_m,
         std::string(pillar.is_closed() ? "yes" : "no")},
        ""};
    for (const Eigen::Vector2d& p : pillar.outline.points)
      feature.points.push_back(in_grid(p, floor_z_m(p, pillar.outline.z_m)));
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

VectorLayer LayerBuilder::floor_contours() const {
  VectorLayer layer{"floor_contours", Geometry::kLine, {{"elevation_m", kNumber}}, {}};
  for (const FloorContour& contour : floor_contour_lines(survey_.columns(), survey_.frame())) {
    VectorFeature feature{{}, {contour.elevation_m}, fmt::format("{:.2f}", contour.elevation_m)};
    for (const Eigen::Vector2d& p : contour.points_grid)
      feature.points.emplace_back(p.x(), p.y(), contour.elevation_m);
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

VectorLayer LayerBuilder::centre_lines() const {
  VectorLayer layer{"centre_lines",
                    Geometry::kLine,
                    {{"tunnel", kInteger},
                     {"from_node", kInteger},
                     {"to_node", kInteger},
                     {"length_m", kNumber},
                     {"width_m", kNumber},
                     {"height_m", kNumber},
                     {"area_m2", kNumber},
                     {"sections", kInteger}},
                    {}};
  for (const CentreLine& line : survey_.lines()) {
    std::vector<double> widths;
    std::vector<double> heights;
    std::vector<double> areas;
    for (const CrossSection& section : survey_.sections()) {
      if (section.plane.tunnel != line.tunnel || section.plane.in_junction) continue;
      if (section.has_width()) widths.push_back(section.measures.width_m.value);
      if (section.has_area()) areas.push_back(section.measures.area_m2.value);
      if (std::isfinite(section.measures.height_m.value))
        heights.push_back(section.measures.height_m.value);
    }
    const auto middle = [](const std::vector<double>& values) {
      return values.empty() ? AttributeValue() : AttributeValue(median(values));
    };
    VectorFeature feature{
        {},
        {std::int64_t{line.tunnel}, std::int64_t{line.from}, std::int64_t{line.to},
         line.line.length_m(), middle(widths), middle(heights), middle(areas),
         static_cast<std::int64_t>(widths.size())},
        fmt::format("T{}", line.tunnel)};
    double z_m = 0.0;
    for (const Eigen::Vector2d& p : line.line.points()) {
      const std::size_t node = survey_.graph().node_near_in_survey(p);
      z_m = floor_z_m(p, survey_.graph().nodes()[node].T_survey_local.z_m);
      feature.points.push_back(in_grid(p, z_m));
    }
    if (feature.points.size() > 1) layer.features.push_back(std::move(feature));
  }
  return layer;
}

VectorLayer LayerBuilder::sections() const {
  VectorLayer layer{"sections",
                    Geometry::kPoint,
                    {{"tunnel", kInteger},
                     {"chainage_m", kNumber},
                     {"floor_m", kNumber},
                     {"floor_sd_m", kNumber},
                     {"roof_m", kNumber},
                     {"width_m", kNumber},
                     {"width_sd_m", kNumber},
                     {"height_m", kNumber},
                     {"height_sd_m", kNumber},
                     {"area_m2", kNumber},
                     {"area_sd_m2", kNumber},
                     {"plan_sd_m", kNumber},
                     {"seen_share", kNumber}},
                    {}};
  const double z0 = survey_.frame().origin().z();
  for (const CrossSection& section : survey_.sections()) {
    const SectionMeasures& m = section.measures;
    const bool floor_seen = std::isfinite(section.floor_m.value);
    const double z_m = floor_seen ? section.floor_m.value : section.plane.z_path_m;
    const auto if_known = [](bool is_known, double value) {
      return is_known ? known(value) : AttributeValue();
    };
    layer.features.push_back(
        {{in_grid(section.plane.p_survey, z_m)},
         {std::int64_t{section.plane.tunnel}, section.plane.chainage_m,
          known(section.floor_m.value + z0), known(section.floor_m.sd),
          known(section.roof_m.value + z0), if_known(section.has_width(), m.width_m.value),
          if_known(section.has_width(), m.width_m.sd), known(m.height_m.value),
          known(m.height_m.sd), if_known(section.has_area(), m.area_m2.value),
          if_known(section.has_area(), m.area_m2.sd), section.plan_sd_m, m.seen_share},
         floor_seen && !section.plane.in_junction
             ? fmt::format("{:.2f}", section.floor_m.value + z0)
             : ""});
  }
  return layer;
}

VectorLayer LayerBuilder::junctions() const {
  VectorLayer layer{"junctions", Geometry::kPoint, {{"node", kInteger}, {"kind", kText}}, {}};
  if (!survey_.input().exploration()) return layer;
  std::int64_t number = 0;
  for (const CorridorNode& node : survey_.input().exploration()->corridors.nodes) {
    const char* const kind = node.kind == CorridorNode::Kind::kJunction  ? "junction"
                             : node.kind == CorridorNode::Kind::kDeadEnd ? "dead end"
                                                                         : "open end";
    layer.features.push_back({{in_grid(on_floor(node.p_map))}, {number, std::string(kind)}, ""});
    ++number;
  }
  return layer;
}

VectorLayer LayerBuilder::frontiers() const {
  VectorLayer layer{"frontiers",
                    Geometry::kPoint,
                    {{"frontier", kInteger},
                     {"state", kText},
                     {"evidence", kText},
                     {"width_m", kNumber},
                     {"since", kText}},
                    {}};
  if (!survey_.input().exploration()) return layer;
  for (const Frontier& frontier : survey_.input().exploration()->frontiers) {
    const bool shown =
        frontier.state != FrontierState::kExplored && frontier.state != FrontierState::kOutsideMine;
    layer.features.push_back({{in_grid(on_floor(frontier.p_map))},
                              {std::int64_t{frontier.id}, std::string(name_of(frontier.state)),
                               frontier.evidence, frontier.width_m, date_text(frontier.utime)},
                              shown ? name_of(frontier.state) : ""});
  }
  return layer;
}

VectorLayer LayerBuilder::hazards() const {
  VectorLayer layer{"hazards",
                    Geometry::kPoint,
                    {{"kind", kText},
                     {"value", kNumber},
                     {"unit", kText},
                     {"evidence", kText},
                     {"size_x_m", kNumber},
                     {"size_y_m", kNumber},
                     {"time", kText}},
                    {}};
  for (const HazardMark& mark : hazard_marks(survey_.input().hazards(), survey_.graph())) {
    const Hazard& hazard = mark.hazard;
    layer.features.push_back(
        {{in_grid(mark.T_survey_centre.translation())},
         {hazard.kind, hazard.unit.empty() ? AttributeValue() : known(hazard.value), hazard.unit,
          hazard.evidence, hazard.size_m.x(), hazard.size_m.y(), date_text(hazard.utime)},
         hazard.kind});
  }
  return layer;
}

VectorLayer LayerBuilder::path() const {
  VectorLayer layer{"path", Geometry::kLine, {{"length_m", kNumber}}, {}};
  VectorFeature feature{{}, {distance_travelled_m(survey_.input().map().path(), kTravelStepM)}, ""};
  for (const Eigen::Vector3d& p : survey_.path()) feature.points.push_back(in_grid(p));
  if (feature.points.size() > 1) layer.features.push_back(std::move(feature));
  return layer;
}

/// Middle of the places of the laser in survey.
Eigen::Vector3d laser_place(const RegisteredCloud& cloud, const PlacedCloud& scan) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int lines = 0;
  for (const CloudLine& line : cloud.lines_of(scan)) {
    if (!is_at_place(cloud.scan_of(scan), line)) continue;
    sum += line.origin.cast<double>();
    ++lines;
  }
  return scan.in_survey(sum / std::max(1, lines));
}

VectorLayer LayerBuilder::scans() const {
  VectorLayer layer{"scans",
                    Geometry::kPoint,
                    {{"scan", kInteger},
                     {"time", kText},
                     {"points", kInteger},
                     {"complete", kText},
                     {"laser_m", kNumber},
                     {"step_sd_m", kNumber},
                     {"step_turn_sd_rad", kNumber},
                     {"step_z_sd_m", kNumber}},
                    {}};
  const RegisteredCloud& cloud = survey_.cloud();
  const SurveyGraph& graph = cloud.graph();
  std::size_t before = 0;
  for (const PlacedCloud& scan : cloud.scans()) {
    if (layer.features.empty()) before = scan.node;
    const Eigen::Matrix3d step = graph.covariance_between(before, scan.node);
    const double step_z_m = std::sqrt(graph.z_variance_between(before, scan.node));
    before = scan.node;
    layer.features.push_back({{in_grid(scan.T_survey_level.translation())},
                              {std::int64_t{scan.number}, date_text(scan.utime),
                               static_cast<std::int64_t>(cloud.points_of(scan)),
                               std::string(cloud.scan_of(scan).complete ? "yes" : "no"),
                               in_grid(laser_place(cloud, scan)).z(), position_sd_m(step),
                               std::sqrt(step(2, 2)), step_z_m},
                              ""});
  }
  return layer;
}

/// The semi-axes of the 95 % ellipse are those of one standard deviation times 2.4477 (chi-square
/// with two degrees of freedom).
VectorLayer LayerBuilder::traverse() const {
  constexpr double kEllipse95 = 2.447747;
  VectorLayer layer{"traverse",
                    Geometry::kPoint,
                    {{"local_map", kInteger},
                     {"plan_sd_m", kNumber},
                     {"z_sd_m", kNumber},
                     {"ellipse_major_m", kNumber},
                     {"ellipse_minor_m", kNumber},
                     {"ellipse_bearing_deg", kNumber}},
                    {}};
  for (const SurveyGraph::Node& node : survey_.graph().nodes()) {
    const Eigen::Matrix2d plan = node.covariance.topLeftCorner<2, 2>();
    const auto eigen = symmetric_eigen(plan);  // ascending
    const Eigen::Vector2d major = eigen.vectors.col(1);
    const double bearing = std::remainder(rad_to_deg(std::atan2(major.x(), major.y())), 180.0);
    layer.features.push_back(
        {{in_grid(node.T_survey_local.translation())},
         {std::int64_t{node.id}, position_sd_m(node.covariance), std::sqrt(node.z_variance),
          kEllipse95 * std::sqrt(std::max(0.0, eigen.values[1])),
          kEllipse95 * std::sqrt(std::max(0.0, eigen.values[0])),
          bearing < 0.0 ? bearing + 180.0 : bearing},
         ""});
  }
  return layer;
}

VectorLayer LayerBuilder::control() const {
  VectorLayer layer{"control",
                    Geometry::kPoint,
                    {{"name", kText},
                     {"residual_easting_m", kNumber},
                     {"residual_northing_m", kNumber},
                     {"residual_elevation_m", kNumber},
                     {"suspect", kText}},
                    {}};
  for (const ControlResidual& point : survey_.datum().residuals) {
    Eigen::Vector3d p = point.given;
    if (!std::isfinite(p.x())) continue;  // a level, whose place is not given
    if (!std::isfinite(p.z())) p.z() = 0.0;
    layer.features.push_back(
        {{p},
         {point.name, known(point.residual.x()), known(point.residual.y()),
          known(point.residual.z()), std::string(point.is_suspect() ? "yes" : "no")},
         point.name});
  }
  return layer;
}

VectorLayer LayerBuilder::given_lines() const {
  VectorLayer layer{"given_lines", Geometry::kLine, {{"layer", kText}, {"name", kText}}, {}};
  for (const GivenLine& line : survey_.given_lines()) {
    VectorFeature feature{{}, {line.layer, line.name}, line.name};
    for (const Eigen::Vector2d& p : line.points) feature.points.emplace_back(p.x(), p.y(), 0.0);
    if (feature.points.size() == 1) feature.points.push_back(feature.points.front());
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

VectorLayer LayerBuilder::approaches() const {
  VectorLayer layer{"approaches",
                    Geometry::kLine,
                    {{"layer", kText},
                     {"name", kText},
                     {"distance_m", kNumber},
                     {"distance_sd_m", kNumber},
                     {"within", kText}},
                    {}};
  for (const CloseApproach& at : survey_.approaches()) {
    layer.features.push_back({{in_grid(at.p_wall, 0.0), in_grid(at.p_given, 0.0)},
                              {at.layer, at.name, at.distance_m.value, at.distance_m.sd,
                               std::string(at.within ? "yes" : "no")},
                              fmt::format("{:.1f} m", at.distance_m.value)});
  }
  return layer;
}

}  // namespace

std::vector<VectorLayer> survey_layers(const MineSurvey& survey) {
  const LayerBuilder builder(survey);
  std::vector<VectorLayer> layers{
      builder.walls(),
      builder.pillars(),
      builder.floor_contours(),
      builder.centre_lines(),
      builder.sections(),
      builder.junctions(),
      builder.frontiers(),
      builder.hazards(),
      builder.path(),
      builder.scans(),
      builder.traverse(),
      builder.control(),
      builder.given_lines(),
      builder.approaches(),
      water_layer(survey.water(), survey.frame(), survey.columns().cell_m)};
  std::erase_if(layers, [](const VectorLayer& layer) { return layer.features.empty(); });
  return layers;
}

}  // namespace adit
