// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/grid/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "common/files/file_utils.hpp"

namespace adit {
namespace {

constexpr double kFarthestCell = 1e8;  // keeps coordinates far below the limit of int

/// A box around `needed` with a margin, so that the map grows much less often than scans arrive.
CellBox with_margin(const CellBox& needed, const CellBox& present) {
  CellBox box = needed;
  const Eigen::Vector2i margin = Eigen::Vector2i::Constant(64) + needed.size() / 4;
  for (int axis = 0; axis < 2; ++axis) {
    if (present.empty() || needed.from[axis] < present.from[axis]) box.from[axis] -= margin[axis];
    if (present.empty() || needed.to[axis] > present.to[axis]) box.to[axis] += margin[axis];
  }
  return box;
}

void count(std::uint16_t& counter) {
  if (counter < std::numeric_limits<std::uint16_t>::max()) ++counter;
}

}  // namespace

bool OccupancyGrid::insert(const LaserScan& scan, const Pose2& T_map_laser) {
  const double reach = T_map_laser.translation().cwiseAbs().maxCoeff() + params_.range_max_m;
  if (!T_map_laser.vector().allFinite() || reach / params_.resolution_m > kFarthestCell)
    return false;
  const std::vector<Eigen::Vector2d> ends = end_points(scan, T_map_laser);
  if (ends.empty()) return true;

  const Eigen::Vector2d start = T_map_laser.translation();
  CellBox needed{cell_at(start), cell_at(start) + Eigen::Vector2i(1, 1)};
  for (const Eigen::Vector2d& end : ends) {
    const Eigen::Vector2i cell = cell_at(end);
    needed = united(needed, cell);
  }
  if (!reserve(needed)) return false;

  ++scan_;
  for (const Eigen::Vector2d& end : ends) {
    Cell& cell = cells_.at(cell_at(end));
    if (cell.last_scan != scan_) count(cell.hits);
    cell.last_scan = scan_;
  }
  for (const Eigen::Vector2d& end : ends) count_misses(start, end);
  return true;
}

CellState OccupancyGrid::state(const Eigen::Vector2i& cell) const {
  const Cell* found = find(cell);
  if (found == nullptr || found->hits + found->misses == 0) return CellState::kUnknown;
  return occupancy(cell) >= kOccupiedShare ? CellState::kOccupied : CellState::kFree;
}

double OccupancyGrid::occupancy(const Eigen::Vector2i& cell) const {
  const Cell* found = find(cell);
  if (found == nullptr || found->hits == 0) return 0.0;
  return static_cast<double>(found->hits) / (found->hits + found->misses);
}

OccupancyGrid::Counts OccupancyGrid::counts(const Eigen::Vector2i& cell) const {
  const Cell* found = find(cell);
  return found == nullptr ? Counts{} : Counts{found->hits, found->misses};
}

CellBox OccupancyGrid::observed_box() const {
  CellBox observed;
  const CellBox& box = cells_.box();
  for (int j = box.from.y(); j < box.to.y(); ++j) {
    for (int i = box.from.x(); i < box.to.x(); ++i) {
      const Eigen::Vector2i cell(i, j);
      if (state(cell) == CellState::kUnknown || observed.contains(cell)) continue;
      observed = united(observed, cell);
    }
  }
  return observed;
}

Eigen::Vector2i OccupancyGrid::cell_at(const Eigen::Vector2d& p_map) const {
  return (p_map / params_.resolution_m).array().floor().cast<int>();
}

std::vector<Eigen::Vector2d> OccupancyGrid::end_points(const LaserScan& scan,
                                                       const Pose2& T_map_laser) const {
  std::vector<Eigen::Vector2d> ends;
  ends.reserve(scan.ranges_m.size());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range = scan.ranges_m[i];
    if (!(range >= params_.range_min_m && range <= params_.range_max_m)) continue;  // NaN too
    const double angle =
        T_map_laser.theta + scan.angle_min_rad + static_cast<double>(i) * scan.angle_step_rad;
    if (!std::isfinite(angle)) continue;
    ends.push_back(T_map_laser.translation() +
                   range * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return ends;
}

/// Grows the grid so that it contains `box`. False if it would exceed `cells_max`.
bool OccupancyGrid::reserve(const CellBox& box) {
  const CellBox& present = cells_.box();
  if (!present.empty() && present.contains(box)) return true;
  const CellBox grown = with_margin(united(present, box), present);
  if (grown.count() > static_cast<std::size_t>(params_.cells_max)) return false;
  cells_ = cells_.grown_to(grown);
  return true;
}

/// Counts a miss in each cell between two points (Amanatides & Woo 1987), except cells that this
/// scan has already observed. Both points and all cells between them lie in the map.
void OccupancyGrid::count_misses(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d start = from / params_.resolution_m;
  const Eigen::Vector2d ray = to / params_.resolution_m - start;
  const Eigen::Vector2i cell = cell_at(from);
  Eigen::Vector2i steps_left = (cell_at(to) - cell).cwiseAbs();  // along each axis
  Eigen::Vector2d next;  // share of the ray at which it leaves the cell along each axis
  Eigen::Vector2d stride;
  for (int axis = 0; axis < 2; ++axis) {
    const double edge = cell[axis] + (ray[axis] < 0.0 ? 0.0 : 1.0);
    const double length = std::abs(ray[axis]);
    stride[axis] = length > 0.0 ? 1.0 / length : std::numeric_limits<double>::infinity();
    next[axis] = length > 0.0 ? std::abs(edge - start[axis]) / length : stride[axis];
  }
  const std::ptrdiff_t row = cells_.columns();
  const std::ptrdiff_t step[2] = {ray.x() < 0.0 ? -1 : 1, ray.y() < 0.0 ? -row : row};
  for (Cell* current = &cells_.at(cell); steps_left.sum() > 0;) {
    if (current->last_scan != scan_) {
      count(current->misses);
      current->last_scan = scan_;
    }
    const int axis = steps_left.y() == 0 || (steps_left.x() > 0 && next.x() < next.y()) ? 0 : 1;
    current += step[axis];
    next[axis] += stride[axis];
    --steps_left[axis];
  }
}

const OccupancyGrid::Cell* OccupancyGrid::find(const Eigen::Vector2i& cell) const {
  return cells_.contains(cell) ? &cells_.at(cell) : nullptr;
}

namespace {

// The shades of map_saver. The shade of unknown cells lies between the two thresholds below.
constexpr char kFreeShade = static_cast<char>(254);
constexpr char kUnknownShade = static_cast<char>(205);
constexpr char kOccupiedShade = 0;

char shade(CellState state) {
  switch (state) {
    case CellState::kFree:
      return kFreeShade;
    case CellState::kOccupied:
      return kOccupiedShade;
    case CellState::kUnknown:
      break;
  }
  return kUnknownShade;
}

std::string pgm(const OccupancyGrid& grid, const CellBox& box) {
  std::string text = fmt::format("P5\n{} {}\n255\n", box.size().x(), box.size().y());
  for (int j = box.to.y() - 1; j >= box.from.y(); --j) {
    for (int i = box.from.x(); i < box.to.x(); ++i) text += shade(grid.state({i, j}));
  }
  return text;
}

std::string yaml(const OccupancyGrid& grid, const CellBox& box, const std::string& image) {
  const Eigen::Vector2d origin = grid.resolution_m() * box.from.cast<double>();
  return fmt::format(
      "image: {}\nmode: trinary\nresolution: {:.6f}\norigin: [{:.6f}, {:.6f}, 0.0]\n"
      "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
      image, grid.resolution_m(), origin.x(), origin.y());
}

}  // namespace

void write_map_server(const OccupancyGrid& grid, const std::filesystem::path& folder,
                      const std::string& stem) {
  CellBox box = grid.observed_box();
  box.from -= Eigen::Vector2i(1, 1);
  box.to += Eigen::Vector2i(1, 1);
  write_text_file(pgm(grid, box), folder / (stem + ".pgm"));
  write_text_file(yaml(grid, box, stem + ".pgm"), folder / (stem + ".yaml"));
}

}  // namespace adit
