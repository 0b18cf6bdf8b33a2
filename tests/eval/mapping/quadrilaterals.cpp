// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/eval/mapping/quadrilaterals.hpp"

#include <cmath>
#include <optional>

#include <Eigen/LU>

namespace adit {
namespace {

/// A pose and the covariance of (x, y, θ) in its frame.
struct Leg {
  Pose2 T;
  Eigen::Matrix3d covariance;

  friend Leg operator*(const Leg& a, const Leg& b) {
    const Eigen::Matrix3d Ad = adjoint(b.T.inverse());
    return {a.T * b.T, Ad * a.covariance * Ad.transpose() + b.covariance};
  }

  [[nodiscard]] Leg inverse() const {
    const Eigen::Matrix3d Ad = adjoint(T);
    return {T.inverse(), Ad * covariance * Ad.transpose()};
  }
};

Leg displacement(const LocalMap& map) { return {map.T_previous_local, map.information.inverse()}; }

/// The best match of two maps, if it constrains all directions.
std::optional<Leg> match(const MappedRun& run, int older, int newer, const Pose2& expected,
                         const MapMatchingParams& params) {
  constexpr double kDeterminantMin = 1e3;  // of the information; sd of 0.1 m and 0.1 rad give 1e6
  const RelativePose predicted{expected, Eigen::Vector3d(0.09, 0.09, 0.01).asDiagonal()};
  const auto found =
      match_maps(*run.walls[newer], {{run.walls[older], {}}}, older, predicted, params);
  if (found.empty() || found.front().information.determinant() < kDeterminantMin)
    return std::nullopt;
  return Leg{found.front().T_older_newer, found.front().information.inverse()};
}

/// Compares the two paths from `older` to the map after `newer`: by `newer`, and by `side`, a
/// neighbour of `older`.
void add_gap(const MappedRun& run, int older, int newer, int side, const Pose2& T_older_newer,
             const MapMatchingParams& params, QuadrilateralGaps& gaps) {
  constexpr double kFarM = 3.0;
  const Leg along_newer = displacement(run.maps[newer + 1]);
  const Leg along_older =
      side > older ? displacement(run.maps[side]) : displacement(run.maps[older]).inverse();
  const Pose2 expected = along_older.T.inverse() * T_older_newer * along_newer.T;
  if (expected.translation().norm() > kFarM) return;
  const auto first = match(run, older, newer, T_older_newer, params);
  const auto second = match(run, side, newer + 1, expected, params);
  if (!first || !second) return;
  const Leg one = *first * along_newer;
  const Leg other = along_older * *second;
  const Eigen::Vector3d gap = between(one.T, other.T).vector();
  gaps.metres.push_back(gap.head<2>().norm());
  gaps.degrees.push_back(rad_to_deg(std::abs(gap.z())));
  gaps.normalised.push_back(gap.dot((one.covariance + other.covariance).inverse() * gap));
}

}  // namespace

QuadrilateralGaps close_quadrilaterals(const MappedRun& run, const MapMatchingParams& params) {
  constexpr int kNeighbours = 3;
  QuadrilateralGaps gaps;
  for (const auto& [pair, T_older_newer] : true_pairs(run)) {
    const auto [older, newer] = pair;
    if (newer + 1 >= static_cast<int>(run.maps.size())) continue;
    for (const int side : {older + 1, older - 1}) {
      if (side < 0 || newer + 1 - side < kNeighbours) continue;
      add_gap(run, older, newer, side, T_older_newer, params, gaps);
    }
  }
  return gaps;
}

}  // namespace adit
