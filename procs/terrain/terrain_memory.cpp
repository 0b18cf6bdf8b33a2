// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/terrain_memory.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "procs/terrain/changed_ground.hpp"
#include "procs/terrain/driven_ground.hpp"
#include "procs/terrain/narrow_gaps.hpp"

namespace adit {
namespace {

constexpr float kLowerM = 0.1F;  // than it seems now, at which ground was seen before

void take(TerrainCell& cell, const RememberedCell& before) {
  cell.ground = before.ground;
  cell.count = before.count;
  cell.low_m = before.low_m;
  cell.high_m = before.high_m;
  cell.clearance_m = std::min(cell.clearance_m, before.roof_m);
}

/// Whether the cell is now what an earlier look said of it.
bool fill(TerrainCell& cell, const RememberedCell& before, bool changed, float obstacle_m) {
  const bool stood = stands_out(before, obstacle_m);
  switch (cell.ground) {
    case Ground::kNeverSeen:
    case Ground::kShadow:
      if (changed || !before.says()) return false;
      take(cell, before);
      return true;
    case Ground::kBelowRay:
    case Ground::kNoReturn:
      // That nothing came back may be because the ground is gone, or under water: it stays unknown.
      if (!stood) return false;
      take(cell, before);
      return true;
    case Ground::kSeen:
      break;
  }
  if (cell.count == 0 && stood) {  // between beams that met the ground, and passed beside it
    take(cell, before);
    return true;
  }
  if (before.ground == Ground::kSeen && before.count > 0 && cell.low_m > before.low_m + kLowerM) {
    cell.low_m = before.low_m;  // the ground itself is not seen this time, only what stands on it
  }
  if (std::isinf(cell.clearance_m) && before.ground == Ground::kSeen) {
    cell.clearance_m =
        cell.low_m + (before.roof_m - before.low_m);  // the clearance, not the height
  }
  return false;
}

}  // namespace

TerrainMemory::TerrainMemory(const TerrainParams& params)
    : params_(params), way_(params.memory.way_max_m, params.vehicle.speed_max_m_s) {}

void TerrainMemory::add(std::int64_t utime, const Pose2& T_odom_body) {
  if (!way_.add(utime, T_odom_body)) before_ = std::exchange(maps_, {});
}

void TerrainMemory::begin_anew(std::int64_t odom_utime) {
  if (way_.begin_anew(odom_utime)) before_ = std::exchange(maps_, {});
}

void TerrainMemory::tie(const Pose2& T_odom_before) {
  way_.tie(T_odom_before);
  for (RememberedMap& map : before_) {
    map.tie(T_odom_before);
    maps_.push_back(std::move(map));
  }
  before_.clear();
}

/// What an earlier look says where no later one has said anything. A later one that saw ground only
/// between its beams does not take away what stood there.
void TerrainMemory::gather(const TerrainMap& map, const RememberedMap& before,
                           const HeightPlane& plane, std::uint8_t which) {
  const float obstacle_m = obstacle_height_m(params_.vehicle);
  const Pose2 T_before_now = between(before.T_odom_level(), map.T_odom_level);
  const auto cell_m = static_cast<float>(map.cell_m);
  const Eigen::Vector2f step_column(cell_m * static_cast<float>(std::cos(T_before_now.theta)),
                                    cell_m * static_cast<float>(std::sin(T_before_now.theta)));
  for (int row = 0; row < map.rows; ++row) {
    const Eigen::Vector2f first = (T_before_now * map.centre(0, row)).cast<float>();
    std::size_t i = static_cast<std::size_t>(row) * static_cast<std::size_t>(map.columns);
    for (int column = 0; column < map.columns; ++column, ++i) {
      RememberedCell& cell = recalled_[i];
      if (cell.says() && (cell.barred || cell.count > 0)) continue;
      const Eigen::Vector2f p = first + static_cast<float>(column) * step_column;
      const RememberedCell* said = before.at(p.x(), p.y());
      if (said == nullptr || !said->says()) continue;
      if (cell.says() && !stands_out(*said, obstacle_m)) continue;
      cell = *said;
      const float dz = plane.at(map.centre(column, row).cast<float>());
      cell.low_m += dz;
      cell.high_m += dz;
      cell.roof_m += dz;
      from_[i] = which;
    }
  }
}

const Recollection& TerrainMemory::recall(TerrainMap& map) {
  recollection_ = {};
  recollection_.from.assign(map.cells.size(), Recollection::kOwn);
  changed_.assign(map.cells.size(), 0);
  if (params_.memory.maps_max == 0) return recollection_;
  add(map.utime, map.T_odom_level);
  RememberedMap alone(map, way_.way_m());
  gather_all(map);
  merge(map, alone);
  DrivenGround(map, way_.places(), params_.vehicle).roll(map, changed_, until_m_);
  close_narrow_gaps(map, changed_, obstacle_height_m(params_.vehicle));
  maps_.push_front(std::move(alone));
  while (maps_.size() > static_cast<std::size_t>(params_.memory.maps_max)) maps_.pop_back();
  return recollection_;
}

void TerrainMemory::gather_all(const TerrainMap& map) {
  while (!maps_.empty() && maps_.back().way_m() < way_.way_m() - params_.memory.way_max_m) {
    maps_.pop_back();
  }
  from_.assign(map.cells.size(), Recollection::kOwn);
  recalled_.assign(map.cells.size(), {});
  std::uint8_t which = 0;
  for (const RememberedMap& before : maps_) {
    ++which;
    const auto plane = agreement(map, before, params_);
    ++(plane ? recollection_.used : recollection_.refused);
    if (plane) gather(map, before, *plane, which);
  }
}

void TerrainMemory::merge(TerrainMap& map, RememberedMap& alone) {
  const float obstacle_m = obstacle_height_m(params_.vehicle);
  until_m_.assign(map.cells.size(), static_cast<float>(way_.way_m()));
  changed_ = changed_ground(map, recalled_, params_);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    TerrainCell& cell = map.cells[i];
    const bool unknown = is_unknown(cell);
    if (unknown && recalled_[i].barred) changed_[i] = 1;
    if (unknown && changed_[i] != 0) {
      alone.cell(i).barred = true;
      ++recollection_.changed;
    }
    if (fill(cell, recalled_[i], changed_[i] != 0, obstacle_m)) {
      recollection_.from[i] = from_[i];
      until_m_[i] = static_cast<float>(maps_[from_[i] - 1U].way_m());
    }
  }
}

}  // namespace adit
