// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/loop_closure/loop_closure_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/geometry/symmetric_eigen.hpp"

namespace adit {
namespace {

constexpr double kSquareM = 1.0;
constexpr std::int64_t kRow = std::int64_t{1} << 32;

Eigen::Vector2i square_of(const Eigen::Vector2d& p) {
  return (p / kSquareM).array().floor().cast<int>();
}

std::int64_t key_of(const Eigen::Vector2i& square) { return square.y() * kRow + square.x(); }

Eigen::Vector2i square_at(std::int64_t key) {
  const std::int64_t y = (key + kRow / 2) / kRow - ((key + kRow / 2) % kRow < 0 ? 1 : 0);
  return {static_cast<int>(key - y * kRow), static_cast<int>(y)};
}

void sort_unique(std::vector<std::int64_t>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

}  // namespace

MapExtent::MapExtent(const LocalWalls& walls) {
  for (const auto& point : walls.points) covered_.push_back(key_of(square_of(point.p)));
  sort_unique(covered_);
  for (const std::int64_t key : covered_) {
    const Eigen::Vector2d square = square_at(key).cast<double>();
    samples_.emplace_back((square + Eigen::Vector2d::Constant(0.5)) * kSquareM);
    centre_ += samples_.back();
  }
  if (samples_.empty()) return;
  centre_ /= static_cast<double>(samples_.size());
  for (const auto& sample : samples_) {
    radius_m_ = std::max(radius_m_, (sample - centre_).norm() + kSquareM);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        covered_.push_back(key_of(square_of(sample) + Eigen::Vector2i(dx, dy)));
      }
    }
  }
  sort_unique(covered_);
}

bool MapExtent::covers(const Eigen::Vector2d& p) const {
  return std::binary_search(covered_.begin(), covered_.end(), key_of(square_of(p)));
}

double MapExtent::covered_by(const std::vector<Placed>& others) const {
  if (samples_.empty()) return 0.0;
  std::vector<Pose2> T_other_this;
  for (const Placed& other : others) T_other_this.push_back(other.T_this_other.inverse());
  const auto covered = [&](const Eigen::Vector2d& p) {
    for (std::size_t k = 0; k < others.size(); ++k) {
      if (others[k].extent->covers(T_other_this[k] * p)) return true;
    }
    return false;
  };
  const auto count = std::count_if(samples_.begin(), samples_.end(), covered);
  return static_cast<double>(count) / static_cast<double>(samples_.size());
}

double MapExtent::overlap(const MapExtent& other, const Pose2& T_this_other) const {
  if (other.samples_.empty()) return 0.0;
  const double c = std::cos(T_this_other.theta);
  const double s = std::sin(T_this_other.theta);
  const auto inside = [&](const Eigen::Vector2d& p) {
    const Eigen::Vector2d q(c * p.x() - s * p.y() + T_this_other.x,
                            s * p.x() + c * p.y() + T_this_other.y);
    return covers(q);
  };
  const auto count = std::count_if(other.samples_.begin(), other.samples_.end(), inside);
  return static_cast<double>(count) / static_cast<double>(other.samples_.size());
}

namespace {

// Spacing of the sampled positions: a tunnel is a few metres wide.
constexpr double kStepM = 3.0;
constexpr int kStepsMin = 2;
constexpr int kStepsMax = 8;
constexpr double kRoundingUp = 1.0 + 1e-9;

/// The overlap of two maps over all relative positions within the gate.
struct Overlap {
  double expected = 0.0;
  double largest = 0.0;
};

Overlap overlap_in_gate(const MapExtent& older, const MapExtent& newest,
                        const RelativePose& predicted, double sigmas) {
  const Eigen::Matrix2d plane = predicted.covariance.topLeftCorner<2, 2>();
  const double radii = older.radius_m() + newest.radius_m();
  const double apart = (predicted.T_older_newer * newest.centre() - older.centre()).norm();
  Overlap overlap;
  // Most maps are far away, which the trace, an upper bound of the larger eigenvalue, shows
  // cheaply.
  if (apart > (radii + sigmas * std::sqrt(std::max(0.0, plane.trace()))) * kRoundingUp) {
    return overlap;
  }
  const SymmetricEigen<2> axes = symmetric_eigen(Eigen::Matrix2d(plane));
  const Eigen::Vector2d sd = axes.values.cwiseMax(0.0).cwiseSqrt();
  if (apart > radii + sigmas * sd.maxCoeff()) return overlap;

  const auto steps = [&](double axis_sd) {  // in each direction of an axis of the gate
    return std::clamp(static_cast<int>(std::ceil(sigmas * axis_sd / kStepM)), kStepsMin, kStepsMax);
  };
  const int steps_x = steps(sd.x());
  const int steps_y = steps(sd.y());
  double weights = 0.0;
  for (int i = -steps_x; i <= steps_x; ++i) {
    for (int j = -steps_y; j <= steps_y; ++j) {
      const Eigen::Vector2d u(sigmas * i / steps_x, sigmas * j / steps_y);
      if (u.norm() > sigmas) continue;
      const Eigen::Vector2d off = axes.vectors * u.cwiseProduct(sd);
      const double share =
          older.overlap(newest, predicted.T_older_newer * Pose2{off.x(), off.y(), 0.0});
      const double weight = std::exp(-0.5 * u.squaredNorm());
      overlap.expected += weight * share;
      overlap.largest = std::max(overlap.largest, share);
      weights += weight;
    }
  }
  overlap.expected /= weights;
  return overlap;
}

}  // namespace

std::vector<LoopClosureCandidate> loop_closure_candidates(
    std::span<const Pose2> poses, std::span<const NearMap> near, std::span<const MapExtent> extents,
    const LoopClosureCandidatesParams& params) {
  const int newest = static_cast<int>(poses.size()) - 1;
  std::vector<LoopClosureCandidate> possible;
  for (const auto& [older, covariance] : near) {
    if (older >= newest - params.neighbours) break;
    const RelativePose predicted{between(poses[older], poses[newest]), covariance};
    const Overlap overlap =
        overlap_in_gate(extents[older], extents[newest], predicted, params.sigmas);
    if (overlap.largest < params.overlap_min) continue;
    possible.push_back({older, predicted, overlap.expected});
  }
  std::stable_sort(possible.begin(), possible.end(),
                   [](const auto& a, const auto& b) { return a.overlap > b.overlap; });

  std::vector<LoopClosureCandidate> chosen;
  for (const LoopClosureCandidate& candidate : possible) {
    if (static_cast<int>(chosen.size()) >= params.most) break;
    const auto close = [&](const LoopClosureCandidate& other) {
      return std::abs(other.older - candidate.older) < params.apart;
    };
    if (std::none_of(chosen.begin(), chosen.end(), close)) chosen.push_back(candidate);
  }
  return chosen;
}

std::vector<LoopClosureCandidate> thorough_candidates(std::span<const Pose2> poses,
                                                      std::span<const NearMap> near,
                                                      std::span<const MapExtent> extents,
                                                      const LoopClosureCandidatesParams& params) {
  constexpr int kMore = 4;
  LoopClosureCandidatesParams more = params;
  more.most *= kMore;
  std::vector<NearMap> wide(near.begin(), near.end());
  for (NearMap& map : wide) map.covariance *= kThoroughSds * kThoroughSds;
  std::vector<LoopClosureCandidate> found = loop_closure_candidates(poses, near, extents, more);
  for (const LoopClosureCandidate& candidate :
       loop_closure_candidates(poses, wide, extents, more)) {
    const bool is_found = std::ranges::any_of(
        found, [&](const LoopClosureCandidate& other) { return other.older == candidate.older; });
    if (!is_found) found.push_back(candidate);
  }
  return found;
}

}  // namespace adit
