// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/c_space/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "procs/planning/c_space/footprint.hpp"

namespace adit {
namespace {

// Growth of the polygons, which allows a finite number of angles and poses to be tested.
constexpr double kMarginM = 0.01;

double radius(const std::vector<ConvexPolygon>& polygons) {
  double longest = 0.0;
  for (const ConvexPolygon& polygon : polygons) longest = std::max(longest, polygon.radius_m());
  return longest;
}

int reach_of(const std::vector<ConvexPolygon>& polygons, double cell_m) {
  return static_cast<int>(std::ceil((radius(polygons) + kMarginM) / cell_m)) + 2;
}

/// Angles so dense that no corner moves more than twice kMarginM from one to the next.
std::vector<double> angles_between(double first, double last, double radius_m) {
  const int steps = static_cast<int>(std::ceil((last - first) * radius_m / (2.0 * kMarginM)));
  std::vector<double> angles;
  for (int i = 0; i <= steps; ++i) angles.push_back(first + (last - first) * i / steps);
  return angles;
}

/// The polygons, grown, at each of some poses.
std::vector<ConvexPolygon> placed(const std::vector<ConvexPolygon>& polygons, double by_m,
                                  const std::vector<Pose2>& poses) {
  std::vector<ConvexPolygon> at_poses;
  for (const ConvexPolygon& polygon : polygons) {
    const ConvexPolygon grown = polygon.grown(by_m);
    for (const Pose2& pose : poses) at_poses.push_back(grown.moved(pose));
  }
  return at_poses;
}

/// Whether any of them meets the square of this half side.
bool any_meets(const std::vector<ConvexPolygon>& polygons, const Eigen::Vector2d& p,
               double half_m) {
  return std::ranges::any_of(
      polygons, [&](const ConvexPolygon& polygon) { return polygon.meets_square(p, half_m); });
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

RunKernel swept_kernel(const std::vector<ConvexPolygon>& polygons, const std::vector<Pose2>& poses,
                       double cell_m) {
  double distance_m = 0.0;
  for (const Pose2& pose : poses) distance_m = std::max(distance_m, pose.translation().norm());
  const int reach = reach_of(polygons, cell_m) + static_cast<int>(std::ceil(distance_m / cell_m));
  const auto swept = placed(polygons, kMarginM, poses);
  return kernel_of(reach, [&](int column, int row) {
    return any_meets(swept, cell_m * Eigen::Vector2d(column, row), cell_m / 2.0);
  });
}

RunKernel covering_kernel(const std::vector<ConvexPolygon>& polygons, const HeadingSet& headings,
                          int heading, double cell_m) {
  // Includes centres on an edge, whatever the rounding.
  const auto rounded = placed(polygons, 1e-6, {{0.0, 0.0, headings.angle(heading)}});
  return kernel_of(reach_of(polygons, cell_m), [&](int column, int row) {
    return any_contains(rounded, cell_m * Eigen::Vector2d(column, row));
  });
}

RunKernel conservative_kernel(const std::vector<ConvexPolygon>& polygons,
                              const HeadingSet& headings, int heading, double cell_m) {
  const double middle = headings.angle(heading);
  const double first = middle - headings.half_gap(headings.wrapped(heading - 1));
  std::vector<Pose2> poses;
  for (const double angle :
       angles_between(first, middle + headings.half_gap(heading), radius(polygons)))
    poses.push_back({0.0, 0.0, angle});
  const auto turned = placed(polygons, kMarginM, poses);
  // The body is up to half a cell from the centre of its cell, and so is a point of the other cell:
  // the square has a half side of a full cell.
  return kernel_of(reach_of(polygons, cell_m), [&](int column, int row) {
    return any_meets(turned, cell_m * Eigen::Vector2d(column, row), cell_m);
  });
}

}  // namespace adit
