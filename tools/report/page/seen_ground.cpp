// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/page/seen_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace adit {
namespace {

constexpr double kBesidePathM = 3.0;  // half of the width of a wide tunnel: ground that was driven
constexpr double kStartM = kBesidePathM + 1.0;  // from the pose to ground that was not driven
constexpr double kPathStepM = 0.5;
constexpr std::array<std::pair<int, int>, 4> kNeighbours{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

/// The cells of a grid, with a mark each.
class Marks {
 public:
  explicit Marks(const OccupancyGrid& grid) : grid_(grid), box_(grid.observed_box()) {
    const Eigen::Vector2i size = box_.size();
    marks_.assign(static_cast<std::size_t>(size.x()) * static_cast<std::size_t>(size.y()), 0);
  }

  [[nodiscard]] bool contains(const Eigen::Vector2i& cell) const {
    return (cell.array() >= box_.from.array()).all() && (cell.array() < box_.to.array()).all();
  }
  std::uint8_t& at(const Eigen::Vector2i& cell) {
    const Eigen::Vector2i offset = cell - box_.from;
    return marks_[static_cast<std::size_t>(offset.y()) * static_cast<std::size_t>(box_.size().x()) +
                  static_cast<std::size_t>(offset.x())];
  }
  void mark_disc(const Eigen::Vector2i& centre, double radius_m) {
    const double radius = radius_m / grid_.resolution_m();
    const int reach = static_cast<int>(radius);
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const Eigen::Vector2i cell = centre + Eigen::Vector2i(dx, dy);
        if (std::hypot(dx, dy) <= radius && contains(cell)) at(cell) = 1;
      }
    }
  }

 private:
  const OccupancyGrid& grid_;
  CellBox box_;
  std::vector<std::uint8_t> marks_;
};

void mark_driven(const OccupancyGrid& grid, const Trajectory& path, Marks& marks) {
  Eigen::Vector2d last = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  for (const TimedPose& pose : path) {
    const Eigen::Vector2d p_map = pose.pose.translation();
    if ((p_map - last).norm() < kPathStepM) continue;
    last = p_map;
    marks.mark_disc(grid.cell_at(p_map), kBesidePathM);
  }
}

}  // namespace

double seen_beyond_m(const OccupancyGrid& grid, const Trajectory& path,
                     const Eigen::Vector2d& p_map) {
  Marks driven(grid);
  const Eigen::Vector2i start = grid.cell_at(p_map);
  if (!driven.contains(start)) return 0.0;
  mark_driven(grid, path, driven);
  Marks visited(grid);
  std::vector<Eigen::Vector2i> cells{start};
  visited.at(start) = 1;
  double farthest_m = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Eigen::Vector2i cell = cells[i];
    farthest_m = std::max(farthest_m, (cell - start).cast<double>().norm() * grid.resolution_m());
    for (const auto& [dx, dy] : kNeighbours) {
      const Eigen::Vector2i next = cell + Eigen::Vector2i(dx, dy);
      if (!driven.contains(next) || visited.at(next) != 0) continue;
      const double distance_m = (next - start).cast<double>().norm() * grid.resolution_m();
      if (driven.at(next) != 0 && distance_m > kStartM) continue;
      if (grid.state(next) != CellState::kFree) continue;
      visited.at(next) = 1;
      cells.push_back(next);
    }
  }
  return farthest_m;
}

}  // namespace adit
