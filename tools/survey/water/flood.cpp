// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/water/flood.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

namespace adit {
namespace {

const std::array<Eigen::Vector2i, 8> kNeighbours{Eigen::Vector2i(1, 0),  Eigen::Vector2i(1, 1),
                                                 Eigen::Vector2i(0, 1),  Eigen::Vector2i(-1, 1),
                                                 Eigen::Vector2i(-1, 0), Eigen::Vector2i(-1, -1),
                                                 Eigen::Vector2i(0, -1), Eigen::Vector2i(1, -1)};

/// A cell that water reaches next: the lowest first, ties by place in the storage.
using Reached = std::pair<float, std::size_t>;
using LowestFirst = std::priority_queue<Reached, std::vector<Reached>, std::greater<>>;

bool is_floor(const FloodGround& ground, const Eigen::Vector2i& cell) {
  return ground.floor_m.contains(cell) && std::isfinite(ground.floor_m.at(cell));
}

template <class Visit>
void for_each_beside(const FloodGround& ground, std::size_t index, Visit visit) {
  for (const Eigen::Vector2i& step : kNeighbours) {
    const Eigen::Vector2i next = ground.floor_m.cell(index) + step;
    if (is_floor(ground, next)) visit(ground.floor_m.index(next));
  }
}

/// Cells connected to a seed for which `belongs` holds; marks them.
template <class Belongs>
std::vector<std::size_t> connected(const FloodGround& ground, std::size_t seed,
                                   Grid2<std::uint8_t>& seen, Belongs belongs) {
  std::vector<std::size_t> cells{seed};
  seen[seed] = 1;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for_each_beside(ground, cells[i], [&](std::size_t next) {
      if (seen[next] != 0 || !belongs(next)) return;
      seen[next] = 1;
      cells.push_back(next);
    });
  }
  return cells;
}

WaterBody body_of(const FloodGround& ground, const std::vector<std::size_t>& cells,
                  double level_m) {
  WaterBody body;
  body.level_m = level_m;
  const double cell_m2 = ground.cell_m * ground.cell_m;
  for (const std::size_t cell : cells) {
    const double depth_m = level_m - static_cast<double>(ground.floor_m[cell]);
    body.area_m2 += cell_m2;
    body.volume_m3 += cell_m2 * depth_m;
    if (depth_m > body.depth_m) {
      body.depth_m = depth_m;
      body.deepest = centre_of(ground.floor_m.cell(cell), ground.cell_m);
    }
    body.reaches_unseen = body.reaches_unseen || ground.outlets[cell] != 0;
    body.cells.push_back(ground.floor_m.cell(cell));
  }
  return body;
}

/// Where rising water leaves connected cells: it takes the lowest cell of its shore at each step,
/// until it finds one below its level, or an outlet.
std::optional<Spill> spill_of(const FloodGround& ground, const std::vector<std::size_t>& cells,
                              double level_m) {
  Grid2<std::uint8_t> wet(ground.floor_m.box());
  LowestFirst shore;
  const auto flood = [&](std::size_t cell) {
    for_each_beside(ground, cell, [&](std::size_t next) {
      if (wet[next] != 0) return;
      wet[next] = 1;
      shore.emplace(ground.floor_m[next], next);
    });
  };
  for (const std::size_t cell : cells) wet[cell] = 1;
  for (const std::size_t cell : cells) {
    if (ground.outlets[cell] != 0)
      return Spill{level_m, centre_of(ground.floor_m.cell(cell), ground.cell_m), true};
  }
  for (const std::size_t cell : cells) flood(cell);
  Spill spill{level_m, {0.0, 0.0}, false};
  while (!shore.empty()) {
    const auto [height, cell] = shore.top();
    shore.pop();
    const auto height_m = static_cast<double>(height);
    if (height_m < spill.level_m) return spill;
    spill.level_m = height_m;
    spill.place = centre_of(ground.floor_m.cell(cell), ground.cell_m);
    spill.out_of_sight = ground.outlets[cell] != 0;
    if (spill.out_of_sight) return spill;
    flood(cell);
  }
  return std::nullopt;
}

void sort_by_volume(std::vector<WaterBody>& bodies) {
  std::ranges::stable_sort(bodies, std::ranges::greater{}, &WaterBody::volume_m3);
}

/// The level to which each cell fills: its own height, or that of the lowest path to an outlet.
/// Infinite where none is reached.
Grid2<float> filled_levels(const FloodGround& ground) {
  Grid2<float> level(ground.floor_m.box(), std::numeric_limits<float>::infinity());
  LowestFirst open;
  for (std::size_t i = 0; i < ground.outlets.size(); ++i) {
    if (ground.outlets[i] == 0 || !std::isfinite(ground.floor_m[i])) continue;
    level[i] = ground.floor_m[i];
    open.emplace(level[i], i);
  }
  while (!open.empty()) {
    const std::size_t cell = open.top().second;
    open.pop();
    for_each_beside(ground, cell, [&](std::size_t next) {
      if (std::isfinite(level[next])) return;
      level[next] = std::max(ground.floor_m[next], level[cell]);
      open.emplace(level[next], next);
    });
  }
  return level;
}

}  // namespace

std::vector<WaterBody> flooded_at(const FloodGround& ground, double level_m, double area_min_m2) {
  const auto is_wet = [&](std::size_t cell) {
    return static_cast<double>(ground.floor_m[cell]) < level_m;  // false for NaN
  };
  Grid2<std::uint8_t> seen(ground.floor_m.box());
  std::vector<WaterBody> bodies;
  for (std::size_t i = 0; i < ground.floor_m.size(); ++i) {
    if (seen[i] != 0 || !is_wet(i)) continue;
    const std::vector<std::size_t> cells = connected(ground, i, seen, is_wet);
    WaterBody body = body_of(ground, cells, level_m);
    if (body.area_m2 < area_min_m2) continue;
    body.spill = spill_of(ground, cells, level_m);
    bodies.push_back(std::move(body));
  }
  sort_by_volume(bodies);
  return bodies;
}

std::vector<WaterBody> hollows(const FloodGround& ground, const HollowParams& params) {
  const Grid2<float> level = filled_levels(ground);
  const auto is_wet = [&](std::size_t cell) {
    return std::isfinite(level[cell]) && level[cell] > ground.floor_m[cell];
  };
  Grid2<std::uint8_t> seen(ground.floor_m.box());
  std::vector<WaterBody> bodies;
  for (std::size_t i = 0; i < ground.floor_m.size(); ++i) {
    if (seen[i] != 0 || !is_wet(i)) continue;
    const auto cells = connected(ground, i, seen, [&](std::size_t cell) {
      return is_wet(cell) && level[cell] == level[i];  // one body has one level
    });
    WaterBody body = body_of(ground, cells, static_cast<double>(level[i]));
    if (body.depth_m < params.depth_min_m || body.area_m2 < params.area_min_m2) continue;
    body.spill = spill_of(ground, cells, body.level_m);
    bodies.push_back(std::move(body));
  }
  sort_by_volume(bodies);
  return bodies;
}

}  // namespace adit
