// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/seen_drops.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace adit {
namespace {

/// Cells that hang together, over which beams passed.
struct Hollow {
  std::vector<std::size_t> cells;
  float lowest_beam_m = std::numeric_limits<float>::infinity();
  std::vector<float> rim_m;  ///< heights of the ground that was seen beside it

  /// Of the rim the upper quartile: what is seen of the walls of a pit is beside it, too, but
  /// lower.
  [[nodiscard]] bool is_drop(double step_max_m) {
    if (rim_m.empty()) return true;
    const auto upper = rim_m.begin() + static_cast<std::ptrdiff_t>(rim_m.size() * 3 / 4);
    std::nth_element(rim_m.begin(), upper, rim_m.end());
    return lowest_beam_m < *upper - step_max_m;
  }
};

class Hollows {
 public:
  explicit Hollows(const TerrainMap& terrain)
      : terrain_(terrain), taken_(terrain.cells.size(), false) {}

  /// The one that a cell belongs to; empty where it was one's already, or is none.
  Hollow of(int column, int row) {
    Hollow hollow;
    visit(column, row, hollow);
    for (std::size_t k = 0; k < hollow.cells.size(); ++k) {
      const auto at = static_cast<int>(hollow.cells[k]);
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          visit(at % terrain_.columns + dx, at / terrain_.columns + dy, hollow);
        }
      }
    }
    return hollow;
  }

 private:
  void visit(int column, int row, Hollow& hollow) {
    if (!terrain_.contains(column, row)) return;
    const TerrainCell& cell = terrain_.at(column, row);
    if (cell.ground == Ground::kSeen && !hollow.cells.empty()) hollow.rim_m.push_back(cell.low_m);
    const std::size_t i =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(terrain_.columns) +
        static_cast<std::size_t>(column);
    if (cell.ground != Ground::kBelowRay || taken_[i]) return;
    taken_[i] = true;
    hollow.cells.push_back(i);
    hollow.lowest_beam_m = std::min(hollow.lowest_beam_m, cell.low_m);
  }

  const TerrainMap& terrain_;
  std::vector<bool> taken_;
};

}  // namespace

TerrainMap with_seen_drops(TerrainMap terrain, double step_max_m) {
  std::vector<std::size_t> unseen;
  Hollows hollows(terrain);
  for (int row = 0; row < terrain.rows; ++row) {
    for (int column = 0; column < terrain.columns; ++column) {
      Hollow hollow = hollows.of(column, row);
      if (hollow.is_drop(step_max_m)) continue;
      unseen.insert(unseen.end(), hollow.cells.begin(), hollow.cells.end());
    }
  }
  for (const std::size_t i : unseen) terrain.cells[i].ground = Ground::kNeverSeen;
  return terrain;
}

}  // namespace adit
