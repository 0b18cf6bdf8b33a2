// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/path_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/geometry/arc.hpp"

namespace adit {
namespace {

constexpr double kSameM = 0.001;
constexpr double kLastM = 0.05;  // by which a run knows how it bends at last

void add(const PathPoint& point, const SteeredPoint& steered, std::vector<PathRun::Knot>& knots) {
  PathRun::Knot knot{0.0, steered.pose(point.T_odom_body), point.clearance_m};
  if (!knots.empty()) {
    const PathRun::Knot& last = knots.back();
    const double way_m =
        (knot.T_odom_steered.translation() - last.T_odom_steered.translation()).norm();
    if (way_m < kSameM) return;
    knot.s_m = last.s_m + way_m;
    knot.T_odom_steered.theta = last.T_odom_steered.theta +
                                angle_diff(knot.T_odom_steered.theta, last.T_odom_steered.theta);
  }
  knots.push_back(knot);
}

}  // namespace

PathRun::PathRun(std::vector<Knot> knots, bool reverse)
    : knots_(std::move(knots)), direction_(reverse ? -1.0 : 1.0) {}

std::size_t PathRun::end_of_stretch(double s_m) const {
  const auto behind = std::upper_bound(knots_.begin(), knots_.end(), s_m,
                                       [](double s, const Knot& knot) { return s < knot.s_m; });
  const auto i = static_cast<std::size_t>(behind - knots_.begin());
  return std::min(std::max<std::size_t>(i, 1), knots_.size() - 1);
}

Pose2 PathRun::behind_end(double way_m) const {
  const Pose2& T_odom_end = knots_.back().T_odom_steered;
  const double turn = way_m * curvature_1_m(length_m() - kLastM, length_m());
  const Pose2 T_odom_behind = T_odom_end * along_arc(direction_ * way_m, direction_ * turn);
  return {T_odom_behind.x, T_odom_behind.y, T_odom_end.theta + direction_ * turn};
}

Pose2 PathRun::at(double s_m) const {
  if (s_m >= length_m()) return behind_end(s_m - length_m());
  const std::size_t i = end_of_stretch(s_m);
  const Knot& a = knots_[i - 1];
  const Knot& b = knots_[i];
  const double share = std::max(0.0, s_m - a.s_m) / (b.s_m - a.s_m);
  return {std::lerp(a.T_odom_steered.x, b.T_odom_steered.x, share),
          std::lerp(a.T_odom_steered.y, b.T_odom_steered.y, share),
          std::lerp(a.T_odom_steered.theta, b.T_odom_steered.theta, share)};
}

double PathRun::clearance_m(double s_m) const {
  const std::size_t i = end_of_stretch(s_m);
  return std::min(knots_[i == 0 ? 0 : i - 1].clearance_m, knots_[i].clearance_m);
}

double PathRun::curvature_1_m(double from_m, double to_m) const {
  const double from = std::clamp(from_m, 0.0, length_m());
  const double to = std::clamp(to_m, 0.0, length_m());
  if (to - from < kSameM) return 0.0;
  const auto heading = [this](double s_m) {
    return s_m < length_m() ? at(s_m).theta : knots_.back().T_odom_steered.theta;
  };
  return direction_ * (heading(to) - heading(from)) / (to - from);
}

double PathRun::nearest_m(const Eigen::Vector2d& p_odom, double from_m, double to_m) const {
  double best_m = from_m;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = end_of_stretch(from_m); i < knots_.size(); ++i) {
    if (i == 0 || knots_[i - 1].s_m > to_m) break;
    const Eigen::Vector2d a = knots_[i - 1].T_odom_steered.translation();
    const double length = knots_[i].s_m - knots_[i - 1].s_m;
    const Eigen::Vector2d along = (knots_[i].T_odom_steered.translation() - a) / length;
    const double low = std::max(0.0, from_m - knots_[i - 1].s_m);
    const double high = std::max(low, std::min(length, to_m - knots_[i - 1].s_m));
    const double t = std::clamp(along.dot(p_odom - a), low, high);
    const double distance = (a + t * along - p_odom).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    best_m = knots_[i - 1].s_m + t;
  }
  return best_m;
}

std::vector<PathRun> runs_of(const std::vector<PathPoint>& points, const SteeredPoint& steered) {
  std::vector<PathRun> runs;
  std::vector<PathRun::Knot> knots;
  for (std::size_t i = 0; i < points.size(); ++i) {
    add(points[i], steered, knots);
    const bool last = i + 1 == points.size();
    const bool turns = i > 0 && points[i].reverse != points[i - 1].reverse;
    if (!turns && !last) continue;
    const bool reverse = points[i == 0 ? 0 : i - 1].reverse;
    if (knots.size() > 1 || (last && runs.empty())) runs.emplace_back(std::move(knots), reverse);
    knots.clear();
    add(points[i], steered, knots);
  }
  return runs;
}

}  // namespace adit
