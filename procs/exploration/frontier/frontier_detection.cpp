// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/frontier/frontier_detection.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace adit {
namespace {

struct FrontierCell {
  std::size_t cell;
  Eigen::Vector2d outward;  // towards the unseen cells around it
};

/// Sums over a neighbourhood, so that no single cell determines the direction.
Eigen::Vector2d outward(const DrivableSpace& space, std::size_t index) {
  constexpr int kReach = 3;
  const Eigen::Vector2i middle = space.known.cell(index);
  Eigen::Vector2d sum(0.0, 0.0);
  for (int y = -kReach; y <= kReach; ++y) {
    for (int x = -kReach; x <= kReach; ++x) {
      const Occupancy known = space.known.get(middle + Eigen::Vector2i(x, y), Occupancy::kUnseen);
      if (known == Occupancy::kUnseen) sum += Eigen::Vector2d(x, y);
      if (known == Occupancy::kFree || known == Occupancy::kDriven) sum -= Eigen::Vector2d(x, y);
    }
  }
  return sum;
}

/// The rim of the grid holds no drivable cell, so that all neighbours exist. Driven cells closer to
/// a wall than the vehicle are not frontiers.
bool is_frontier_cell(const DrivableSpace& space, std::size_t i) {
  const auto least = static_cast<float>(space.radius_m - 1e-6);
  if (space.access[i] == Access::kNone || space.clearance_m[i] < least) return false;
  const auto around = space.known.around();
  for (std::size_t side = 0; side < around.size(); side += 2) {
    if (space.known[i + static_cast<std::size_t>(around[side])] == Occupancy::kUnseen) return true;
  }
  return false;
}

/// Row by row from the lowest. A place of several layers is at a frontier if it is so in each of
/// them; it is found once.
std::vector<FrontierCell> find_frontier_cells(const DrivableSpace& space) {
  std::vector<FrontierCell> frontier_cells;
  for (std::size_t i = 0; i < space.known.size(); ++i) {
    if (!is_frontier_cell(space, i) || space.shared.is_repeated(i)) continue;
    bool in_all = true;
    space.shared.for_each(i,
                          [&](std::size_t same, int) { in_all &= is_frontier_cell(space, same); });
    if (in_all) frontier_cells.push_back({i, outward(space, i)});
  }
  return frontier_cells;
}

/// Connected components of frontier cells within `reach` cells of each other and of equal access.
/// `marks` holds 1 + the index of each frontier cell.
std::vector<std::vector<std::size_t>> clusters_of(const DrivableSpace& space,
                                                  const std::vector<FrontierCell>& frontier_cells,
                                                  int reach) {
  Grid2<std::uint32_t> marks(space.known.box());
  for (std::size_t k = 0; k < frontier_cells.size(); ++k) {
    marks[frontier_cells[k].cell] = static_cast<std::uint32_t>(k + 1);
  }
  std::vector<std::vector<std::size_t>> clusters;
  for (std::size_t k = 0; k < frontier_cells.size(); ++k) {
    if (marks[frontier_cells[k].cell] == 0) continue;
    marks[frontier_cells[k].cell] = 0;
    std::vector<std::size_t> cluster{k};
    for (std::size_t n = 0; n < cluster.size(); ++n) {
      const std::size_t from = frontier_cells[cluster[n]].cell;
      const Eigen::Vector2i middle = space.known.cell(from);
      for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
          const Eigen::Vector2i cell = middle + Eigen::Vector2i(x, y);
          if (!marks.box().contains(cell) || marks[marks.index(cell)] == 0) continue;
          const std::size_t other = marks[marks.index(cell)] - 1;
          if (space.access[frontier_cells[other].cell] != space.access[from]) continue;
          marks[marks.index(cell)] = 0;
          cluster.push_back(other);
        }
      }
    }
    clusters.push_back(std::move(cluster));
  }
  return clusters;
}

DetectedFrontier make_detected_frontier(const DrivableSpace& space,
                                        const std::vector<FrontierCell>& frontier_cells,
                                        const std::vector<std::size_t>& cluster) {
  DetectedFrontier detected;
  Eigen::Vector2d mean(0.0, 0.0);
  Eigen::Vector2d direction(0.0, 0.0);
  for (const std::size_t k : cluster) {
    mean += space.middle(frontier_cells[k].cell) / static_cast<double>(cluster.size());
    direction += frontier_cells[k].outward;
  }
  if (direction.norm() > 0.0) detected.direction_map = direction.normalized();
  const Eigen::Vector2d across(-detected.direction_map.y(), detected.direction_map.x());
  double nearest = std::numeric_limits<double>::infinity();
  double low = 0.0;
  double high = 0.0;
  float clearance_m = 0.0F;
  for (const std::size_t k : cluster) {
    const Eigen::Vector2d p = space.middle(frontier_cells[k].cell);
    clearance_m = std::max(clearance_m, space.clearance_m[frontier_cells[k].cell]);
    low = std::min(low, across.dot(p - mean));
    high = std::max(high, across.dot(p - mean));
    if ((p - mean).norm() >= nearest) continue;
    nearest = (p - mean).norm();
    detected.p_map = p;
  }
  // Around a corner or along a wall that is not seen the cells extend farther than the corridor is
  // wide: no farther than to the walls.
  detected.width_m = std::min(high - low + 2.0 * space.radius_m, 2.0 * double{clearance_m});
  detected.access = space.access[frontier_cells[cluster.front()].cell];
  return detected;
}

}  // namespace

std::vector<DetectedFrontier> detect_frontiers(const DrivableSpace& space,
                                               double cluster_distance_m) {
  const std::vector<FrontierCell> frontier_cells = find_frontier_cells(space);
  const int reach = std::max(1, static_cast<int>(cluster_distance_m / space.resolution_m));
  std::vector<DetectedFrontier> frontiers;
  for (const auto& cluster : clusters_of(space, frontier_cells, reach)) {
    frontiers.push_back(make_detected_frontier(space, frontier_cells, cluster));
  }
  return frontiers;
}

}  // namespace adit
