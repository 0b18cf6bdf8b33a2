// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/reachable.hpp"

#include <algorithm>

namespace adit {

Reachable reachable(const Lattice& lattice, const LatticePose& start, const GoalField& goals,
                    double enough_m) {
  const CSpace& space = lattice.space;
  std::vector<bool> seen(space.cells() * static_cast<std::size_t>(space.headings()));
  Reachable region;
  const auto add = [&](const LatticePose& pose) {
    const auto slice = static_cast<std::size_t>(pose.heading) * space.cells();
    const std::size_t i = slice + space.index(pose.column, pose.row);
    if (seen[i]) return;
    seen[i] = true;
    region.poses.push_back(pose);
    const std::size_t cell = space.index(pose.column, pose.row);
    if (!goals.accepts(cell, lattice.primitives.headings().angle(pose.heading))) return;
    region.progress_m = std::max(region.progress_m, goals.progress(cell));
  };
  if (lattice.stands(start)) add(start);
  for (std::size_t i = 0; i < region.poses.size() && region.progress_m < enough_m; ++i) {
    const LatticePose pose = region.poses[i];
    for (const MotionPrimitive& step : lattice.primitives.from(pose.heading)) {
      const LatticePose next = Lattice::behind(pose, step);
      if (!lattice.stands(next)) continue;
      const auto slice = static_cast<std::size_t>(next.heading) * space.cells();
      if (seen[slice + space.index(next.column, next.row)]) continue;
      if (lattice.cost(pose, step) != Lattice::kBlocked) add(next);
    }
  }
  return region;
}

}  // namespace adit
