// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/lattice/lattice_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <queue>
#include <tuple>

#include "procs/planning/lattice/cell_heuristic.hpp"

namespace adit {
namespace {

using State =
    std::uint32_t;  // ((direction of travel · headings + heading) · rows + row) · columns …

struct Open {
  std::int32_t f;
  std::int32_t h;
  std::uint32_t rank;
  State state;

  friend bool operator>(const Open& a, const Open& b) {
    return std::tie(a.f, a.h, a.rank, a.state) > std::tie(b.f, b.h, b.rank, b.state);
  }
};

struct Arrival {
  State from;
  const MotionPrimitive* step;
};

class Search {
 public:
  Search(const Lattice& lattice, const HeadingSet& headings, const GoalField& goals,
         const std::vector<std::int32_t>& heuristic, const SearchParams& params)
      : lattice_(lattice),
        space_(lattice.space),
        goals_(goals),
        heuristic_(heuristic),
        direction_change_cost_(
            static_cast<std::int32_t>(std::lround(params.direction_change_m * kCostPerM))),
        expansions_max_(params.expansions_max),
        costs_(2 * space_.cells() * static_cast<std::size_t>(space_.headings()), kUnreachable),
        handed_(handedness()),
        arrivals_(std::make_unique_for_overwrite<Arrival[]>(costs_.size())) {
    for (int k = 0; k < headings.count(); ++k) angles_rad_.push_back(headings.angle(k));
  }

  LatticePath run(const LatticePose& start) {
    for (const bool reverse : {false, true}) open(state_of(start, reverse), start, 0, {});
    LatticePath path;
    while (!open_.empty() && open_.top().f < best_cost_) {
      const Open next = open_.top();
      open_.pop();
      if (next.f - next.h > costs_[next.state]) continue;
      if (path.expansions == expansions_max_) {
        path.abandoned = true;
        break;
      }
      ++path.expansions;
      expand(next.state);
    }
    if (best_cost_ != kUnreachable) trace(path);
    return path;
  }

 private:
  // All states of a cell lie side by side: a search stays within the memory of few cells.
  [[nodiscard]] State state_of(const LatticePose& pose, bool reverse) const {
    const std::size_t layer = static_cast<std::size_t>(pose.heading) * 2 + (reverse ? 1 : 0);
    return static_cast<State>(space_.index(pose.column, pose.row) * layers() + layer);
  }

  [[nodiscard]] LatticePose pose_of(State state) const {
    const auto cell = static_cast<int>(state / layers());
    return {cell % space_.columns(), cell / space_.columns(),
            static_cast<int>(state % layers() / 2)};
  }

  [[nodiscard]] static bool is_reverse(State state) { return state % 2 != 0; }

  [[nodiscard]] std::size_t layers() const {
    return 2 * static_cast<std::size_t>(space_.headings());
  }

  /// Orders poses as the mirror image of the scene orders their images: by how far they are from
  /// its middle row, and then by the side, counted from the one that `handed_` says.
  [[nodiscard]] std::uint32_t rank(const LatticePose& pose) const {
    const int off = 2 * pose.row - (space_.rows() - 1);
    const int turned = pose.heading % (space_.headings() / 2) == 0
                           ? 0
                           : (2 * pose.heading < space_.headings() ? 1 : -1);
    const bool second = (off != 0 ? off : turned) * handed_ > 0;
    const int heading = std::min(pose.heading, space_.headings() - pose.heading);
    const int row = 2 * std::abs(off) + (second ? 1 : 0);
    return static_cast<std::uint32_t>((heading * 4 * space_.rows() + row) * space_.columns() +
                                      pose.column);
  }

  /// The side on which less is left to drive, where that first differs from the other side's: 1 or
  /// −1, or 0 if it does nowhere.
  [[nodiscard]] int handedness() const {
    for (int row = 0; row < space_.rows() / 2; ++row) {
      for (int column = 0; column < space_.columns(); ++column) {
        const std::int32_t here = heuristic_[space_.index(column, row)];
        const std::int32_t there = heuristic_[space_.index(column, space_.rows() - 1 - row)];
        if (here != there) return here < there ? 1 : -1;
      }
    }
    return 0;
  }

  void open(State state, const LatticePose& pose, std::int32_t cost, const Arrival& arrival) {
    const std::int32_t left = heuristic_[space_.index(pose.column, pose.row)];
    if (left == kUnreachable || cost >= costs_[state]) return;
    costs_[state] = cost;
    arrivals_[state] = arrival;
    open_.push({cost + left, left, rank(pose), state});
  }

  void update_best_end(State state, const LatticePose& pose) {
    const std::size_t cell = space_.index(pose.column, pose.row);
    const std::int32_t ending = goals_.ending_cost(cell);
    if (ending == GoalField::kNoGoal || costs_[state] + ending >= best_cost_) return;
    if (!goals_.accepts(cell, angles_rad_[static_cast<std::size_t>(pose.heading)])) return;
    best_cost_ = costs_[state] + ending;
    best_ = state;
  }

  void expand(State state) {
    const LatticePose pose = pose_of(state);
    update_best_end(state, pose);
    for (const MotionPrimitive& step : lattice_.primitives.from(pose.heading)) {
      const LatticePose next = Lattice::successor(pose, step);
      if (!lattice_.is_valid(next)) continue;
      const State to = state_of(next, step.reverse);
      const std::int32_t before =
          costs_[state] + (step.reverse == is_reverse(state) ? 0 : direction_change_cost_);
      if (before + step.length_mm * CSpace::kEven >= costs_[to]) continue;  // even on even ground
      const std::int32_t cost = lattice_.cost(pose, step);
      if (cost != Lattice::kBlocked) open(to, next, before + cost, {state, &step});
    }
  }

  void trace(LatticePath& path) const {
    path.found = true;
    path.cost = best_cost_;
    for (State state = best_; arrivals_[state].step != nullptr; state = arrivals_[state].from) {
      path.steps.push_back(arrivals_[state].step);
      path.costs.push_back(costs_[state]);
    }
    std::reverse(path.steps.begin(), path.steps.end());
    std::reverse(path.costs.begin(), path.costs.end());
  }

  const Lattice& lattice_;
  const CSpace& space_;
  const GoalField& goals_;
  const std::vector<std::int32_t>& heuristic_;
  std::int32_t direction_change_cost_;
  int expansions_max_;
  std::vector<std::int32_t> costs_;
  int handed_;
  // Left as they are: only those of states with a cost are looked at, a few of millions.
  std::unique_ptr<Arrival[]> arrivals_;
  std::vector<double> angles_rad_;  ///< of the headings
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
  std::int32_t best_cost_ = kUnreachable;
  State best_ = 0;
};

}  // namespace

LatticePath search_lattice(const Lattice& lattice, const HeadingSet& headings,
                           const LatticePose& start, const GoalField& goals,
                           const std::vector<std::int32_t>& heuristic, const SearchParams& params) {
  if (!lattice.is_valid(start)) return {};
  return Search(lattice, headings, goals, heuristic, params).run(start);
}

}  // namespace adit
