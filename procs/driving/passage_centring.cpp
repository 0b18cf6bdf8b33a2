// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/passage_centring.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include "common/geometry/pose2.hpp"

namespace adit {
namespace {

constexpr double kBesideM = 1.0;        // farther walls make no narrow passage
constexpr double kBinM = 0.1;           // of arc length
constexpr int kSmoothingBins = 3;       // to either side
constexpr double kSlopeM = 0.1;         // to either side
constexpr std::size_t kPointsMin = 20;  // on either wall
constexpr double kNearestShare = 0.02;  // of the points of a wall, nearer by their errors

int bin_of(double s_m) { return static_cast<int>(std::floor(s_m / kBinM)); }

/// The pose at an arc length, straight on before the begin of the run.
Pose2 pose_at(const PathRun& run, double s_m) {
  return s_m >= 0.0 ? run.at(s_m) : run.at(0.0) * Pose2{run.direction() * s_m, 0.0, 0.0};
}

}  // namespace

PassageCentring::PassageCentring(const Vehicle& vehicle, const PassageCentringParams& params)
    : params_(params),
      steered_(vehicle),
      half_width_m_(0.5 * vehicle.width_m),
      length_m_(vehicle.length_m) {}

void PassageCentring::add(const std::vector<Eigen::Vector2d>& p_odom, const PathRun& run,
                          double s_m) {
  add_window(p_odom, run, s_m + length_m_);
  add_window(p_odom, run, s_m - length_m_);
}

void PassageCentring::add_window(const std::vector<Eigen::Vector2d>& p_odom, const PathRun& run,
                                 double s_m) {
  const Pose2 T_path_odom = steered_.body(pose_at(run, s_m)).inverse();
  std::vector<double> left_m;
  std::vector<double> right_m;
  for (const Eigen::Vector2d& p : p_odom) {
    const Eigen::Vector2d p_path = T_path_odom * p;
    const bool is_beside = std::abs(p_path.x()) <= 0.5 * length_m_ &&
                           std::abs(p_path.y()) <= half_width_m_ + kBesideM;  // false for NaN
    if (is_beside) (p_path.y() > 0.0 ? left_m : right_m).push_back(std::abs(p_path.y()));
  }
  if (left_m.empty() && right_m.empty()) return;  // this laser does not look there
  const double left = clearance_m(left_m);
  const double right = clearance_m(right_m);
  const bool is_narrow = 0.5 * (left + right) < params_.clearance_m;
  Bin& bin = bins_[bin_of(s_m)];
  bin.sum_m += is_narrow
                   ? std::clamp(0.5 * (left - right), -params_.offset_max_m, params_.offset_max_m)
                   : 0.0;
  ++bin.count;
}

/// Distance of a wall from the flank of a vehicle on the path; infinity without a wall.
double PassageCentring::clearance_m(std::vector<double>& beside_m) const {
  if (beside_m.size() < kPointsMin) return std::numeric_limits<double>::infinity();
  const auto nearest = beside_m.begin() + static_cast<std::ptrdiff_t>(
                                              kNearestShare * static_cast<double>(beside_m.size()));
  std::nth_element(beside_m.begin(), nearest, beside_m.end());
  return *nearest - half_width_m_;
}

double PassageCentring::offset_m(double s_m) const {
  const int centre = bin_of(s_m);
  const double share = s_m / kBinM - centre - 0.5;  // of the distance to the next bin
  double sum_m = 0.0;
  for (int i = -kSmoothingBins - 1; i <= kSmoothingBins + 1; ++i) {
    const double weight = std::clamp(kSmoothingBins + 0.5 - std::abs(i - share), 0.0, 1.0);
    if (weight > 0.0) sum_m += weight * bin_offset_m(centre + i);
  }
  return sum_m / (2.0 * kSmoothingBins);
}

/// The mean of the bin, or interpolated between the nearest that were measured.
double PassageCentring::bin_offset_m(int bin) const {
  const auto mean_m = [](const Bin& measured) { return measured.sum_m / measured.count; };
  const auto after = bins_.lower_bound(bin);
  if (after == bins_.end()) return bins_.empty() ? 0.0 : mean_m(bins_.rbegin()->second);
  if (after->first == bin || after == bins_.begin()) return mean_m(after->second);
  const auto before = std::prev(after);
  const double share = static_cast<double>(bin - before->first) / (after->first - before->first);
  return std::lerp(mean_m(before->second), mean_m(after->second), share);
}

double PassageCentring::slope(double s_m) const {
  return (offset_m(s_m + kSlopeM) - offset_m(s_m - kSlopeM)) / (2.0 * kSlopeM);
}

}  // namespace adit
