// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/path_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "common/geometry/pose2.hpp"

namespace adit {
namespace {

constexpr double kPointDistanceMinM = 0.001;
constexpr double kEndCurvatureM = 0.05;  // length at the end of a run that defines its curvature
constexpr double kKnotSpacingM = 0.05;   // of a blended run
constexpr int kSamples = 8;              // of a mean, to either side
constexpr double kWideningM = 0.05;      // of clearance, over which the window of a mean widens
constexpr double kWideningRate = 0.5;    // of the window per metre of path, or bends would kink

void add_knot(const PathPoint& point, const SteeredPoint& steered,
              std::vector<PathRun::Knot>& knots) {
  PathRun::Knot knot{0.0, steered.pose(point.T_odom_body), point.clearance_m};
  if (!knots.empty()) {
    const PathRun::Knot& last = knots.back();
    const double distance_m =
        (knot.T_odom_steered.translation() - last.T_odom_steered.translation()).norm();
    if (distance_m < kPointDistanceMinM) return;
    knot.s_m = last.s_m + distance_m;
    knot.T_odom_steered.theta = last.T_odom_steered.theta +
                                angle_diff(knot.T_odom_steered.theta, last.T_odom_steered.theta);
  }
  knots.push_back(knot);
}

/// Mean pose over an interval, by the trapezoidal rule. Headings of a run are not wrapped.
Pose2 mean_pose(const PathRun& run, double s_m, double half_m) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = -kSamples; i <= kSamples; ++i) {
    const double weight = std::abs(i) == kSamples ? 0.5 : 1.0;
    sum += weight * run.at(s_m + half_m * i / kSamples).vector();
  }
  const Eigen::Vector3d mean = sum / (2.0 * kSamples);
  return {mean.x(), mean.y(), mean.z()};
}

/// The windows of the means at equal distances along a run.
std::vector<double> windows_m(const PathRun& run, std::size_t segments, double blend_m,
                              double wide_m, double clearance_m) {
  const double spacing_m = run.length_m() / static_cast<double>(std::max<std::size_t>(segments, 1));
  std::vector<double> windows;
  for (std::size_t i = 0; i <= segments; ++i) {
    const double over_m = run.clearance_m(spacing_m * static_cast<double>(i)) - clearance_m;
    windows.push_back(std::lerp(blend_m, wide_m, std::clamp(over_m / kWideningM, 0.0, 1.0)));
  }
  const double step_m = kWideningRate * spacing_m;
  for (std::size_t i = 1; i < windows.size(); ++i)
    windows[i] = std::min(windows[i], windows[i - 1] + step_m);
  for (std::size_t i = windows.size() - 1; i-- > 0;)
    windows[i] = std::min(windows[i], windows[i + 1] + step_m);
  return windows;
}

}  // namespace

SteeredPoint::SteeredPoint(const Vehicle& vehicle)
    : curvature_max_1_m_(1.0 / vehicle.turning_radius_m) {
  if (vehicle.steering != "ackermann") return;
  x_m_ = -0.5 * vehicle.wheelbase_m;
  if (vehicle.turning_radius_m <= -x_m_) {
    throw std::invalid_argument(
        "the turning radius must exceed half the wheelbase with Ackermann steering");
  }
  curvature_max_1_m_ =
      1.0 / std::sqrt(vehicle.turning_radius_m * vehicle.turning_radius_m - x_m_ * x_m_);
}

Pose2 SteeredPoint::pose(const Pose2& T_odom_body) const {
  return T_odom_body * Pose2{x_m_, 0.0, 0.0};
}

Pose2 SteeredPoint::body(const Pose2& T_odom_steered) const {
  return T_odom_steered * Pose2{-x_m_, 0.0, 0.0};
}

double SteeredPoint::curvature_of_origin(double curvature_1_m) const {
  return curvature_1_m / std::hypot(1.0, x_m_ * curvature_1_m);
}

PathRun::PathRun(std::vector<Knot> knots, bool reverse)
    : knots_(std::move(knots)), direction_(reverse ? -1.0 : 1.0) {}

std::size_t PathRun::segment_end(double s_m) const {
  const auto after = std::upper_bound(knots_.begin(), knots_.end(), s_m,
                                      [](double s, const Knot& knot) { return s < knot.s_m; });
  const auto i = static_cast<std::size_t>(after - knots_.begin());
  return std::min(std::max<std::size_t>(i, 1), knots_.size() - 1);
}

Pose2 PathRun::extrapolate_past_end(double distance_m) const {
  const Pose2& T_odom_end = knots_.back().T_odom_steered;
  const double turn = distance_m * curvature_1_m(length_m() - kEndCurvatureM, length_m());
  const Pose2 T_odom_beyond = T_odom_end * along_arc(direction_ * distance_m, direction_ * turn);
  return {T_odom_beyond.x, T_odom_beyond.y, T_odom_end.theta + direction_ * turn};
}

Pose2 PathRun::at(double s_m) const {
  if (s_m >= length_m()) return extrapolate_past_end(s_m - length_m());
  const std::size_t i = segment_end(s_m);
  const Knot& a = knots_[i - 1];
  const Knot& b = knots_[i];
  const double share = std::max(0.0, s_m - a.s_m) / (b.s_m - a.s_m);
  return {std::lerp(a.T_odom_steered.x, b.T_odom_steered.x, share),
          std::lerp(a.T_odom_steered.y, b.T_odom_steered.y, share),
          std::lerp(a.T_odom_steered.theta, b.T_odom_steered.theta, share)};
}

double PathRun::clearance_m(double s_m) const {
  const std::size_t i = segment_end(s_m);
  return std::min(knots_[i == 0 ? 0 : i - 1].clearance_m, knots_[i].clearance_m);
}

double PathRun::curvature_1_m(double from_m, double to_m) const {
  const double from = std::clamp(from_m, 0.0, length_m());
  const double to = std::clamp(to_m, 0.0, length_m());
  if (to - from < kPointDistanceMinM) return 0.0;
  const auto heading = [this](double s_m) {
    return s_m < length_m() ? at(s_m).theta : knots_.back().T_odom_steered.theta;
  };
  return direction_ * (heading(to) - heading(from)) / (to - from);
}

double PathRun::nearest_s_m(const Eigen::Vector2d& p_odom, double from_m, double to_m) const {
  double best_m = from_m;
  double min_squared = std::numeric_limits<double>::infinity();
  for (std::size_t i = segment_end(from_m); i < knots_.size(); ++i) {
    if (i == 0 || knots_[i - 1].s_m > to_m) break;
    const Eigen::Vector2d a = knots_[i - 1].T_odom_steered.translation();
    const double length = knots_[i].s_m - knots_[i - 1].s_m;
    const Eigen::Vector2d along = (knots_[i].T_odom_steered.translation() - a) / length;
    const double low = std::max(0.0, from_m - knots_[i - 1].s_m);
    const double high = std::max(low, std::min(length, to_m - knots_[i - 1].s_m));
    const double t = std::clamp(along.dot(p_odom - a), low, high);
    const double squared = (a + t * along - p_odom).squaredNorm();
    if (squared >= min_squared) continue;
    min_squared = squared;
    best_m = knots_[i - 1].s_m + t;
  }
  return best_m;
}

std::vector<PathRun> split_into_runs(const std::vector<PathPoint>& points,
                                     const SteeredPoint& steered) {
  std::vector<PathRun> runs;
  std::vector<PathRun::Knot> knots;
  for (std::size_t i = 0; i < points.size(); ++i) {
    add_knot(points[i], steered, knots);
    const bool last = i + 1 == points.size();
    const bool changes_direction = i > 0 && points[i].reverse != points[i - 1].reverse;
    if (!changes_direction && !last) continue;
    const bool reverse = points[i == 0 ? 0 : i - 1].reverse;
    if (knots.size() > 1 || (last && runs.empty())) runs.emplace_back(std::move(knots), reverse);
    knots.clear();
    add_knot(points[i], steered, knots);
  }
  return runs;
}

PathRun blended(const PathRun& run, double blend_m, double wide_m, double clearance_m) {
  const auto segments = static_cast<std::size_t>(std::ceil(run.length_m() / kKnotSpacingM));
  const std::vector<double> windows = windows_m(run, segments, blend_m, wide_m, clearance_m);
  std::vector<PathRun::Knot> knots;
  for (std::size_t i = 0; i <= segments; ++i) {
    const double s_m = segments > 0
                           ? run.length_m() * static_cast<double>(i) / static_cast<double>(segments)
                           : 0.0;
    const double half_m = std::min({windows[i] / 2.0, s_m, run.length_m() - s_m});
    PathRun::Knot knot{0.0, mean_pose(run, s_m, half_m), run.clearance_m(s_m)};
    if (i > 0) {
      const Pose2& last = knots.back().T_odom_steered;
      knot.s_m = knots.back().s_m + (knot.T_odom_steered.translation() - last.translation()).norm();
    }
    knots.push_back(knot);
  }
  return {std::move(knots), run.direction() < 0.0};
}

PathProgress::PathProgress(std::vector<PathRun> runs) : runs_(std::move(runs)) {}

void PathProgress::advance(const Pose2& T_odom_steered) {
  const double to_m = std::min(s_m_ + kSearchAheadM, run().length_m());
  s_m_ = run().nearest_s_m(T_odom_steered.translation(), s_m_, to_m);
}

bool PathProgress::begin_next_run() {
  if (run_ + 1 == runs_.size()) return false;
  completed_runs_m_ += run().length_m();
  ++run_;
  s_m_ = 0.0;
  return true;
}

double PathProgress::remaining_m() const {
  double remaining = run_remaining_m();
  for (std::size_t i = run_ + 1; i < runs_.size(); ++i) remaining += runs_[i].length_m();
  return remaining;
}

PathTrackingError PathProgress::error(const Pose2& T_odom_steered) const {
  const Pose2 T_path_steered = between(run().at(s_m_), T_odom_steered);
  return {T_path_steered.y, T_path_steered.theta};
}

double PathProgress::distance_m(const Pose2& T_odom_steered) const {
  return (run().at(s_m_).translation() - T_odom_steered.translation()).norm();
}

}  // namespace adit
