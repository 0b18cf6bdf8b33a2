// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/map/shortest_path_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace adit {
namespace {

constexpr float kUnreached = std::numeric_limits<float>::infinity();
constexpr std::array<int, 8> kStepCost{10, 14, 10, 14, 10, 14, 10, 14};
constexpr double kNearWallM =
    0.3;  // clearance beyond the radius of the vehicle up to which a cell is near a wall
// Cost factors of a step by the class of its cell; driven cells are known to be passable.
constexpr int kDrivenCost = 4;
constexpr int kClearCost = 5;
constexpr int kNearWallCost = 9;
constexpr int kNotDriven = 2;  // further factor of cells not driven, for PathPreference::kDriven
// A rail has a metre of such cells: to plan over it in vain takes the time of 20 m of driving.
constexpr int kObstructedCost = 100;
constexpr std::size_t kBuckets = 2048;
static_assert(kBuckets > 14 * std::max(kObstructedCost, kNearWallCost* kNotDriven),
              "the most expensive step must fit");
constexpr int kSamePlace = 8;  // the first value of a step beyond the directions
constexpr int kSnapCells = 5;  // from a point to the nearest cell that qualifies

/// The cell nearest to `middle` that qualifies, within kSnapCells.
template <class Qualifies>
std::optional<std::size_t> nearest(const Grid2<float>& field, const Eigen::Vector2i& middle,
                                   const Qualifies& qualifies) {
  std::optional<std::size_t> best;
  int best_square = std::numeric_limits<int>::max();
  for (int y = -kSnapCells; y <= kSnapCells; ++y) {
    for (int x = -kSnapCells; x <= kSnapCells; ++x) {
      const Eigen::Vector2i cell = middle + Eigen::Vector2i(x, y);
      const int square = x * x + y * y;
      if (square >= best_square || !field.box().contains(cell) || !qualifies(field.index(cell)))
        continue;
      best = field.index(cell);
      best_square = square;
    }
  }
  return best;
}

int cost_factor(const DrivableSpace& space, std::size_t cell, int not_driven) {
  if (space.known[cell] == Occupancy::kDriven) return kDrivenCost;
  if (space.obstructed[cell] != 0) return kObstructedCost;
  const auto near_wall_m = static_cast<float>(space.radius_m + kNearWallM);
  return not_driven * (space.clearance_m[cell] < near_wall_m ? kNearWallCost : kClearCost);
}

}  // namespace

ShortestPathTree::ShortestPathTree(const DrivableSpace& space, const Eigen::Vector2d& p_map_from,
                                   PathPreference preference,
                                   const std::vector<Eigen::Vector2d>& targets)
    : resolution_m_(space.resolution_m),
      length_m_(space.known.box(), kUnreached),
      back_(space.known.box(), kNoStep),
      shared_(space.shared) {
  const auto from = nearest(length_m_, space.cell_at(p_map_from),
                            [&](std::size_t i) { return space.access[i] == Access::kReachable; });
  if (from) search(space, *from, preference, targets);
}

/// Dijkstra with a bucket queue (Dial 1969), as costs are small integers.
void ShortestPathTree::search(const DrivableSpace& space, std::size_t from,
                              PathPreference preference,
                              const std::vector<Eigen::Vector2d>& targets) {
  Grid2<int> cost(space.known.box(), std::numeric_limits<int>::max());
  std::array<std::vector<std::size_t>, kBuckets> buckets;
  const auto around = cost.around();
  const auto straight_m = static_cast<float>(space.resolution_m);
  const std::array<float, 2> step_m{straight_m, straight_m * std::sqrt(2.0F)};
  const int not_driven = preference == PathPreference::kDriven ? kNotDriven : 1;
  cost[from] = 0;
  length_m_[from] = 0.0F;
  buckets[0].push_back(from);
  std::vector<std::size_t> target_cells;
  for (const Eigen::Vector2d& p : targets) {
    const Eigen::Vector2i cell = space.cell_at(p);
    if (space.access.get(cell) == Access::kReachable) target_cells.push_back(cost.index(cell));
  }
  std::size_t waiting = 1;
  for (int now = 0; waiting > 0; ++now) {
    std::vector<std::size_t>& bucket = buckets[static_cast<std::size_t>(now) % kBuckets];
    for (std::size_t k = 0; k < bucket.size(); ++k) {
      const std::size_t at = bucket[k];
      --waiting;
      if (cost[at] != now) continue;
      if (!target_cells.empty() && std::erase(target_cells, at) > 0 && target_cells.empty()) return;
      for (std::size_t i = 0; i < around.size(); ++i) {
        const std::size_t next = at + static_cast<std::size_t>(around[i]);
        if (space.access[next] != Access::kReachable) continue;
        const int total = now + cost_factor(space, next, not_driven) * kStepCost[i];
        if (total >= cost[next]) continue;
        cost[next] = total;
        length_m_[next] = length_m_[at] + step_m[i % 2];
        back_[next] = static_cast<std::uint8_t>((i + 4) % 8);
        buckets[static_cast<std::size_t>(total) % kBuckets].push_back(next);
        ++waiting;
      }
      space.shared.for_each(at, [&](std::size_t next, int) {
        if (space.access[next] != Access::kReachable || now >= cost[next]) return;
        cost[next] = now;
        length_m_[next] = length_m_[at];
        back_[next] = static_cast<std::uint8_t>(kSamePlace + space.shared.layer_of(at));
        bucket.push_back(next);
        ++waiting;
      });
    }
    bucket.clear();
  }
}

std::optional<std::size_t> ShortestPathTree::reached(const Eigen::Vector2d& p_map) const {
  return nearest(length_m_, cell_of(p_map, resolution_m_),
                 [&](std::size_t i) { return length_m_[i] != kUnreached; });
}

std::optional<double> ShortestPathTree::distance_m(const Eigen::Vector2d& p_map) const {
  const auto at = reached(p_map);
  if (!at) return std::nullopt;
  return length_m_[*at];
}

std::vector<Eigen::Vector2d> ShortestPathTree::path_from(const Eigen::Vector2d& p_map) const {
  std::vector<Eigen::Vector2d> path;
  auto at = reached(p_map);
  if (!at) return path;
  const auto around = length_m_.around();
  while (true) {
    path.push_back(centre_of(length_m_.cell(*at), resolution_m_));
    const std::uint8_t back = back_[*at];
    if (back == kNoStep) return path;
    *at = back < kSamePlace ? *at + static_cast<std::size_t>(around[back])
                            : shared_.in_layer(*at, back - kSamePlace);
  }
}

}  // namespace adit
