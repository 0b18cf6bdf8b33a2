// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/svg/terrain_svg.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "common/geometry/pose2.hpp"
#include "common/types/body_outline.hpp"
#include "common/types/terrain_map.hpp"
#include "tools/report/svg/indexed_png.hpp"
#include "tools/report/svg/markup.hpp"
#include "tools/report/text_format.hpp"

namespace adit {
namespace {

constexpr double kOutlineSpacingM = 1.5;  // between outlines of the vehicle on the path
constexpr double kMarginM = 0.6;          // around observed cells
constexpr double kSideMinM = 6.0;
constexpr int kPixelsPerCell = 4;

/// Transforms the frame level to a drawing of some cells of a terrain: a unit per cell, y down.
class CellView {
 public:
  /// `terrain` must outlive this.
  CellView(const TerrainMap& terrain, const CellBox& box) : terrain_(terrain), box_(box) {}

  [[nodiscard]] Eigen::Vector2d at(const Eigen::Vector2d& p_level) const {
    const Eigen::Vector2d cell = (p_level - terrain_.p_level_corner) / terrain_.cell_m;
    return {cell.x() - box_.from.x(), box_.to.y() - cell.y()};
  }
  [[nodiscard]] Eigen::Vector2d at(const Pose2& T_odom) const {
    return at(between(terrain_.T_odom_level, T_odom).translation());
  }
  [[nodiscard]] const TerrainMap& terrain() const { return terrain_; }

 private:
  const TerrainMap& terrain_;
  CellBox box_;
};

/// The route of a goal, its line, or its position.
std::vector<Eigen::Vector2d> goal_points(const CellView& view, const PlanGoal& goal) {
  const Pose2 T_level_odom = view.terrain().T_odom_level.inverse();
  std::vector<Eigen::Vector2d> points;
  for (const Eigen::Vector2d& p_odom : goal.route_odom) {
    points.push_back(view.at(T_level_odom * p_odom));
  }
  if (!points.empty()) return points;
  const Pose2 T_level_goal = T_level_odom * goal.T_odom_goal;
  points.push_back(view.at(T_level_goal.translation()));
  if (goal.kind == PlanGoal::Kind::kAlong) {
    points.push_back(view.at(T_level_goal * Eigen::Vector2d(goal.distance_m, 0.0)));
  }
  return points;
}

std::string goal_svg(const CellView& view, const PlanGoal& goal) {
  const std::vector<Eigen::Vector2d> points = goal_points(view, goal);
  std::string line;
  for (const Eigen::Vector2d& point : points) {
    line += line.empty() ? 'M' : 'L';
    line += svg_point(point);
  }
  return fmt::format(R"(<path class="goal" d="{}"/><circle class="goal" cx="{}" cy="{}" r="3"/>)",
                     line, fixed(points.back().x(), 1), fixed(points.back().y(), 1));
}

std::string outline_svg(const CellView& view, const Pose2& T_level_body, const Vehicle& vehicle,
                        const char* css_class) {
  const ConvexPolygon outline = body_outline(vehicle);
  std::string corners;
  for (const Eigen::Vector2d& corner : outline.corners())
    corners += (corners.empty() ? "" : " ") + svg_point(view.at(T_level_body * corner));
  return fmt::format(R"(<polygon class="{}" points="{}"/>)", css_class, corners);
}

/// The path with outlines of the vehicle at regular distances; empty without points.
std::string path_svg(const CellView& view, const PlannedPath& path, const Vehicle& vehicle) {
  std::string outlines;
  std::string line;
  double distance_m = kOutlineSpacingM;  // since the last outline
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const Pose2& T_odom_body = path.points[i].T_odom_body;
    line += (line.empty() ? "" : " ") + svg_point(view.at(T_odom_body));
    if (i > 0) {
      distance_m += between(path.points[i - 1].T_odom_body, T_odom_body).translation().norm();
    }
    if (distance_m < kOutlineSpacingM && i + 1 < path.points.size()) continue;
    distance_m = 0.0;
    outlines +=
        outline_svg(view, between(view.terrain().T_odom_level, T_odom_body), vehicle, "outline");
  }
  if (line.empty()) return "";
  return outlines + fmt::format(R"(<polyline class="path" points="{}"/>)", line);
}

/// Blocking cells by reason. Adjacent cells of a row become one stroke, which keeps the page small.
std::string blocking_svg(const CellView& view, const PlannedPath& path) {
  std::map<BlockingCell::Reason, std::set<std::pair<int, int>>> cells;  // row, column
  for (const BlockingCell& cell : path.blocking) {
    const Eigen::Vector2d p_level = view.terrain().T_odom_level.inverse() * cell.p_odom;
    const Eigen::Vector2d at = view.at(p_level);
    cells[cell.reason].insert(
        {static_cast<int>(std::floor(at.y())), static_cast<int>(std::floor(at.x()))});
  }
  std::string svg;
  for (const auto& [reason, indices] : cells) {
    std::string strokes;
    for (auto at = indices.begin(); at != indices.end();) {
      const auto [row, first] = *at;
      int end = first;
      while (at != indices.end() && at->first == row && at->second == end) ++at, ++end;
      strokes += fmt::format("M{} {}h{}", first, fixed(row + 0.5, 1), end - first);
    }
    const auto& [css_class, name] = blocking_name(reason);
    svg += fmt::format(R"(<path class="{}" d="{}"><title>{}</title></path>)", css_class, strokes,
                       name);
  }
  return svg;
}

/// The vehicle at the origin of level, with a triangle at its front.
std::string vehicle_svg(const CellView& view, const Vehicle& vehicle) {
  const auto point = [&](double x_share, double y_share) {
    return svg_point(
        view.at(Eigen::Vector2d(x_share * vehicle.length_m, y_share * vehicle.width_m)));
  };
  return outline_svg(view, {}, vehicle, "robot") +
         fmt::format(R"(<polygon class="heading" points="{} {} {}"/>)", point(0.4, 0.0),
                     point(0.0, 0.35), point(0.0, -0.35));
}

RgbImage cropped(const RgbImage& image, const CellBox& box) {
  RgbImage part(box.size().x(), box.size().y());
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x) {
      part.at(x, y) = image.at(box.from.x() + x, image.height - box.to.y() + y);
    }
  }
  return part;
}

}  // namespace

const BlockingName& blocking_name(BlockingCell::Reason reason) {
  static constexpr std::array<BlockingName, 7> kNames{{{"blocking-step", "step"},
                                                       {"blocking-belly", "too high for the belly"},
                                                       {"blocking-roof", "roof too low"},
                                                       {"blocking-unknown", "unknown"},
                                                       {"blocking-water", "possible water"},
                                                       {"blocking-slope", "too steep"},
                                                       {"blocking-drop", "drop"}}};
  return kNames.at(static_cast<std::size_t>(reason));
}

CellBox visible_box(const ScanProducts& scan) {
  const TerrainMap& terrain = *scan.terrain;
  const CellBox& map = terrain.cells.box();
  CellBox box{map.to, map.from};
  const auto include = [&](const Eigen::Vector2d& p_level, double margin_m) {
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(margin_m);
    box.from = box.from.cwiseMin(terrain.cell_at(p_level - margin));
    box.to = box.to.cwiseMax(terrain.cell_at(p_level + margin) + Eigen::Vector2i(1, 1));
  };
  include(Eigen::Vector2d::Zero(), kSideMinM / 2.0);
  for (int row = 0; row < terrain.cells.rows(); ++row) {
    for (int column = 0; column < terrain.cells.columns(); ++column) {
      if (terrain.cells.at({column, row}).count > 0) include(terrain.centre(column, row), kMarginM);
    }
  }
  box.from = box.from.cwiseMax(map.from);
  box.to = box.to.cwiseMin(map.to);
  return box.empty() ? map : box;
}

std::string terrain_svg(const ScanProducts& scan, const RgbImage& cells, const CellBox& box,
                        const Vehicle& vehicle, const std::string& title) {
  const CellView view(*scan.terrain, box);
  std::string layers;
  if (scan.goal) layers += goal_svg(view, *scan.goal);
  if (scan.path) layers += path_svg(view, *scan.path, vehicle) + blocking_svg(view, *scan.path);
  layers += vehicle_svg(view, vehicle);
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" class="cells" viewBox="0 0 {0} {1}" width="{2}" height="{3}">)"
      R"(<title>{4}</title><style>{5}</style><image width="{0}" height="{1}" href="{6}"/>{7}</svg>)",
      box.size().x(), box.size().y(), kPixelsPerCell * box.size().x(),
      kPixelsPerCell * box.size().y(), escaped(title), style_file("terrain"),
      data_uri("image/png", indexed_png(cropped(cells, box))), layers);
}

}  // namespace adit
