// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/changed_ground.hpp"

#include <cmath>
#include <utility>

namespace adit {
namespace {

/// Cells of even ground all round what is new: walls are rough, from afar only a few points show
/// the ground before them, and odom is off by centimetres.
constexpr int kSlack = 3;

template <class Visit>
void visit_around(const TerrainMap& map, int column, int row, int reach, const Visit& visit) {
  for (int r = row - reach; r <= row + reach; ++r) {
    for (int c = column - reach; c <= column + reach; ++c) {
      if (!map.contains(c, r)) continue;
      visit(c, r,
            static_cast<std::size_t>(r) * static_cast<std::size_t>(map.columns) +
                static_cast<std::size_t>(c));
    }
  }
}

/// Earlier looks saw the ground here, all around, and nothing on it.
bool was_even(const TerrainMap& now, const std::vector<RememberedCell>& recalled, int column,
              int row, float obstacle_m) {
  bool even = true;
  visit_around(now, column, row, kSlack, [&](int, int, std::size_t i) {
    even = even && recalled[i].ground == Ground::kSeen && !stands_out(recalled[i], obstacle_m);
  });
  return even;
}

}  // namespace

std::vector<std::uint8_t> changed_ground(const TerrainMap& now,
                                         const std::vector<RememberedCell>& recalled,
                                         const TerrainParams& params) {
  const float obstacle_m = obstacle_height_m(params.vehicle);
  const auto reach = static_cast<int>(std::lround(params.memory.change_reach_m / now.cell_m));
  std::vector<std::uint8_t> changed(now.cells.size(), 0);
  std::vector<std::pair<int, int>> front;
  for (int row = 0; row < now.rows; ++row) {
    for (int column = 0; column < now.columns; ++column) {
      if (!stands_out(now.at(column, row), obstacle_m)) continue;
      if (was_even(now, recalled, column, row, obstacle_m)) front.emplace_back(column, row);
    }
  }
  for (int ring = 0; ring < reach && !front.empty(); ++ring) {
    std::vector<std::pair<int, int>> next;
    for (const auto& [column, row] : front) {
      visit_around(now, column, row, 1, [&](int c, int r, std::size_t i) {
        if (changed[i] != 0 || now.cells[i].ground == Ground::kSeen) return;
        changed[i] = 1;
        next.emplace_back(c, r);
      });
    }
    front.swap(next);
  }
  return changed;
}

}  // namespace adit
