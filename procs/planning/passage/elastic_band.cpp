// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/passage/elastic_band.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace adit {
namespace {

constexpr double kSpacingM = 0.1;
constexpr int kSmoothings = 100;  // of the chain of cells: over half a metre
constexpr int kIterations = 40;
constexpr double kWidthMinM = 0.1;  // of the free width as a weight
constexpr double kConvergedM = 0.002;
constexpr double kShiftMaxM = 0.05;  // of a pose in an iteration
constexpr Eigen::Index kHeld = 2;    // points at the robot

/// Length of a line up to each of its points.
std::vector<double> lengths_of(const Polyline& line) {
  std::vector<double> s_m{0.0};
  for (std::size_t i = 1; i < line.size(); ++i)
    s_m.push_back(s_m.back() + (line[i] - line[i - 1]).norm());
  return s_m;
}

/// The line with points at equal distances, kSpacingM or less.
Polyline resampled(const Polyline& line) {
  const std::vector<double> s_m = lengths_of(line);
  const auto segments = static_cast<std::size_t>(std::max(1.0, std::ceil(s_m.back() / kSpacingM)));
  Polyline result;
  std::size_t k = 1;
  for (std::size_t i = 0; i <= segments; ++i) {
    const double s = s_m.back() * static_cast<double>(i) / static_cast<double>(segments);
    while (k + 1 < line.size() && s_m[k] < s) ++k;
    const double leg_m = s_m[k] - s_m[k - 1];
    const double share = leg_m > 0.0 ? std::clamp((s - s_m[k - 1]) / leg_m, 0.0, 1.0) : 0.0;
    result.push_back((1.0 - share) * line[k - 1] + share * line[k]);
  }
  return result;
}

Eigen::Vector2d tangent_at(const Polyline& line, std::size_t i) {
  const std::size_t before = i > 0 ? i - 1 : 0;
  const std::size_t after = std::min(i + 1, line.size() - 1);
  return (line[after] - line[before]).normalized();
}

}  // namespace

struct ElasticBand::NormalEquations {
  std::vector<Eigen::Triplet<double>> A;
  Eigen::VectorXd b;
  Polyline normals;
};

ElasticBand::ElasticBand(const Polyline& guide, const Pose2& T_level_leading,
                         const WallDistance& walls)
    : walls_(walls), T_level_leading_(T_level_leading), line_(resampled(guide)) {
  for (int i = 0; i < kSmoothings; ++i) {
    for (std::size_t k = 1; k + 1 < line_.size(); ++k)
      line_[k] = 0.5 * line_[k] + 0.25 * (line_[k - 1] + line_[k + 1]);
  }
  hold_start();
}

void ElasticBand::relax(double stiffness) {
  if (line_.size() < 5) return;
  for (int i = 0; i < kIterations && shift(stiffness) > kConvergedM; ++i) {
  }
}

Pose2 ElasticBand::pose_at(std::size_t i) const {
  const Eigen::Vector2d tangent = tangent_at(line_, i);
  return {line_[i].x(), line_[i].y(), std::atan2(tangent.y(), tangent.x())};
}

double ElasticBand::curvature_1_m(std::size_t i) const {
  if (i == 0 || i + 1 >= line_.size()) return 0.0;
  const Eigen::Vector2d before = line_[i] - line_[i - 1];
  const Eigen::Vector2d after = line_[i + 1] - line_[i];
  const double turn =
      std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
  return turn / (0.5 * (before.norm() + after.norm()));
}

std::vector<double> ElasticBand::lengths_m() const { return lengths_of(line_); }

/// Of displacements y along the normals that minimise
///   Σ w (y − m)² + stiffness Σ (κ + y'')²,
/// where m leads to the middle between the walls and w is one over half the free width.
ElasticBand::NormalEquations ElasticBand::normal_equations(double stiffness) const {
  const auto n = static_cast<Eigen::Index>(line_.size());
  const double step_m = (line_.back() - line_[line_.size() - 2]).norm();
  const std::array<double, 3> second{1.0 / (step_m * step_m), -2.0 / (step_m * step_m),
                                     1.0 / (step_m * step_m)};
  NormalEquations equations;
  equations.b = Eigen::VectorXd::Zero(n - kHeld);
  const auto add = [&](Eigen::Index row, Eigen::Index column, double value) {
    if (row >= kHeld && column >= kHeld)
      equations.A.emplace_back(row - kHeld, column - kHeld, value);
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Eigen::Vector2d tangent = tangent_at(line_, k);
    equations.normals.emplace_back(-tangent.y(), tangent.x());
    const WallDistance::Sides sides = walls_.sides(pose_at(k));
    const double middle_m = (sides.left_m - sides.right_m) / 2.0;
    const double weight = 1.0 / std::max(kWidthMinM, (sides.left_m + sides.right_m) / 2.0);
    add(i, i, weight);
    if (i >= kHeld) equations.b(i - kHeld) += weight * middle_m;
    if (i == 0 || i + 1 == n) continue;
    const double curvature = curvature_1_m(k);
    for (std::size_t row = 0; row < second.size(); ++row) {
      const Eigen::Index at = i - 1 + static_cast<Eigen::Index>(row);
      for (std::size_t column = 0; column < second.size(); ++column) {
        add(at, i - 1 + static_cast<Eigen::Index>(column),
            stiffness * second[row] * second[column]);
      }
      if (at >= kHeld) equations.b(at - kHeld) -= stiffness * second[row] * curvature;
    }
  }
  return equations;
}

/// One Gauss-Newton step; its matrix has five diagonals. Returns the largest displacement.
double ElasticBand::shift(double stiffness) {
  const NormalEquations equations = normal_equations(stiffness);
  const Eigen::Index n = equations.b.size();
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(equations.A.begin(), equations.A.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower,
                              Eigen::NaturalOrdering<int>>
      factors(A);
  const Eigen::VectorXd y = factors.solve(equations.b);
  double largest_m = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i + kHeld);
    const double by_m = std::clamp(y(i), -kShiftMaxM, kShiftMaxM);
    line_[k] += by_m * equations.normals[k];
    largest_m = std::max(largest_m, std::abs(by_m));
  }
  hold_start();
  return largest_m;
}

/// Points at equal distances, from the robot on along its heading.
void ElasticBand::hold_start() {
  line_ = resampled(line_);
  if (line_.size() < 2) return;
  const double step_m = (line_[1] - line_[0]).norm();
  line_[0] = T_level_leading_.translation();
  line_[1] = T_level_leading_ * Eigen::Vector2d(step_m, 0.0);
}

}  // namespace adit
