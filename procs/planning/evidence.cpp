// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/evidence.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

using Reason = BlockingCell::Reason;

constexpr double kFrontM = 0.5;  // behind the greatest progress, from where a drive on is tried

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

/// Marks the cells that are in the way.
class Marks {
 public:
  Marks(const Lattice& lattice, const Grounds& grounds)
      : lattice_(lattice), grounds_(grounds), marked_(grounds.terrain.cells.size()) {}

  /// Those for which `counts(p_level)`, of what makes a pose lethal.
  template <class Counts>
  void mark(const LatticePose& pose, const Counts& counts) {
    const auto& kernel = grounds_.kernels.oriented(pose.heading);
    const bool unseen =
        lattice_.space.contains(pose.column, pose.row) &&
        lattice_.space.slice(pose.heading)[lattice_.space.index(pose.column, pose.row)] ==
            CSpace::kUnseen;
    if (unseen) {
      mark_layer(grounds_.layers.unseen, kernel.wheels, pose, counts);
    } else {
      mark_layer(grounds_.layers.under_body, kernel.close_body, pose, counts);
      mark_layer(grounds_.layers.under_wheels, kernel.close_wheels, pose, counts);
    }
  }

  /// The same of what makes a piece of driving lethal.
  template <class Counts>
  void mark(const LatticePose& pose, const MotionPrimitive& step, const Counts& counts) {
    mark_layer(grounds_.layers.under_body, step.body, pose, counts);
    mark_layer(grounds_.layers.under_wheels, step.wheels, pose, counts);
    mark_layer(grounds_.layers.unseen, step.body, pose, counts);
  }

  [[nodiscard]] std::vector<BlockingCell> cells() const {
    std::vector<BlockingCell> found;
    const TerrainMap& terrain = grounds_.terrain;
    for (int row = 0; row < terrain.rows; ++row) {
      for (int column = 0; column < terrain.columns; ++column) {
        const TerrainCell& cell = terrain.at(column, row);
        const auto reason = lethal_reason(cell, grounds_.vehicle, grounds_.limits);
        if (!reason || !marked_[grounds_.layers.index(column, row)]) continue;
        found.push_back({terrain.T_odom_level * terrain.centre(column, row), *reason,
                         height_of(cell, *reason)});
      }
    }
    return found;
  }

 private:
  template <class Counts>
  void mark_layer(const std::vector<std::uint8_t>& layer, const RunKernel& kernel,
                  const LatticePose& pose, const Counts& counts) {
    for (const RunKernel::Run& run : kernel.runs) {
      for (int dx = run.first; dx <= run.last; ++dx) {
        const int column = pose.column + dx;
        const int row = pose.row + run.row;
        if (!grounds_.terrain.contains(column, row)) continue;
        const std::size_t i = grounds_.layers.index(column, row);
        if (layer[i] != 0 && counts(grounds_.terrain.centre(column, row))) marked_[i] = true;
      }
    }
  }

  const Lattice& lattice_;
  const Grounds& grounds_;
  std::vector<bool> marked_;
};

/// The first pose of a primitive in which the robot cannot stand; the pose itself if there is none.
LatticePose first_refused(const Lattice& lattice, const LatticePose& pose,
                          const MotionPrimitive& step) {
  for (const SweptPose& swept : step.swept) {
    const LatticePose next{pose.column + swept.column, pose.row + swept.row, swept.heading};
    if (!lattice.stands(next)) return next;
  }
  return pose;
}

}  // namespace

std::vector<BlockingCell> blocking_cells(const Reachable& region, const Lattice& lattice,
                                         const GoalField& goals, const Grounds& grounds) {
  Marks marks(lattice, grounds);
  const TerrainMap& terrain = grounds.terrain;
  for (const LatticePose& pose : region.poses) {
    const Eigen::Vector2d p = terrain.centre(pose.column, pose.row);
    const std::size_t cell = lattice.space.index(pose.column, pose.row);
    if (goals.progress(cell) < region.progress_m - kFrontM) continue;
    const Eigen::Vector2d direction = goals.direction(p);
    for (const MotionPrimitive& step : lattice.primitives.from(pose.heading)) {
      const LatticePose next = Lattice::behind(pose, step);
      const Eigen::Vector2d on = terrain.centre(next.column, next.row) - p;
      if (on.dot(direction) <= 0.0 || lattice.cost(pose, step) != Lattice::kBlocked) {
        continue;
      }
      const auto is_ahead = [&](const Eigen::Vector2d& p_level) {
        return (p_level - p).dot(direction) > 0.0;
      };
      const LatticePose refused = first_refused(lattice, pose, step);
      if (refused == pose) {
        marks.mark(pose, step, is_ahead);
      } else {
        marks.mark(refused, is_ahead);
      }
    }
  }
  return marks.cells();
}

std::vector<BlockingCell> blocking_cells(const LatticePose& pose, const Lattice& lattice,
                                         const Grounds& grounds) {
  Marks marks(lattice, grounds);
  marks.mark(pose, [](const Eigen::Vector2d&) { return true; });
  return marks.cells();
}

}  // namespace adit
