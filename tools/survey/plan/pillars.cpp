// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/plan/pillars.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "common/geometry/order_statistics.hpp"
#include "common/geometry/ring.hpp"
#include "common/grid/distance_transform.hpp"

namespace adit {
namespace {

constexpr double kPillarMinM2 = 1.0;
constexpr double kPillarWidthMinM = 0.3;  // narrower ones are a wall or an obstacle
constexpr double kWallSdM = 0.01;         // of the place of a wall, common to all around
constexpr double kWallM = 0.3;            // from a wall, to be along it
constexpr double kUnseenShareMax = 0.5;   // of an outline; with more it is what was not looked at
constexpr double kBesideM = 0.6;          // of an outline, for the height of the workings there

/// The diameter of the largest circle in a ring; `to_line_m`: distance of each cell from the
/// nearest outline.
double inscribed_m(const std::vector<Eigen::Vector2d>& ring, const Grid2<float>& to_line_m,
                   double cell_m) {
  CellBox box;
  for (const Eigen::Vector2d& p : ring) box = united(box, cell_of(p, cell_m));
  double radius_m = 0.0;
  for (int y = box.from.y(); y < box.to.y(); ++y) {
    for (int x = box.from.x(); x < box.to.x(); ++x) {
      const double distance_m = to_line_m.get({x, y}, 0.0F);
      if (distance_m > radius_m && encloses(ring, centre_of({x, y}, cell_m))) radius_m = distance_m;
    }
  }
  return 2.0 * radius_m;
}

/// Distance of each cell from the nearest cell through which an outline runs.
Grid2<float> distance_to_lines_m(const std::vector<VoidOutline>& outlines, const CellBox& box,
                                 double cell_m) {
  Grid2<std::uint8_t> lines(box);
  for (const VoidOutline& outline : outlines) {
    for (const Eigen::Vector2d& p : outline.points) {
      const Eigen::Vector2i cell = cell_of(p, cell_m);
      if (lines.contains(cell)) lines.at(cell) = 1;
    }
  }
  return distance_transform(lines, cell_m);
}

double height_beside_m(const std::vector<Eigen::Vector2d>& ring, const ColumnGrid& filled) {
  const int reach = static_cast<int>(std::round(kBesideM / filled.cell_m));
  std::vector<double> heights;
  for (const Eigen::Vector2d& p : ring) {
    const Eigen::Vector2i cell = cell_of(p, filled.cell_m);
    for (const int x : {-reach, reach}) {
      for (const int y : {-reach, reach}) {
        const double height_m = filled.columns.get(cell + Eigen::Vector2i(x, y)).height_m();
        if (std::isfinite(height_m)) heights.push_back(height_m);
      }
    }
  }
  return heights.empty() ? std::numeric_limits<double>::quiet_NaN() : median(std::move(heights));
}

Grid2<float> distance_to_walls_m(const ColumnGrid& filled) {
  Grid2<std::uint8_t> walls(filled.columns.box());
  for (std::size_t i = 0; i < walls.size(); ++i)
    walls[i] = filled.columns[i].kind == SurveyColumn::Kind::kWall ? 1 : 0;
  return distance_transform(walls, filled.cell_m);
}

/// Lengths of the stretches of a closed ring beside which no wall was seen.
std::vector<double> gaps_m(const std::vector<Eigen::Vector2d>& ring, const Grid2<float>& to_wall_m,
                           double cell_m) {
  std::vector<bool> seen;
  for (const Eigen::Vector2d& p : ring)
    seen.push_back(to_wall_m.get(cell_of(p, cell_m), kWallM) < kWallM);
  const auto first = static_cast<std::size_t>(std::ranges::find(seen, true) - seen.begin());
  std::vector<double> gaps;
  bool in_gap = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {  // from a seen point, if there is one
    const std::size_t at = (first + i) % ring.size();
    if (!seen[at] && !in_gap) gaps.push_back(0.0);
    in_gap = !seen[at];
    if (in_gap) gaps.back() += (ring[(at + 1) % ring.size()] - ring[at]).norm();
  }
  return gaps;
}

/// Variance of an area within a ring with gaps, behind each of which the wall lies anywhere up
/// to a half circle, evenly: L² π / 8 / √12 is about L² / 8.
double variance_behind(const std::vector<double>& gaps) {
  double variance = 0.0;
  for (const double length_m : gaps) variance += std::pow(length_m * length_m / 8.0, 2);
  return variance;
}

}  // namespace

std::vector<Pillar> pillars_of(const ColumnGrid& filled) {
  std::vector<Pillar> pillars;
  if (filled.columns.size() == 0) return pillars;
  std::vector<VoidOutline> outlines = void_outlines(filled);
  const Grid2<float> to_wall_m = distance_to_walls_m(filled);
  const Grid2<float> to_line_m = distance_to_lines_m(outlines, filled.columns.box(), filled.cell_m);
  for (VoidOutline& outline : outlines) {
    if (!outline.is_pillar || outline.area_m2 < kPillarMinM2) continue;
    const auto gaps = gaps_m(outline.points, to_wall_m, filled.cell_m);
    Pillar pillar;
    for (const double length_m : gaps) {
      pillar.unseen_m += length_m;
      pillar.gap_m = std::max(pillar.gap_m, length_m);
    }
    if (pillar.unseen_m > kUnseenShareMax * outline.length_m) continue;
    const double by_chance = 0.5 * filled.cell_m * std::sqrt(outline.length_m * filled.cell_m);
    const double behind = variance_behind(gaps);
    pillar.area_m2 = {outline.area_m2,
                      std::hypot(outline.length_m * kWallSdM, by_chance, std::sqrt(behind))};
    pillar.width_m = inscribed_m(outline.points, to_line_m, filled.cell_m);
    if (pillar.width_m < kPillarWidthMinM) continue;
    pillar.height_m = height_beside_m(outline.points, filled);
    pillar.outline = std::move(outline);
    pillars.push_back(std::move(pillar));
  }
  std::ranges::stable_sort(pillars, {}, &Pillar::width_m);
  return pillars;
}

Extraction extraction(const std::vector<Pillar>& pillars, const Measured& void_area_m2) {
  Extraction result;
  double pillars_sd_m2 = 0.0;
  for (const Pillar& pillar : pillars) {
    result.pillars_m2 += pillar.area_m2.value;
    pillars_sd_m2 += pillar.area_m2.sd;
  }
  if (pillars.empty()) {
    result.ratio = {std::numeric_limits<double>::quiet_NaN(), 0.0};
    return result;
  }
  // Where the void is larger, the pillars are smaller by as much.
  const double whole = void_area_m2.value + result.pillars_m2;
  result.ratio = {void_area_m2.value / whole, std::hypot(void_area_m2.sd, pillars_sd_m2) / whole};
  return result;
}

std::string pillar_table(const std::vector<Pillar>& pillars, const SurveyFrame& frame) {
  std::string table =
      "pillar,x_m,y_m,area_m2,area_sd_m2,perimeter_m,width_m,height_m,slender,unseen_m,gap_m,"
      "closed\n";
  int number = 0;
  for (const Pillar& pillar : pillars) {
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& p : pillar.outline.points) middle += p;
    middle =
        frame.in_grid(Eigen::Vector2d(middle / static_cast<double>(pillar.outline.points.size())));
    const bool known_height = std::isfinite(pillar.height_m);
    fmt::format_to(std::back_inserter(table),
                   "{},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f},{},{},{:.2f},{:.2f},{}\n",
                   ++number, middle.x(), middle.y(), pillar.area_m2.value, pillar.area_m2.sd,
                   pillar.outline.length_m, pillar.width_m,
                   known_height ? fmt::format("{:.2f}", pillar.height_m) : "",
                   known_height ? (pillar.is_slender() ? "yes" : "no") : "", pillar.unseen_m,
                   pillar.gap_m, pillar.is_closed() ? "yes" : "no");
  }
  return table;
}

}  // namespace adit
