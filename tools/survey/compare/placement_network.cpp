// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/compare/placement_network.hpp"

#include <cstddef>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace adit {
namespace {

constexpr double kAgreementChi2 = 16.81;      // 99 %, six degrees of freedom
constexpr double kScaleStart = 400.0;         // of the variances of the registrations
constexpr double kScaleStep = 1.5;            // from pass to pass
constexpr int kPassesAtTheEnd = 5;            // with the variances as they are
constexpr double kRegistrationSdM = 0.005;    // what scans of one surface from two places share
constexpr double kRegistrationSdRad = 0.001;  // the same of their directions

/// Of a registration, with what its own information does not know: (I⁻¹ + F)⁻¹, where I may be
/// singular.
Matrix6d realistic(const Matrix6d& information) {
  Vector6d floor;
  floor << Eigen::Vector3d::Constant(kRegistrationSdM),
      Eigen::Vector3d::Constant(kRegistrationSdRad);
  const Matrix6d F = floor.cwiseAbs2().asDiagonal();
  const Matrix6d sum = Matrix6d::Identity() + F * information;
  const Matrix6d limited = information * sum.inverse();
  return 0.5 * (limited + limited.transpose());
}

/// Of a motion about one laser: the same motion about another one, `offset` from it.
Matrix6d transport(const Eigen::Vector3d& offset) {
  Matrix6d J = Matrix6d::Identity();
  J.topRightCorner<3, 3>() = -skew(offset);
  return J;
}

/// A chain of unknowns, each of which is tied to the one before: the normal equations are block
/// tridiagonal.
class Chain {
 public:
  explicit Chain(std::span<const ObservedPlacement> scans) : scans_(scans) {
    for (std::size_t i = 0; i < scans.size(); ++i) {
      information_.push_back(realistic(scans[i].information));
      if (i == 0) continue;
      to_next_.push_back(transport(scans[i].laser - scans[i - 1].laser));
      step_information_.push_back(scans[i].step_covariance.inverse());
    }
  }

  /// Weights of the registrations.
  void solve(std::span<const double> weights, std::vector<AdjustedPlacement>& placements) const {
    const std::size_t n = scans_.size();
    std::vector<Matrix6d> reduced(n);   // inverse of the diagonal block, those before eliminated
    std::vector<Matrix6d> coupling(n);  // block of i - 1 and i
    std::vector<Vector6d> right(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Matrix6d registration = weights[i] * information_[i];
      Matrix6d diagonal = registration + scans_[i].prior_information;
      right[i] = registration * scans_[i].registered;
      if (i + 1 < n) {
        const Matrix6d& J = to_next_[i];
        diagonal += J.transpose() * step_information_[i] * J;
      }
      if (i > 0) {
        diagonal += step_information_[i - 1];
        coupling[i] = -to_next_[i - 1].transpose() * step_information_[i - 1];
        const Matrix6d eliminated = coupling[i].transpose() * reduced[i - 1];
        diagonal -= eliminated * coupling[i];
        right[i] -= eliminated * right[i - 1];
      }
      reduced[i] = diagonal.inverse();
    }
    for (std::size_t i = n; i-- > 0;) {
      Vector6d known = right[i];
      placements[i].covariance = reduced[i];
      if (i + 1 < n) {
        const Matrix6d back = reduced[i] * coupling[i + 1];
        known -= coupling[i + 1] * placements[i + 1].motion;
        placements[i].covariance += back * placements[i + 1].covariance * back.transpose();
      }
      placements[i].motion = reduced[i] * known;
    }
  }

  /// Of the registration of a scan from a motion.
  [[nodiscard]] double chi2(std::size_t i, const Vector6d& motion) const {
    const Vector6d residual = scans_[i].registered - motion;
    return residual.dot(information_[i] * residual);
  }

 private:
  std::span<const ObservedPlacement> scans_;
  std::vector<Matrix6d> information_;
  std::vector<Matrix6d> to_next_;           // of the motion of scan i to scan i + 1
  std::vector<Matrix6d> step_information_;  // of that step
};

}  // namespace

std::vector<AdjustedPlacement> adjust_placements(std::span<const ObservedPlacement> scans) {
  const Chain chain(scans);
  std::vector<AdjustedPlacement> placements(scans.size());
  double scale = kScaleStart;
  std::vector<double> weights(scans.size(), 1.0 / scale);
  for (int at_the_end = 0; at_the_end < kPassesAtTheEnd;) {
    chain.solve(weights, placements);
    for (std::size_t i = 0; i < scans.size(); ++i) {
      const double chi2 = chain.chi2(i, placements[i].motion) / scale;
      const double kernel = kAgreementChi2 / (kAgreementChi2 + chi2);
      weights[i] = kernel * kernel / scale;
    }
    if (scale == 1.0) ++at_the_end;
    scale = std::max(1.0, scale / kScaleStep);
  }
  // What disagrees is not used at all, what agrees as it is.
  for (std::size_t i = 0; i < scans.size(); ++i) {
    placements[i].chi2 = chain.chi2(i, placements[i].motion);
    placements[i].agrees = !scans[i].information.isZero() && placements[i].chi2 < kAgreementChi2;
    weights[i] = placements[i].agrees ? 1.0 : 0.0;
  }
  chain.solve(weights, placements);
  return placements;
}

}  // namespace adit
