// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/memory/terrain_memory.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "procs/terrain/memory/driven_ground.hpp"
#include "procs/terrain/memory/remembered_map.hpp"
#include "procs/terrain/terrain_params.hpp"

namespace adit {
namespace {

/// Cells of even ground required around a new obstacle: walls are rough, at long range only few
/// points show the ground before them, and odom is inaccurate by centimetres.
constexpr int kSlack = 3;

template <class Visit>
void visit_around(const TerrainMap& map, int column, int row, int reach, const Visit& visit) {
  for (int r = row - reach; r <= row + reach; ++r) {
    for (int c = column - reach; c <= column + reach; ++c) {
      if (!map.cells.contains({c, r})) continue;
      visit(c, r, map.cells.index({c, r}));
    }
  }
}

/// Whether earlier scans observed ground without obstacles here and all around.
bool was_even(const TerrainMap& now, const std::vector<RememberedCell>& recalled, int column,
              int row, float obstacle_m) {
  bool even = true;
  visit_around(now, column, row, kSlack, [&](int, int, std::size_t i) {
    even = even && recalled[i].ground == Ground::kObserved && !is_obstacle(recalled[i], obstacle_m);
  });
  return even;
}

/// Marks by 1 the cells for which earlier scans no longer count: unobserved cells around obstacles
/// where earlier scans observed even ground. Of a fallen rock only one side is observed, and the
/// occluded part may belong to it. `recalled`: the cells of the map in earlier scans.
std::vector<std::uint8_t> changed_ground(const TerrainMap& now,
                                         const std::vector<RememberedCell>& recalled,
                                         const TerrainParams& params) {
  const float obstacle_m = obstacle_height_m(params.vehicle);
  const auto reach = static_cast<int>(std::lround(params.memory.change_reach_m / now.cell_m));
  std::vector<std::uint8_t> changed(now.cells.size(), 0);
  std::vector<std::pair<int, int>> front;
  for (int row = 0; row < now.cells.rows(); ++row) {
    for (int column = 0; column < now.cells.columns(); ++column) {
      if (!is_obstacle(now.cells.at({column, row}), obstacle_m)) continue;
      if (was_even(now, recalled, column, row, obstacle_m)) front.emplace_back(column, row);
    }
  }
  for (int ring = 0; ring < reach && !front.empty(); ++ring) {
    std::vector<std::pair<int, int>> next;
    for (const auto& [column, row] : front) {
      visit_around(now, column, row, 1, [&](int c, int r, std::size_t i) {
        if (changed[i] != 0 || now.cells[i].ground == Ground::kObserved) return;
        changed[i] = 1;
        next.emplace_back(c, r);
      });
    }
    front.swap(next);
  }
  return changed;
}

constexpr float kLowerM =
    0.1F;  // below the current height, from which an earlier ground height counts

void replace(TerrainCell& cell, const RememberedCell& before) {
  cell.ground = before.ground;
  cell.count = before.count;
  cell.low_m = before.low_m;
  cell.high_m = before.high_m;
  const bool is_hidden = std::isinf(cell.clearance_m) && std::isnan(before.roof_m);
  cell.clearance_m = is_hidden ? before.roof_m : std::min(cell.clearance_m, before.roof_m);
  cell.obstacle_parts = before.obstacle_parts;
}

/// The parts of a cell of the map in which an earlier scan observed an obstacle.
std::uint16_t obstacle_parts(const TerrainMap& map, const Eigen::Vector2i& at,
                             const RememberedMap& before, const Pose2& T_before_now) {
  const Eigen::Vector2d p_corner = map.p_level_corner + map.cell_m * at.cast<double>();
  std::uint16_t parts = 0;
  for (int part = 0; part < CellParts::kCount; ++part) {
    const Eigen::Vector2d p = p_corner + map.cell_m * CellParts::centre(part);
    if (before.has_obstacle_at(T_before_now * p)) parts |= static_cast<std::uint16_t>(1U << part);
  }
  return parts;
}

/// Whether the lowest that the new scan observed in a cell lies higher than this above ground that
/// an earlier one observed.
bool lies_above_ground(const TerrainCell& cell, const RememberedCell& before, float higher_m) {
  return before.ground == Ground::kObserved && before.count > 0 &&
         cell.low_m > before.low_m + higher_m;
}

/// Merges a recalled cell into a cell of the map. Returns whether the cell was replaced.
bool fill(TerrainCell& cell, const RememberedCell& before, bool changed,
          const TerrainParams& params) {
  const float obstacle_m = obstacle_height_m(params.vehicle);
  const bool was_obstacle = is_obstacle(before, obstacle_m);
  switch (cell.ground) {
    case Ground::kNeverObserved:
    case Ground::kOccluded:
      if (changed || !before.is_informative()) return false;
      replace(cell, before);
      return true;
    case Ground::kBelowRay:
    case Ground::kNoReturn:
      // A missing return may mean that the ground is gone or under water: the cell stays unknown.
      if (!was_obstacle) return false;
      replace(cell, before);
      return true;
    case Ground::kObserved:
      break;
  }
  if (cell.count == 0 &&
      was_obstacle) {  // interpolated between beams that passed beside the obstacle
    replace(cell, before);
    return true;
  }
  if (lies_above_ground(cell, before, static_cast<float>(params.headroom_m()))) {
    // Too high for an obstacle: behind a crest only the roof is visible.
    cell.clearance_m = std::min(cell.clearance_m, cell.low_m);  // here the height of the roof
    replace(cell, before);
    return true;
  }
  if (lies_above_ground(cell, before, kLowerM)) {
    cell.low_m = before.low_m;  // the new scan observed only an obstacle, not the ground below
  }
  if (!std::isfinite(cell.clearance_m) && before.ground == Ground::kObserved &&
      !std::isnan(before.roof_m)) {
    cell.clearance_m =
        cell.low_m +
        (before.roof_m - before.low_m);  // keeps the clearance, not the height of the roof
  }
  return false;
}

}  // namespace

TerrainMemory::TerrainMemory(const TerrainParams& params)
    : params_(params),
      path_({params.memory.distance_max_m, params.memory.path_length_max_m,
             params.vehicle.speed_max_m_s}) {}

void TerrainMemory::add(std::int64_t utime, const Pose2& T_odom_body) {
  if (!path_.add(utime, T_odom_body)) previous_ = std::exchange(maps_, {});
}

void TerrainMemory::reset(std::int64_t odom_epoch_utime) {
  if (path_.reset(odom_epoch_utime)) previous_ = std::exchange(maps_, {});
}

void TerrainMemory::anchor(const Pose2& T_odom_previous) {
  path_.anchor(T_odom_previous);
  for (RememberedMap& map : previous_) {
    map.anchor(T_odom_previous);
    maps_.push_back(std::move(map));
  }
  previous_.clear();
}

void TerrainMemory::correct(const Pose2& T_after_before, double position_variance) {
  path_.correct(T_after_before, position_variance);
  for (RememberedMap& map : maps_) {
    if (path_.keeps_place_in_map(map.distance_travelled_m())) map.anchor(T_after_before);
  }
}

/// Recalls the cells of an earlier scan for which later ones have no information. Later ground that
/// is only interpolated between beams does not remove an earlier obstacle.
void TerrainMemory::gather(const TerrainMap& map, const RememberedMap& before,
                           const HeightPlane& plane, std::uint16_t which) {
  const float obstacle_m = obstacle_height_m(params_.vehicle);
  const Pose2 T_before_now = between(before.T_odom_level(), map.T_odom_level);
  const auto cell_m = static_cast<float>(map.cell_m);
  const Eigen::Vector2f step_column(cell_m * static_cast<float>(std::cos(T_before_now.theta)),
                                    cell_m * static_cast<float>(std::sin(T_before_now.theta)));
  for (int row = 0; row < map.cells.rows(); ++row) {
    const Eigen::Vector2f first = (T_before_now * map.centre(0, row)).cast<float>();
    std::size_t i = map.cells.index({0, row});
    for (int column = 0; column < map.cells.columns(); ++column, ++i) {
      RememberedCell& cell = recalled_[i];
      if (cell.is_informative() && (cell.invalidated || cell.count > 0)) continue;
      const Eigen::Vector2f p = first + static_cast<float>(column) * step_column;
      const RememberedCell* stored_cell = before.at(p.x(), p.y());
      if (stored_cell == nullptr || !stored_cell->is_informative()) continue;
      if (cell.is_informative() && !is_obstacle(*stored_cell, obstacle_m)) continue;
      cell = *stored_cell;
      if (is_obstacle(cell, obstacle_m))
        cell.obstacle_parts = obstacle_parts(map, {column, row}, before, T_before_now);
      const float dz = plane.at(map.centre(column, row).cast<float>());
      cell.low_m += dz;
      cell.high_m += dz;
      cell.roof_m += dz;
      from_[i] = which;
    }
  }
}

const RecallResult& TerrainMemory::recall(TerrainMap& map) {
  recall_result_ = {};
  recall_result_.from.assign(map.cells.size(), RecallResult::kCurrent);
  changed_.assign(map.cells.size(), 0);
  if (params_.memory.maps_max == 0) return recall_result_;
  add(map.utime, map.T_odom_level);
  RememberedMap single_scan(map, path_.distance_travelled_m());
  const std::vector<DrivenPath::Place> same_level = path_.same_level();
  gather_all(map, same_level);
  merge(map, single_scan);
  DrivenGround(map, same_level, params_.vehicle).fill_driven(map, changed_, observed_at_m_);
  close_narrow_gaps(map, changed_, obstacle_height_m(params_.vehicle));
  single_scan.crop();
  maps_.push_front(std::move(single_scan));
  while (maps_.size() > static_cast<std::size_t>(params_.memory.maps_max)) maps_.pop_back();
  return recall_result_;
}

void TerrainMemory::gather_all(const TerrainMap& map,
                               const std::vector<DrivenPath::Place>& same_level) {
  while (!maps_.empty() && path_.has_expired(maps_.back().distance_travelled_m())) maps_.pop_back();
  from_.assign(map.cells.size(), RecallResult::kCurrent);
  recalled_.assign(map.cells.size(), {});
  std::uint16_t which = 0;
  for (const RememberedMap& before : maps_) {
    ++which;
    if (!std::ranges::binary_search(same_level, before.distance_travelled_m(), {},
                                    &DrivenPath::Place::distance_travelled_m)) {
      continue;
    }
    const auto plane = align_heights(map, before, params_);
    ++(plane ? recall_result_.used : recall_result_.rejected);
    if (plane) gather(map, before, *plane, which);
  }
}

void TerrainMemory::merge(TerrainMap& map, RememberedMap& single_scan) {
  observed_at_m_.assign(map.cells.size(), static_cast<float>(path_.distance_travelled_m()));
  changed_ = changed_ground(map, recalled_, params_);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    TerrainCell& cell = map.cells[i];
    const bool unknown = is_unknown(cell);
    if (unknown && recalled_[i].invalidated) changed_[i] = 1;
    if (unknown && changed_[i] != 0) {
      single_scan.cell(i).invalidated = true;
      ++recall_result_.changed;
    }
    if (fill(cell, recalled_[i], changed_[i] != 0, params_)) {
      recall_result_.from[i] = from_[i];
      observed_at_m_[i] = static_cast<float>(maps_[from_[i] - 1U].distance_travelled_m());
    }
  }
}

}  // namespace adit
