// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/plan/approaches.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "common/geometry/ring.hpp"
#include "common/geometry/segment.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "tools/survey/plan/outlines.hpp"

namespace adit {
namespace {

constexpr double kOutlineSdM = 0.01;  // of the place of a wall, beside that of its local map
constexpr std::size_t kSegmentsPerStretch = 32;

/// A part of an outline, with its box.
struct WallStretch {
  std::vector<Segment2> segments;
  Eigen::AlignedBox2d box;
};

std::vector<WallStretch> wall_stretches(const ColumnGrid& filled) {
  std::vector<WallStretch> stretches;
  for (const VoidOutline& outline : void_outlines(filled)) {
    for (std::size_t i = 0; i + 1 < outline.points.size(); ++i) {
      if (i % kSegmentsPerStretch == 0) stretches.emplace_back();
      stretches.back().segments.push_back({outline.points[i], outline.points[i + 1]});
      stretches.back().box.extend(outline.points[i]).extend(outline.points[i + 1]);
    }
  }
  return stretches;
}

/// The nearest points of the walls and of a line of one or more points.
ClosestPair nearest_to_walls(const std::vector<WallStretch>& walls,
                             const std::vector<Eigen::Vector2d>& line) {
  ClosestPair best;
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < std::max<std::size_t>(1, line.size() - 1); ++i) {
    const Segment2 segment{line[i], line[std::min(i + 1, line.size() - 1)]};
    const Eigen::AlignedBox2d box = Eigen::AlignedBox2d(segment.from).extend(segment.to);
    for (const WallStretch& stretch : walls) {
      if (stretch.box.exteriorDistance(box) >= least_m) continue;
      for (const Segment2& wall : stretch.segments) {
        const ClosestPair pair = nearest_points(wall, segment);
        if (pair.distance() >= least_m) continue;
        least_m = pair.distance();
        best = pair;
      }
    }
  }
  return best;
}

/// A field of comma-separated values.
std::string quoted(std::string text) {
  for (char& c : text) {
    if (c == '"') c = '\'';
    if (c == '\n' || c == '\r') c = ' ';
  }
  return '"' + text + '"';
}

bool is_in_void(const ColumnGrid& filled, const Eigen::Vector2d& p_survey) {
  return filled.columns.get(cell_of(p_survey, filled.cell_m)).kind == SurveyColumn::Kind::kVoid;
}

}  // namespace

std::vector<CloseApproach> approaches_to(const std::vector<GivenLine>& given,
                                         const ColumnGrid& filled, const SurveyGraph& graph,
                                         const SurveyFrame& frame) {
  std::vector<CloseApproach> approaches;
  const std::vector<WallStretch> walls = wall_stretches(filled);
  if (walls.empty()) return approaches;
  for (const GivenLine& line : given) {
    std::vector<Eigen::Vector2d> points;
    for (const Eigen::Vector2d& p : line.points) points.push_back(frame.in_survey(p));
    ClosestPair nearest = nearest_to_walls(walls, points);
    // A line that does not cross a wall lies in the workings as a whole, or not at all.
    if (is_in_void(filled, points.front())) nearest = {points.front(), points.front()};
    CloseApproach approach{line.layer, line.name, {}, nearest.on_a, nearest.on_b};
    approach.within = line.is_area && encloses(points, nearest.on_a);
    const Eigen::Vector3d p_wall(nearest.on_a.x(), nearest.on_a.y(), 0.0);
    const Eigen::Matrix3d covariance =
        graph.covariance_at(graph.node_near_in_survey(nearest.on_a), p_wall);
    const Eigen::Vector2d n = (nearest.on_b - nearest.on_a).stableNormalized();
    const double place_sd_m = n.isZero() ? position_sd_m(covariance)
                                         : std::sqrt(n.dot(covariance.topLeftCorner<2, 2>() * n));
    approach.distance_m = {nearest.distance(), std::hypot(place_sd_m, kOutlineSdM)};
    approaches.push_back(approach);
  }
  std::ranges::stable_sort(approaches, {},
                           [](const CloseApproach& at) -> double { return at.distance_m.value; });
  return approaches;
}

std::string approach_table(const std::vector<CloseApproach>& approaches, const SurveyFrame& frame) {
  std::string table =
      "layer,name,distance_m,distance_sd_m,wall_x_m,wall_y_m,given_x_m,given_y_m,within\n";
  for (const CloseApproach& at : approaches) {
    const Eigen::Vector2d wall = frame.in_grid(at.p_wall);
    const Eigen::Vector2d given = frame.in_grid(at.p_given);
    fmt::format_to(std::back_inserter(table),
                   "{},{},{:.2f},{:.3f},{:.2f},{:.2f},{:.2f},{:.2f},{}\n", quoted(at.layer),
                   quoted(at.name), at.distance_m.value, at.distance_m.sd, wall.x(), wall.y(),
                   given.x(), given.y(), at.within ? "yes" : "no");
  }
  return table;
}

}  // namespace adit
