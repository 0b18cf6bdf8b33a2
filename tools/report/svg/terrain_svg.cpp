// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/svg/terrain_svg.hpp"

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "tools/report/html/text_format.hpp"
#include "tools/report/svg/indexed_png.hpp"
#include "tools/report/svg/svg_elements.hpp"

namespace adit {
namespace {

constexpr double kOutlineEveryM = 1.5;

/// As far as the robot is to get: along a line, along a route, or a place.
std::vector<Eigen::Vector2d> goal_points(const CellView& view, const PlanGoal& goal) {
  const Pose2 T_level_odom = view.terrain().T_odom_level.inverse();
  std::vector<Eigen::Vector2d> way;
  for (const Eigen::Vector2d& p_odom : goal.route_odom)
    way.push_back(view.at(T_level_odom * p_odom));
  if (!way.empty()) return way;
  const Pose2 T_level_goal = T_level_odom * goal.T_odom_goal;
  way.push_back(view.at(T_level_goal.translation()));
  if (goal.kind == PlanGoal::Kind::kAlong) {
    way.push_back(view.at(T_level_goal * Eigen::Vector2d(goal.distance_m, 0.0)));
  }
  return way;
}

}  // namespace

std::string svg_outline(const CellView& view, const Pose2& T_level_body, const Vehicle& vehicle,
                        const char* css_class) {
  const double x = vehicle.length_m / 2.0;
  const double y = vehicle.width_m / 2.0;
  std::string points;
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(-x, -y), Eigen::Vector2d(x, -y),
                                        Eigen::Vector2d(x, y), Eigen::Vector2d(-x, y)}) {
    points += svg_point(view.at(T_level_body * corner)) + " ";
  }
  points.pop_back();
  return std::string("<polygon class=\"") + css_class + "\" points=\"" + points + "\"/>";
}

std::string svg_planned_path(const CellView& view, const PlannedPath& path,
                             const Vehicle& vehicle) {
  std::string outlines;
  std::string line;
  double way = kOutlineEveryM;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const Pose2& T_odom_body = path.points[i].T_odom_body;
    line += svg_point(view.at(T_odom_body)) + " ";
    if (i > 0) way += between(path.points[i - 1].T_odom_body, T_odom_body).translation().norm();
    if (way < kOutlineEveryM && i + 1 < path.points.size()) continue;
    way = 0.0;
    outlines +=
        svg_outline(view, between(view.terrain().T_odom_level, T_odom_body), vehicle, "step");
  }
  if (line.empty()) return "";
  line.pop_back();
  return outlines + "<polyline class=\"way\" points=\"" + line + "\"/>";
}

/// Cells side by side are one stroke, so that a page does not grow with them.
std::string svg_blocking(const CellView& view, const PlannedPath& path) {
  std::map<BlockingCell::Reason, std::set<std::pair<int, int>>> cells;  // row, column
  for (const BlockingCell& cell : path.blocking) {
    const Eigen::Vector2d p_level = view.terrain().T_odom_level.inverse() * cell.p_odom;
    const Eigen::Vector2d at = view.at(p_level);
    cells[cell.reason].insert(
        {static_cast<int>(std::floor(at.y())), static_cast<int>(std::floor(at.x()))});
  }
  std::string text;
  for (const auto& [reason, places] : cells) {
    const BlockingName& name = blocking_name(reason);
    text += std::string("<path class=\"") + name.css_class + "\" d=\"";
    for (auto at = places.begin(); at != places.end();) {
      const auto [row, first] = *at;
      int end = first;
      while (at != places.end() && at->first == row && at->second == end) ++at, ++end;
      text += 'M' + std::to_string(first) + ' ' + fixed(row + 0.5, 1) + 'h' +
              std::to_string(end - first);
    }
    text += "\"><title>" + std::string(name.name) + "</title></path>";
  }
  return text;
}

std::string svg_goal(const CellView& view, const PlanGoal& goal) {
  const std::vector<Eigen::Vector2d> way = goal_points(view, goal);
  std::string line;
  for (const Eigen::Vector2d& place : way) {
    line += line.empty() ? 'M' : 'L';
    line += svg_point(place);
  }
  return "<path class=\"goal\" d=\"" + line + "\"/><circle class=\"goal\" cx=\"" +
         fixed(way.back().x(), 1) + "\" cy=\"" + fixed(way.back().y(), 1) + "\" r=\"3\"/>";
}

const BlockingName& blocking_name(BlockingCell::Reason reason) {
  static constexpr std::array<BlockingName, 7> kNames{{{"b0", "a step"},
                                                       {"b1", "too high to drive over"},
                                                       {"b2", "the roof"},
                                                       {"b3", "not seen"},
                                                       {"b4", "perhaps water"},
                                                       {"b5", "too steep"},
                                                       {"b6", "a drop"}}};
  return kNames.at(static_cast<std::size_t>(reason));
}

namespace {

constexpr double kAroundM = 0.6;
constexpr double kLeastSideM = 6.0;

RgbImage cut(const RgbImage& image, const CellBox& box) {
  RgbImage part(box.size().x(), box.size().y());
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x) {
      part.at(x, y) = image.at(box.from.x() + x, image.height - box.to.y() + y);
    }
  }
  return part;
}

}  // namespace

CellBox visible_box(const ScanProducts& scan) {
  const TerrainMap& terrain = *scan.terrain;
  const Eigen::Vector2i size(terrain.columns, terrain.rows);
  CellBox box{size, {0, 0}};
  const auto include = [&](const Eigen::Vector2d& p_level, double around_m) {
    const Eigen::Vector2d around = Eigen::Vector2d::Constant(around_m);
    const auto cell = [&](const Eigen::Vector2d& p) {
      return Eigen::Vector2i(
          ((p - terrain.p_level_corner) / terrain.cell_m).array().floor().cast<int>());
    };
    box.from = box.from.cwiseMin(cell(p_level - around));
    box.to = box.to.cwiseMax(cell(p_level + around) + Eigen::Vector2i(1, 1));
  };
  include(Eigen::Vector2d::Zero(), kLeastSideM / 2.0);
  for (int row = 0; row < terrain.rows; ++row) {
    for (int column = 0; column < terrain.columns; ++column) {
      if (terrain.at(column, row).count > 0) include(terrain.centre(column, row), kAroundM);
    }
  }
  box.from = box.from.cwiseMax(Eigen::Vector2i(0, 0));
  box.to = box.to.cwiseMin(size);
  return box.empty() ? CellBox{{0, 0}, size} : box;
}

std::string terrain_svg(const ScanProducts& scan, const RgbImage& cells, const CellBox& box,
                        const Vehicle& vehicle, const std::string& label) {
  const CellView view(*scan.terrain, box);
  const std::string width = std::to_string(box.size().x());
  const std::string height = std::to_string(box.size().y());
  std::string svg = "<svg class=\"cells\" viewBox=\"0 0 " + width + " " + height +
                    "\" role=\"img\" aria-label=\"" + escaped(label) + "\"><image width=\"" +
                    width + "\" height=\"" + height + "\" href=\"" +
                    data_uri("image/png", indexed_png(cut(cells, box))) + "\"/>";
  if (scan.goal) svg += svg_goal(view, *scan.goal);
  if (scan.path)
    svg += svg_planned_path(view, *scan.path, vehicle) + svg_blocking(view, *scan.path);
  svg += svg_outline(view, {}, vehicle, "robot");
  const Eigen::Vector2d ahead = view.at(Eigen::Vector2d(0.4 * vehicle.length_m, 0.0));
  const Eigen::Vector2d left = view.at(Eigen::Vector2d(0.0, 0.35 * vehicle.width_m));
  const Eigen::Vector2d right = view.at(Eigen::Vector2d(0.0, -0.35 * vehicle.width_m));
  svg += std::string("<polygon class=\"ahead\" points=\"") + svg_point(ahead) + " " +
         svg_point(left) + " " + svg_point(right) + "\"/></svg>";
  return svg;
}

}  // namespace adit
