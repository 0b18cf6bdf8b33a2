// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/page/seen_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace adit {
namespace {

constexpr double kBesidePathM = 3.0;  // half of the width of a wide tunnel: ground that was driven
constexpr double kStartM = kBesidePathM + 1.0;  // from the pose to ground that was not driven
constexpr double kPathStepM = 0.5;
constexpr std::array<std::pair<int, int>, 4> kNeighbours{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

}  // namespace

SeenGround::SeenGround(const OccupancyGrid& grid, const Trajectory& path)
    : grid_(grid), driven_(grid.observed_box()) {
  Eigen::Vector2d last = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  for (const TimedPose& pose : path) {
    const Eigen::Vector2d p_map = pose.pose.translation();
    if ((p_map - last).norm() < kPathStepM) continue;
    last = p_map;
    mark_driven(grid.cell_at(p_map));
  }
}

void SeenGround::mark_driven(const Eigen::Vector2i& centre) {
  const double radius = kBesidePathM / grid_.resolution_m();
  const int reach = static_cast<int>(radius);
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const Eigen::Vector2i cell = centre + Eigen::Vector2i(dx, dy);
      if (std::hypot(dx, dy) <= radius && driven_.contains(cell)) driven_.at(cell) = 1;
    }
  }
}

double SeenGround::beyond_m(const Eigen::Vector2d& p_map) const {
  const Eigen::Vector2i start = grid_.cell_at(p_map);
  if (!driven_.contains(start)) return 0.0;
  Grid2<std::uint8_t> visited(driven_.box());
  std::vector<Eigen::Vector2i> cells{start};
  visited.at(start) = 1;
  double farthest_m = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Eigen::Vector2i cell = cells[i];
    farthest_m = std::max(farthest_m, (cell - start).cast<double>().norm() * grid_.resolution_m());
    for (const auto& [dx, dy] : kNeighbours) {
      const Eigen::Vector2i next = cell + Eigen::Vector2i(dx, dy);
      if (!driven_.contains(next) || visited.at(next) != 0) continue;
      const double distance_m = (next - start).cast<double>().norm() * grid_.resolution_m();
      if (driven_.at(next) != 0 && distance_m > kStartM) continue;
      if (grid_.state(next) != CellState::kFree) continue;
      visited.at(next) = 1;
      cells.push_back(next);
    }
  }
  return farthest_m;
}

}  // namespace adit
