// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/closure_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <Eigen/Eigenvalues>

namespace adit {
namespace {

// Positions that are tried: a drift is a few metres wide.
constexpr double kStepM = 3.0;
constexpr int kStepsMin = 2;
constexpr int kStepsMax = 8;
constexpr double kRoundingUp = 1.0 + 1e-9;

/// What two maps may overlap, over all relative positions within the gate.
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
  // Most maps are far away, and the trace, an upper bound of the larger eigenvalue, says so.
  if (apart > (radii + sigmas * std::sqrt(std::max(0.0, plane.trace()))) * kRoundingUp) {
    return overlap;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(plane);
  const Eigen::Vector2d sd = axes.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  if (apart > radii + sigmas * sd.maxCoeff()) return overlap;

  const auto steps = [&](double axis_sd) {  // each way along an axis of the gate
    return std::clamp(static_cast<int>(std::ceil(sigmas * axis_sd / kStepM)), kStepsMin, kStepsMax);
  };
  const int steps_x = steps(sd.x());
  const int steps_y = steps(sd.y());
  double weights = 0.0;
  for (int i = -steps_x; i <= steps_x; ++i) {
    for (int j = -steps_y; j <= steps_y; ++j) {
      const Eigen::Vector2d u(sigmas * i / steps_x, sigmas * j / steps_y);
      if (u.norm() > sigmas) continue;
      const Eigen::Vector2d off = axes.eigenvectors() * u.cwiseProduct(sd);
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

std::vector<ClosureCandidate> closure_candidates(std::span<const Pose2> poses,
                                                 std::span<const Eigen::Matrix3d> covariances,
                                                 std::span<const MapExtent> extents,
                                                 const ClosureCandidatesParams& params) {
  const int newest = static_cast<int>(poses.size()) - 1;
  std::vector<ClosureCandidate> possible;
  for (int older = 0; older < newest - params.neighbours; ++older) {
    const RelativePose predicted{between(poses[older], poses[newest]), covariances[older]};
    const Overlap overlap =
        overlap_in_gate(extents[older], extents[newest], predicted, params.sigmas);
    if (overlap.largest < params.overlap_min) continue;
    possible.push_back({older, predicted, overlap.expected});
  }
  std::stable_sort(possible.begin(), possible.end(),
                   [](const auto& a, const auto& b) { return a.overlap > b.overlap; });

  std::vector<ClosureCandidate> chosen;
  for (const ClosureCandidate& candidate : possible) {
    if (static_cast<int>(chosen.size()) >= params.most) break;
    const auto close = [&](const ClosureCandidate& other) {
      return std::abs(other.older - candidate.older) < params.apart;
    };
    if (std::none_of(chosen.begin(), chosen.end(), close)) chosen.push_back(candidate);
  }
  return chosen;
}

}  // namespace adit
