// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/blocking_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace adit {

ReachableRegion reachable_region(const Lattice& lattice, const LatticePose& start,
                                 const GoalField& goals, double enough_m) {
  const CSpace& space = lattice.space;
  std::vector<bool> visited(space.cells() * static_cast<std::size_t>(space.headings()));
  ReachableRegion region;
  const auto add = [&](const LatticePose& pose) {
    const auto slice = static_cast<std::size_t>(pose.heading) * space.cells();
    const std::size_t i = slice + space.index(pose.column, pose.row);
    if (visited[i]) return;
    visited[i] = true;
    region.poses.push_back(pose);
    const std::size_t cell = space.index(pose.column, pose.row);
    if (!goals.accepts(cell, lattice.primitives.headings().angle(pose.heading))) return;
    region.progress_m = std::max(region.progress_m, goals.progress(cell));
  };
  if (lattice.is_valid(start)) add(start);
  for (std::size_t i = 0; i < region.poses.size() && region.progress_m < enough_m; ++i) {
    const LatticePose pose = region.poses[i];
    for (const MotionPrimitive& step : lattice.primitives.from(pose.heading)) {
      const LatticePose next = Lattice::successor(pose, step);
      if (!lattice.is_valid(next)) continue;
      const auto slice = static_cast<std::size_t>(next.heading) * space.cells();
      if (visited[slice + space.index(next.column, next.row)]) continue;
      if (lattice.cost(pose, step) != Lattice::kBlocked) add(next);
    }
  }
  return region;
}

namespace {

using Reason = BlockingCell::Reason;

constexpr double kFrontDepthM = 0.5;  // poses within this of the maximum progress are the front

/// The height that makes a cell lethal [m]; 0 where no height does.
double height_of(const TerrainCell& cell, Reason reason) {
  switch (reason) {
    case Reason::kRoof:
      return cell.clearance_m;
    case Reason::kStep: {
      const double height = std::fmax(cell.coefficient_m, cell.step_m);
      return std::isnan(height) ? 0.0 : height;
    }
    case Reason::kBelly:
    case Reason::kSlope:
      return cell.coefficient_m;
    case Reason::kUnknown:
    case Reason::kWater:
    case Reason::kDrop:
      break;
  }
  return 0.0;
}

/// Collects the lethal cells that block poses and primitives.
class BlockingMask {
 public:
  BlockingMask(const Lattice& lattice, const EvidenceContext& context)
      : lattice_(lattice), context_(context), marked_(context.terrain.cells.size()) {}

  /// Marks the cells that block a pose and for which `counts(p_level)` is true.
  template <class Counts>
  void mark(const LatticePose& pose, const Counts& counts) {
    const auto& kernel = context_.kernels.oriented(pose.heading);
    const bool unknown =
        lattice_.space.slice(pose.heading).get({pose.column, pose.row}) == CSpace::kUnknown;
    if (unknown) {
      mark_layer(context_.layers.unknown, kernel.wheels, pose, counts);
    } else {
      mark_layer(context_.layers.under_body, kernel.conservative_body, pose, counts);
      mark_layer(context_.layers.under_wheels, kernel.conservative_wheels, pose, counts);
    }
  }

  /// Marks the cells that block a primitive.
  template <class Counts>
  void mark(const LatticePose& pose, const MotionPrimitive& step, const Counts& counts) {
    mark_layer(context_.layers.under_body, step.body, pose, counts);
    mark_layer(context_.layers.under_wheels, step.wheels, pose, counts);
    mark_layer(context_.layers.unknown, step.body, pose, counts);
  }

  [[nodiscard]] std::vector<BlockingCell> cells() const {
    std::vector<BlockingCell> found;
    const TerrainMap& terrain = context_.terrain;
    for (int row = 0; row < terrain.cells.rows(); ++row) {
      for (int column = 0; column < terrain.cells.columns(); ++column) {
        const std::size_t i = context_.layers.index(column, row);
        if (!marked_[i]) continue;
        const std::uint32_t leaning_from = context_.layers.leaning_from[i];
        const TerrainCell& cell = terrain.cells[leaning_from == 0 ? i : leaning_from - 1];
        const auto reason = lethal_reason(cell, context_.vehicle, context_.limits);
        if (!reason) continue;
        found.push_back({terrain.T_odom_level * terrain.centre(column, row), *reason,
                         height_of(cell, *reason)});
      }
    }
    return found;
  }

 private:
  template <class Counts>
  void mark_layer(const CellLayer& layer, const RunKernel& kernel, const LatticePose& pose,
                  const Counts& counts) {
    for (const RunKernel::Run& run : kernel.runs) {
      for (int dx = run.first; dx <= run.last; ++dx) {
        const int column = pose.column + dx;
        const int row = pose.row + run.row;
        if (!context_.terrain.cells.contains({column, row})) continue;
        const std::size_t i = context_.layers.index(column, row);
        if (layer[i] != 0 && counts(context_.terrain.centre(column, row))) marked_[i] = true;
      }
    }
  }

  const Lattice& lattice_;
  const EvidenceContext& context_;
  std::vector<bool> marked_;
};

/// The first blocked pose of a primitive; its start if none is.
LatticePose first_blocked(const Lattice& lattice, const LatticePose& pose,
                          const MotionPrimitive& step) {
  for (const SweptPose& swept : step.swept) {
    const LatticePose next{pose.column + swept.column, pose.row + swept.row, swept.heading};
    if (!lattice.is_valid(next)) return next;
  }
  return pose;
}

}  // namespace

std::vector<BlockingCell> blocking_cells(const ReachableRegion& region, const Lattice& lattice,
                                         const GoalField& goals, const EvidenceContext& context) {
  BlockingMask mask(lattice, context);
  const TerrainMap& terrain = context.terrain;
  for (const LatticePose& pose : region.poses) {
    const Eigen::Vector2d p = terrain.centre(pose.column, pose.row);
    const std::size_t cell = lattice.space.index(pose.column, pose.row);
    if (goals.progress(cell) < region.progress_m - kFrontDepthM) continue;
    const Eigen::Vector2d direction = goals.direction(p);
    for (const MotionPrimitive& step : lattice.primitives.from(pose.heading)) {
      const LatticePose next = Lattice::successor(pose, step);
      const Eigen::Vector2d step_vector = terrain.centre(next.column, next.row) - p;
      if (step_vector.dot(direction) <= 0.0 || lattice.cost(pose, step) != Lattice::kBlocked) {
        continue;
      }
      const auto is_ahead = [&](const Eigen::Vector2d& p_level) {
        return (p_level - p).dot(direction) > 0.0;
      };
      const LatticePose blocked = first_blocked(lattice, pose, step);
      if (blocked == pose) {
        mask.mark(pose, step, is_ahead);
      } else {
        mask.mark(blocked, is_ahead);
      }
    }
  }
  return mask.cells();
}

std::vector<BlockingCell> blocking_cells(const LatticePose& pose, const Lattice& lattice,
                                         const EvidenceContext& context) {
  BlockingMask mask(lattice, context);
  mask.mark(pose, [](const Eigen::Vector2d&) { return true; });
  return mask.cells();
}

}  // namespace adit
