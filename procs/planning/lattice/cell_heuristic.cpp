// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/lattice/cell_heuristic.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <queue>
#include <utility>

namespace adit {
namespace {

/// The minimum cost of each cell over all headings.
std::vector<std::uint16_t> min_costs(const CSpace& space) {
  std::vector<std::uint16_t> costs(space.cells(), CSpace::kLethal);
  for (int k = 0; k < space.headings() / 2; ++k) {
    const Grid2<std::uint16_t>& slice = space.slice(k);
    for (std::size_t i = 0; i < costs.size(); ++i) {
      costs[i] = std::min(costs[i], CSpace::unmarked(slice[i]));
    }
  }
  return costs;
}

}  // namespace

std::vector<std::int32_t> cell_heuristic(const Lattice& lattice, const GoalArray& goals,
                                         double cell_m) {
  using Entry = std::pair<std::int32_t, std::int32_t>;  // cost, cell
  const CSpace& space = lattice.space;
  const auto cell_costs = min_costs(space);
  const double step_mm = 1000.0 * cell_m * lattice.primitives.length_ratio_min();
  const auto straight_mm = static_cast<std::int32_t>(std::floor(step_mm));
  const auto diagonal_mm = static_cast<std::int32_t>(std::floor(step_mm * std::numbers::sqrt2));

  std::vector<std::int32_t> costs(space.cells(), kUnreachable);
  std::vector<Entry> ends;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    if (cell_costs[i] >= lattice.cost_limit || goals.ending_cost(i) == GoalArray::kNoGoal) continue;
    costs[i] = goals.ending_cost(i);
    ends.emplace_back(costs[i], static_cast<std::int32_t>(i));
  }
  std::priority_queue open(std::greater<>{}, std::move(ends));
  while (!open.empty()) {
    const auto [cost, cell] = open.top();
    open.pop();
    const auto here = static_cast<std::size_t>(cell);
    if (cost > costs[here]) continue;
    const int column = cell % space.columns();
    const int row = cell / space.columns();
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (!space.contains(column + dx, row + dy)) continue;
        const std::size_t i = space.index(column + dx, row + dy);
        if (cell_costs[i] >= lattice.cost_limit) continue;
        const std::int32_t step = dx != 0 && dy != 0 ? diagonal_mm : straight_mm;
        const std::int32_t through =
            cost + step * cell_costs[here];  // the cost of the cell entered
        if (through >= costs[i]) continue;
        costs[i] = through;
        open.emplace(through, static_cast<std::int32_t>(i));
      }
    }
  }
  return costs;
}

}  // namespace adit
