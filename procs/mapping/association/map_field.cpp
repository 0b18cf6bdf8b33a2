// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/map_field.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace adit {
namespace {

constexpr int kMostFew = 1000;  // maps, and this share of all, of which a factorisation is cheaper
constexpr int kMostShare = 4;
constexpr int kFirstSteps = 5;  // to the mode of a map that was restored

}  // namespace

void MapField::follow(const AssociationProblem& problem, const Hypothesis& hypothesis) {
  bool is_changed = false;
  const std::size_t before = poses_.size();
  for (std::size_t map = 0; map < before; ++map) {
    const Pose2& T_map_local = hypothesis.T_map_local[map];
    if (T_map_local == followed_[map] || T_map_local == poses_[map]) continue;
    field_.move(static_cast<int>(map), T_map_local);
    poses_[map] = T_map_local;
    is_changed = true;
  }
  const bool is_new = before < 2;
  add_maps(problem, hypothesis);
  followed_ = hypothesis.T_map_local;
  chosen_.resize(hypothesis.chosen.size());
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    if (chosen_[k].alternative == hypothesis.chosen[k]) continue;
    choose(problem, k, hypothesis.chosen[k]);
    is_changed = true;
  }
  if (poses_.size() < 2) return;
  if (!relinearise()) update(!is_changed && !is_new);
  for (int step = 0; is_new && step < kFirstSteps && relinearise();) ++step;
}

void MapField::add_maps(const AssociationProblem& problem, const Hypothesis& hypothesis) {
  for (std::size_t map = poses_.size(); map < hypothesis.T_map_local.size(); ++map) {
    poses_.push_back(hypothesis.T_map_local[map]);
    field_.add_node(poses_.back());
    if (map > 0) chain_.push_back(field_.add(problem.chain[map - 1]));
  }
}

void MapField::truncate(int maps, std::size_t loop_closures) {
  while (chosen_.size() > loop_closures) {
    if (chosen_.back().constraint >= 0) field_.remove(chosen_.back().constraint);
    chosen_.pop_back();
  }
  while (static_cast<int>(poses_.size()) > maps) {
    if (!chain_.empty()) field_.remove(chain_.back());
    if (!chain_.empty()) chain_.pop_back();
    field_.remove_newest_node();
    poses_.pop_back();
    followed_.pop_back();
  }
  std::erase_if(displaced_, [&](int map) { return map >= maps; });
  if (poses_.size() > 1) update(false);
}

void MapField::choose(const AssociationProblem& problem, std::size_t loop_closure,
                      int alternative) {
  Chosen& chosen = chosen_[loop_closure];
  if (chosen.constraint >= 0) field_.remove(chosen.constraint);
  chosen = {alternative, -1};
  if (alternative == Association::kNone) return;
  chosen.constraint = field_.add(constraint_of(problem.loop_closures[loop_closure], alternative));
}

void MapField::accept(const AssociationProblem& problem, int loop_closure, int alternative) {
  chosen_.resize(std::max(chosen_.size(), as_index(loop_closure) + 1));
  choose(problem, as_index(loop_closure), alternative);
  update(false);
}

bool MapField::is_far(int map) const {
  const Eigen::Vector3d mode = field_.mode(map);
  return mode.head<2>().norm() > kMovedM || std::abs(mode.z()) > kMovedRad;
}

bool MapField::is_mostly_far() const {
  const auto far = std::ranges::count_if(displaced_, [this](int map) { return is_far(map); });
  return far > kMostFew && far > std::ssize(poses_) / kMostShare;
}

bool MapField::relinearise() {
  bool any = false;
  for (const int map : std::exchange(displaced_, {})) {
    if (!is_far(map)) continue;
    field_.move(map, poses_[as_index(map)]);
    any = true;
  }
  if (any) update(false);
  return any;
}

void MapField::update(bool only_new_maps) {
  field_.update(only_new_maps);
  for (const int map : field_.changed()) {
    poses_[as_index(map)] = field_.pose(map);
    displaced_.push_back(map);
  }
  std::ranges::sort(displaced_);
  displaced_.erase(std::unique(displaced_.begin(), displaced_.end()), displaced_.end());
}

double MapField::largest_turn() const {
  double turn = 0.0;
  for (const int map : displaced_) turn = std::max(turn, std::abs(field_.mode(map).z()));
  return turn;
}

}  // namespace adit
