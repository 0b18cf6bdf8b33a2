// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/merge/run_groups.hpp"

#include <algorithm>
#include <utility>

namespace adit {

void RunGroups::add(std::unique_ptr<Mapping> map) {
  RunGroup added;
  const LocalMapStore& maps = map->local_maps();
  added.runs.push_back({runs_++, 0, static_cast<int>(maps.size()), maps.front().session,
                        maps.back().session - maps.front().session + 1, std::nullopt});
  added.map = std::move(map);
  for (RunGroup& group : groups_) {
    if (try_join(group, added)) return;
  }
  groups_.push_back(std::move(added));
}

/// Joins `other` to the group, which then has its runs.
bool RunGroups::try_join(RunGroup& group, RunGroup& other) {
  RunJoin join = group.map->join(*other.map, params_);
  if (!join.joined) {
    rejected_.push_back({group.runs.front().run, other.runs.front().run, std::move(join)});
    return false;
  }
  const int sessions_before = other.runs.front().first_session;
  for (PlacedRun& run : other.runs) {
    run.first_map += join.first_map;
    run.first_session += join.session - sessions_before;
    if (!run.join) continue;
    run.join->first_map += join.first_map;
    run.join->session += join.session - sessions_before;
    for (JoinLink& link : run.join->links) {
      link.older += join.first_map;
      link.newer += join.first_map;
    }
  }
  other.runs.front().join = std::move(join);
  std::ranges::move(other.runs, std::back_inserter(group.runs));
  other.map.reset();
  return true;
}

void RunGroups::finish(const std::function<void(double)>& progress) {
  const auto by_size = [](const RunGroup& a, const RunGroup& b) {
    const auto size = [](const RunGroup& group) {
      return std::pair(group.runs.size(), group.map->local_maps().size());
    };
    return size(a) > size(b);
  };
  bool changed = runs_ > 2 && groups_.size() > 1;  // of two runs nothing has grown
  while (changed) {
    changed = false;
    std::ranges::stable_sort(groups_, by_size);
    for (std::size_t i = 0; i + 1 < groups_.size(); ++i) {
      if (groups_[i].runs.size() < 2) break;
      for (std::size_t k = i + 1; k < groups_.size();) {
        if (progress) progress(static_cast<double>(k) / static_cast<double>(groups_.size()));
        if (try_join(groups_[i], groups_[k])) {
          groups_.erase(groups_.begin() + static_cast<std::ptrdiff_t>(k));
          changed = true;
        } else {
          ++k;
        }
      }
    }
  }
  std::ranges::stable_sort(groups_, by_size);
}

}  // namespace adit
