// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/c_space/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace adit {
namespace {

// Growth of the rectangles, which allows a finite number of angles and poses to be tested.
constexpr double kMarginM = 0.01;

double radius(const std::vector<BodyRectangle>& rectangles) {
  double longest = 0.0;
  for (const auto& r : rectangles) {
    longest = std::max(longest, (r.middle.cwiseAbs() + r.half).norm());
  }
  return longest;
}

int reach_of(const std::vector<BodyRectangle>& rectangles, double cell_m) {
  return static_cast<int>(std::ceil((radius(rectangles) + kMarginM) / cell_m)) + 2;
}

/// Angles so dense that no corner moves more than twice kMarginM from one to the next.
std::vector<double> angles_between(double first, double last, double radius_m) {
  const int steps = static_cast<int>(std::ceil((last - first) * radius_m / (2.0 * kMarginM)));
  std::vector<double> angles;
  for (int i = 0; i <= steps; ++i) angles.push_back(first + (last - first) * i / steps);
  return angles;
}

}  // namespace

RunKernel kernel_of(int reach, const std::function<bool(int, int)>& holds) {
  RunKernel kernel;
  for (int row = -reach; row <= reach; ++row) {
    for (int column = -reach; column <= reach; ++column) {
      if (!holds(column, row)) continue;
      const bool begins = column == -reach || !holds(column - 1, row);
      if (begins) kernel.runs.push_back({row, column, column});
      kernel.runs.back().last = column;
      kernel.reach = std::max({kernel.reach, std::abs(row), std::abs(column)});
      ++kernel.cells;
    }
  }
  return kernel;
}

RunKernel swept_kernel(const std::vector<BodyRectangle>& rectangles,
                       const std::vector<Pose2>& poses, double cell_m) {
  double distance_m = 0.0;
  for (const Pose2& pose : poses) distance_m = std::max(distance_m, pose.translation().norm());
  const int reach = reach_of(rectangles, cell_m) + static_cast<int>(std::ceil(distance_m / cell_m));
  const double far_m = radius(rectangles) + kMarginM + cell_m;
  return kernel_of(reach, [&](int column, int row) {
    const Eigen::Vector2d p = cell_m * Eigen::Vector2d(column, row);
    for (const Pose2& pose : poses) {
      const Eigen::Vector2d away = p - pose.translation();
      if (away.squaredNorm() > far_m * far_m) continue;
      for (const auto& rectangle : rectangles) {
        if (meets_square(rectangle.grown(kMarginM), pose.theta, away, cell_m / 2.0)) return true;
      }
    }
    return false;
  });
}

RunKernel covering_kernel(const std::vector<BodyRectangle>& rectangles, const HeadingSet& headings,
                          int heading, double cell_m) {
  const Pose2 T_body_grid = Pose2{0.0, 0.0, headings.angle(heading)}.inverse();
  std::vector<BodyRectangle> rounded;  // includes centres on an edge, whatever the rounding
  for (const auto& rectangle : rectangles) rounded.push_back(rectangle.grown(1e-6));
  return kernel_of(reach_of(rectangles, cell_m), [&](int column, int row) {
    return any_contains(rounded, T_body_grid * (cell_m * Eigen::Vector2d(column, row)));
  });
}

RunKernel conservative_kernel(const std::vector<BodyRectangle>& rectangles,
                              const HeadingSet& headings, int heading, double cell_m) {
  const double middle = headings.angle(heading);
  const double first = middle - headings.half_gap(headings.wrapped(heading - 1));
  const auto angles =
      angles_between(first, middle + headings.half_gap(heading), radius(rectangles));
  // The body is up to half a cell from the centre of its cell, and so is a point of the other cell:
  // the square has a half side of a full cell.
  return kernel_of(reach_of(rectangles, cell_m), [&](int column, int row) {
    const Eigen::Vector2d p = cell_m * Eigen::Vector2d(column, row);
    for (const auto& rectangle : rectangles) {
      for (const double angle : angles) {
        if (meets_square(rectangle.grown(kMarginM), angle, p, cell_m)) return true;
      }
    }
    return false;
  });
}

}  // namespace adit
