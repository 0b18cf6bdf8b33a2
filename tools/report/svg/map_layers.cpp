// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/svg/map_layers.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/picture/legend.hpp"
#include "common/picture/palette.hpp"
#include "tools/map/map_files.hpp"
#include "tools/report/mission_statistics.hpp"
#include "tools/report/svg/indexed_png.hpp"
#include "tools/report/svg/markup.hpp"
#include "tools/report/text_format.hpp"

namespace adit {
namespace {

constexpr double kSideUnits = 1000.0;
constexpr double kUnitsPerMetreMax = 40.0;
constexpr double kMarginUnits = 78.0;  // for the numbers beside the path
constexpr int kPixelsMax = 2400;
constexpr double kWallAt = 0.4;  // occupancy that is drawn as a wall
constexpr double kShades = 8.0;
const RgbImage::Pixel kUnknownPixel{255, 0, 255};

constexpr double kPathStepUnits = 0.6;      // below the resolution of a screen
constexpr double kDirectionUnits = 12.0;    // length of the line at a frontier
constexpr double kScanRadiusUnits = 7.5;    // of the circle around a number of two digits
constexpr double kDigitUnits = 2.6;         // added to it for each further digit
constexpr double kScanSpacingUnits = 16.0;  // between rows of numbers beside the path
constexpr int kScanRowsMax = 4;

/// The most occupied cell of a block counts.
RgbImage::Pixel pixel_of(const OccupancyGrid& grid, const Eigen::Vector2i& from, int block) {
  bool known = false;
  double occupancy = 0.0;
  for (int j = 0; j < block; ++j) {
    for (int i = 0; i < block; ++i) {
      const Eigen::Vector2i cell = from + Eigen::Vector2i(i, j);
      if (grid.state(cell) == CellState::kUnknown) continue;
      known = true;
      occupancy = std::max(occupancy, grid.occupancy(cell));
    }
  }
  if (!known) return kUnknownPixel;
  const double wall = std::min(1.0, occupancy / kWallAt);
  return rgb_pixel(blend(kOpen, kWall, std::round(wall * kShades) / kShades));
}

std::string edges(const std::vector<GraphPicture::Edge>& edges, const MapView& view) {
  std::string d;
  for (const auto& [a, b] : edges) d += line_data(view.at(a), view.at(b));
  return d;
}

/// The path between two times, without invisibly small steps.
std::string path_data(const Trajectory& path, std::int64_t from_utime, std::int64_t to_utime,
                      const MapView& view) {
  std::string d;
  std::optional<Eigen::Vector2d> last;
  for (const TimedPose& pose : path) {
    if (pose.utime < from_utime || pose.utime > to_utime) continue;
    const Eigen::Vector2d at = view.at(pose.pose.translation());
    if (last && (at - *last).norm() < kPathStepUnits && pose.utime < path.back().utime) continue;
    d += last ? 'L' : 'M';
    d += svg_point(at);
    last = at;
  }
  return d;
}

std::string css_of(FrontierState state) {
  if (!is_closed(state)) return "open";
  return state == FrontierState::kExplored || state == FrontierState::kOutsideMine ? "done"
                                                                                   : "closed";
}

std::string frontier_svg(const Frontier& frontier, const MapView& view, const std::string& page) {
  const std::string css = css_of(frontier.state);
  const Eigen::Vector2d at = view.at(frontier.p_map);
  const Eigen::Vector2d direction(frontier.direction_map.x(), -frontier.direction_map.y());
  const std::string text =
      fmt::format("Frontier {}, {}: {}", frontier.id, name_of(frontier.state), frontier.evidence);
  const bool done = css == "done";
  const std::string line = line_data(at, at + kDirectionUnits * direction);
  return fmt::format(R"(<a href="{}#frontier-{}">{}{}</a>)", page, frontier.id,
                     done ? "" : svg_path_element("direction " + css, line),
                     svg_circle("frontier " + css, at, done ? 2.6 : 4.5, text));
}

double badge_radius(int number) {
  const auto further = static_cast<int>(std::to_string(number).size()) - 2;
  return kScanRadiusUnits + kDigitUnits * std::max(further, 0);
}

std::string scan_svg(const ScanMark& scan, const Eigen::Vector2d& position,
                     const Eigen::Vector2d& label, const std::string& page) {
  return fmt::format(
      R"(<a class="{}" href="{}#scan-{}"><title>{}</title>{}{}<text x="{}" y="{}">{}</text></a>)",
      scan.has_path ? "scan" : "scan no-path", page, scan.number, escaped(scan.text),
      svg_path_element("lead", line_data(position, label)),
      svg_circle("mark", label, badge_radius(scan.number)), fixed(label.x(), 1),
      fixed(label.y() + 3.0, 1), scan.number);
}

struct Badge {
  Eigen::Vector2d at;
  double radius;
};

/// The nearest position to the left of a scan where its number covers no other.
Eigen::Vector2d free_label_position(const Eigen::Vector2d& position, const Eigen::Vector2d& left,
                                    double radius, const std::vector<Badge>& occupied) {
  const auto is_free = [&](const Eigen::Vector2d& at) {
    return std::none_of(occupied.begin(), occupied.end(), [&](const Badge& other) {
      return (other.at - at).norm() < radius + other.radius;
    });
  };
  const double spacing = kScanSpacingUnits * radius / kScanRadiusUnits;
  int row = 1;
  while (row < kScanRowsMax && !is_free(position + row * spacing * left)) ++row;
  return position + row * spacing * left;
}

}  // namespace

MapView::MapView(const OccupancyGrid* grid, const Trajectory& path) {
  const bool known = grid != nullptr && !grid->observed_box().empty();
  low_ = high_ = path.empty() ? Eigen::Vector2d(0.0, 0.0) : path.front().pose.translation();
  if (known) {
    low_ = grid->resolution_m() * grid->observed_box().from.cast<double>();
    high_ = grid->resolution_m() * grid->observed_box().to.cast<double>();
  }
  for (const TimedPose& pose : path) {
    low_ = low_.cwiseMin(pose.pose.translation());
    high_ = high_.cwiseMax(pose.pose.translation());
  }
  const double longest_m = std::max((high_ - low_).maxCoeff(), 1.0);
  units_per_metre_ = std::min(kSideUnits / longest_m, kUnitsPerMetreMax);
  const Eigen::Vector2d around = Eigen::Vector2d::Constant(kMarginUnits / units_per_metre_);
  low_ -= around;
  high_ += around;
}

std::string ground_svg(const OccupancyGrid& grid, const MapView& view) {
  const CellBox box = grid.observed_box();
  if (box.empty()) return "";
  const int block = (box.size().maxCoeff() + kPixelsMax - 1) / kPixelsMax;
  RgbImage image((box.size().x() + block - 1) / block, (box.size().y() + block - 1) / block);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Eigen::Vector2i from = box.from + block * Eigen::Vector2i(x, image.height - 1 - y);
      image.at(x, y) = pixel_of(grid, from, block);
    }
  }
  const double cell_m = block * grid.resolution_m();
  const Eigen::Vector2d corner =
      grid.resolution_m() * box.from.cast<double>() + Eigen::Vector2d(0.0, image.height * cell_m);
  const Eigen::Vector2d at = view.at(corner);
  const double units_per_pixel = cell_m * view.units_per_metre();
  return fmt::format(R"(<image class="ground" x="{}" y="{}" width="{}" height="{}" href="{}"/>)",
                     fixed(at.x(), 2), fixed(at.y(), 2), fixed(image.width * units_per_pixel, 2),
                     fixed(image.height * units_per_pixel, 2),
                     data_uri("image/png", indexed_png(image, kUnknownPixel)));
}

std::string corridors_svg(const CorridorGraph& graph, const MapView& view) {
  std::string parts;
  for (const Corridor& corridor : graph.corridors) {
    std::string d;
    for (const Eigen::Vector2d& p : corridor.points) {
      d += d.empty() ? 'M' : 'L';
      d += svg_point(view.at(p));
    }
    parts += svg_path_element("corridor", d);
  }
  for (const CorridorNode& node : graph.nodes) {
    if (node.kind == CorridorNode::Kind::kJunction)
      parts += svg_circle("junction", view.at(node.p_map), 3, "junction");
    if (node.kind == CorridorNode::Kind::kDeadEnd)
      parts += svg_circle("dead-end", view.at(node.p_map), 2.5, "dead end");
  }
  return svg_group("layer-corridors", parts);
}

std::string graph_svg(const MissionMap& map, const MapView& view) {
  const GraphPicture graph = graph_picture(map.full_map());
  std::string nodes;
  for (const Pose2& node : graph.nodes)
    nodes += svg_circle("node", view.at(node.translation()), 1.2);
  return svg_group("layer-graph",
                   svg_path_element("edge", edges(graph.sequential, view)) + nodes +
                       svg_path_element("loop-closure", edges(graph.loop_closures, view))) +
         svg_group("layer-revoked", svg_path_element("revoked", edges(graph.revoked, view)));
}

std::string paths_svg(const Trajectory& path, const std::optional<std::int64_t>& return_home_utime,
                      const MapView& view) {
  if (path.empty()) return "";
  const std::int64_t end = path.back().utime;
  const std::int64_t turn = return_home_utime.value_or(end);
  const std::string outbound = path_data(path, path.front().utime, turn, view);
  const std::string back = return_home_utime ? path_data(path, turn, end, view) : "";
  return svg_group("layer-path",
                   svg_path_element("outbound", outbound) + svg_path_element("return", back));
}

std::string frontiers_svg(const std::vector<Frontier>& frontiers, const MapView& view,
                          const std::string& page) {
  std::string parts;
  for (const bool closed : {true, false}) {  // open ones on top
    for (const Frontier& frontier : frontiers) {
      if (is_closed(frontier.state) == closed) parts += frontier_svg(frontier, view, page);
    }
  }
  return svg_group("layer-frontiers", parts);
}

std::string scans_svg(const std::vector<ScanMark>& scans, const MapView& view,
                      const std::string& page) {
  std::vector<Badge> occupied;
  std::string parts;
  for (const ScanMark& scan : scans) {
    const double heading = scan.T_map_laser.theta;
    const Eigen::Vector2d position = view.at(scan.T_map_laser.translation());
    const Eigen::Vector2d left(-std::sin(heading), -std::cos(heading));
    const double radius = badge_radius(scan.number);
    occupied.push_back({free_label_position(position, left, radius, occupied), radius});
    parts += scan_svg(scan, position, occupied.back().at, page);
  }
  return svg_group("layer-scans", parts);
}

std::string ends_svg(const Trajectory& path, const MapView& view) {
  if (path.empty()) return "";
  return svg_circle("start", view.at(path.front().pose.translation()), 6.0, "start") +
         svg_circle("end", view.at(path.back().pose.translation()), 4.0, "end");
}

std::string scale_svg(const MapView& view, const Eigen::Vector2d& left) {
  const double length_m = scale_bar_m(std::max(view.width() / 4.0, 60.0) / view.units_per_metre());
  const double units = length_m * view.units_per_metre();
  const auto x = [&](double share) { return fixed(left.x() + share * units, 1); };
  return fmt::format(
      R"(<g class="scale"><path d="M{0} {3}v-6v12v-6H{2}v-6v12v-6M{1} {3}v-4"/>)"
      R"(<text x="{0}" y="{4}">0</text><text x="{2}" y="{4}" text-anchor="end">{5} m</text></g>)",
      x(0.0), x(0.5), x(1.0), fixed(left.y(), 1), fixed(left.y() - 10.0, 1),
      fixed(length_m, length_m < 1 ? 1 : 0));
}

}  // namespace adit
