// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/plan/outlines.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "common/grid/distance_transform.hpp"
#include "tools/survey/files/contour_lines.hpp"
#include "tools/survey/raster/elevation_rasters.hpp"
#include "tools/survey/raster/void_volume.hpp"

namespace adit {
namespace {

constexpr double kOutlineMinM = 1.0;
constexpr double kContourMinM = 2.0;
constexpr double kContourIntervalM = 0.25;
constexpr double kUnitInterval = 1.0;

bool is_void(const SurveyColumn& column) { return column.kind == SurveyColumn::Kind::kVoid; }

/// Share of void, with a rim: 1 in void, 0 in rock and where nothing was seen; through a wall,
/// whose relief fills a cell or two, it falls so that it is half in the middle, as void_volume
/// counts it.
Grid2<float> void_shares(const ColumnGrid& grid) {
  constexpr float kUnderHalf = 1e-3F;  // no cell is exactly on the contour
  const double wall_max_m = VoidVolumeParams{}.wall_max_m;
  const CellBox box{grid.columns.box().from.array() - 1, grid.columns.box().to.array() + 1};
  Grid2<std::uint8_t> voids(box);
  for (std::size_t i = 0; i < voids.size(); ++i)
    voids[i] = is_void(grid.columns.get(voids.cell(i))) ? 1 : 0;
  const Grid2<float> to_void_m = distance_transform(voids, grid.cell_m);
  Grid2<std::uint8_t> rock(box);
  for (std::size_t i = 0; i < rock.size(); ++i) {
    const bool is_wall = grid.columns.get(rock.cell(i)).kind == SurveyColumn::Kind::kWall;
    rock[i] = voids[i] == 0 && !(is_wall && to_void_m[i] <= wall_max_m) ? 1 : 0;
  }
  const Grid2<float> to_rock_m = distance_transform(rock, grid.cell_m);
  Grid2<float> shares(box);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (voids[i] != 0) {
      shares[i] = 1.0F;
    } else if (rock[i] == 0) {
      shares[i] = to_rock_m[i] / (to_void_m[i] + to_rock_m[i]) - kUnderHalf;
    }
  }
  return shares;
}

Raster raster_of(const Grid2<float>& shares, double cell_m) {
  const CellBox& box = shares.box();
  Raster raster;
  raster.columns = box.size().x();
  raster.rows = box.size().y();
  raster.cell_m = cell_m;
  raster.north_west = cell_m * Eigen::Vector2d(box.from.x(), box.to.y());
  RasterBand band{"void", "", {}};
  for (int y = box.to.y() - 1; y >= box.from.y(); --y) {
    for (int x = box.from.x(); x < box.to.x(); ++x) band.values.push_back(shares.at({x, y}));
  }
  raster.bands.push_back(std::move(band));
  return raster;
}

double signed_area_m2(const std::vector<Eigen::Vector2d>& ring) {
  double area = 0.0;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i)
    area += 0.5 * (ring[i].x() * ring[i + 1].y() - ring[i].y() * ring[i + 1].x());
  return area;
}

/// A column of void beside a line, and on which side it is.
struct BesideLine {
  const SurveyColumn* column = nullptr;
  bool left = false;
};

BesideLine void_beside(const std::vector<Eigen::Vector2d>& line, const ColumnGrid& grid) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Eigen::Vector2d along = line[i + 1] - line[i];
    if (along.norm() < 1e-9) continue;
    const Eigen::Vector2d left = Eigen::Vector2d(-along.y(), along.x()).normalized();
    for (const double cells : {1.0, 2.0, 3.0}) {  // beyond half of a wall
      for (const double side : {1.0, -1.0}) {
        const Eigen::Vector2d p = 0.5 * (line[i] + line[i + 1]) + side * cells * grid.cell_m * left;
        const Eigen::Vector2i cell = cell_of(p, grid.cell_m);
        if (grid.columns.contains(cell) && is_void(grid.columns.at(cell)))
          return {&grid.columns.at(cell), side > 0.0};
      }
    }
  }
  return {};
}

}  // namespace

/// A closed line is a pillar if the void is outside of it: on its right where it runs
/// counter-clockwise.
std::vector<VoidOutline> void_outlines(const ColumnGrid& filled) {
  std::vector<VoidOutline> outlines;
  if (filled.columns.size() == 0) return outlines;
  for (ContourLine& line :
       contour_lines(raster_of(void_shares(filled), filled.cell_m), 0.5, kUnitInterval)) {
    if (line.length_m() < kOutlineMinM) continue;
    const BesideLine beside = void_beside(line.points, filled);
    if (beside.column == nullptr) continue;
    VoidOutline outline;
    const double area_m2 = signed_area_m2(line.points);
    outline.is_pillar = line.is_closed() && beside.left != (area_m2 > 0.0);
    outline.length_m = line.length_m();
    outline.area_m2 = std::abs(area_m2);
    outline.z_m = std::isfinite(beside.column->floor_m) ? beside.column->floor_m : 0.0F;
    outline.points = std::move(line.points);
    outlines.push_back(std::move(outline));
  }
  return outlines;
}

std::vector<FloorContour> floor_contour_lines(const ColumnGrid& columns, const SurveyFrame& frame) {
  std::vector<FloorContour> contours;
  if (columns.columns.size() == 0) return contours;
  for (ContourLine& line : contour_lines(floor_raster(columns, frame), 0.0, kContourIntervalM)) {
    if (line.length_m() < kContourMinM) continue;
    contours.push_back({line.level, std::move(line.points)});
  }
  return contours;
}

}  // namespace adit
