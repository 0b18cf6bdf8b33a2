// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/certified_optimum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include <Eigen/Eigenvalues>

#include "common/pose_graph/optimize.hpp"
#include "common/pose_graph/quadratic_relaxation.hpp"

namespace adit {
namespace {

constexpr double kGapMax = 0.01;  // largest gap that the shift of a certificate may cost
constexpr double kTolerance =
    1e-14;  // of the exact minimum: the certificate needs a stationary point
constexpr double kImplausible = 30.7;  // chi-square, 3 degrees of freedom, 1 − 1e-6
constexpr double kEscapeMin = 1e-6;    // step along a direction of negative curvature

using Complex = std::complex<double>;

/// The direction in C^k along which the orientations are largest, and the poses along it.
std::vector<Pose2> rounded(const LiftedPoses& X) {
  const Eigen::Index nodes = X.rows() / 4;
  const auto row = [&](Eigen::Index i) {
    return Eigen::RowVectorXcd(X.row(i).cast<Complex>() + Complex(0, 1) * X.row(i + 1));
  };
  Eigen::MatrixXcd gram = Eigen::MatrixXcd::Zero(X.cols(), X.cols());
  for (Eigen::Index i = 0; i < nodes; ++i) gram += row(4 * i + 2).adjoint() * row(4 * i + 2);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> eigen(gram);
  const Eigen::VectorXcd main = eigen.eigenvectors().col(X.cols() - 1);
  std::vector<Pose2> poses;
  for (Eigen::Index i = 0; i < nodes; ++i) {
    const Complex t = row(4 * i) * main;
    const Complex z = row(4 * i + 2) * main;
    poses.push_back({t.real(), t.imag(), std::arg(z)});
  }
  return poses;
}

class Certification {
 public:
  Certification(PoseGraph& graph, const CertifyParams& params)
      : graph_(graph), params_(params), relaxation_(graph) {
    certificate_.objective = objective(graph);
  }

  Certificate run() {
    if (!holds_at_poses()) {
      if (adopt(rounded(climb_staircase()))) holds_at_poses();
    }
    certificate_.is_global = certificate_.objective - certificate_.lower_bound <=
                             params_.gap_max * certificate_.objective + kTiny;
    return certificate_;
  }

 private:
  static constexpr double kTiny = 1e-9;  // of a chi-square

  /// Checks the certificate of the bound that is tight at the present poses.
  bool holds_at_poses() {
    if (!relaxation_.tighten_at(graph_)) return false;
    const LiftedPoses X = lifted(graph_.poses);
    return check(X, relaxation_.times(X)).holds;
  }

  /// The shift of the certificate costs a part of the gap; larger ones are tried where a smaller
  /// one is lost in rounding.
  CertificateCheck check(const LiftedPoses& X, const Eigen::MatrixXd& MX) {
    const Eigen::VectorXd lambda = multipliers(MX, X);
    CertificateCheck first;
    for (double gap = 0.5 * params_.gap_max; gap <= kGapMax; gap *= 10.0) {
      const double loss = gap * certificate_.objective + kTiny;
      CertificateCheck found = check_certificate(relaxation_, lambda, loss / relaxation_.nodes());
      if (found.holds) {
        const double bound = lambda.sum() + relaxation_.offset() - loss;
        certificate_.lower_bound = std::max(certificate_.lower_bound, bound);
        return found;
      }
      if (first.direction.size() == 0) first = std::move(found);
    }
    return first;
  }

  /// Solves the relaxation, one dimension after the other, until its certificate holds.
  LiftedPoses climb_staircase() {
    relaxation_.loosen();
    LiftedPoses X = lifted(graph_.poses);
    for (int rank = 1; rank <= params_.rank_max; ++rank) {
      X = descend(relaxation_, std::move(X), params_.iterations_max, params_.tolerance).X;
      certificate_.rank = rank;
      const CertificateCheck found = check(X, relaxation_.times(X));
      if (found.holds || found.direction.size() == 0) break;
      escape(X, found.direction);
    }
    return X;
  }

  /// Adds a dimension and leaves the saddle point along a direction of negative curvature.
  void escape(LiftedPoses& X, const Eigen::VectorXd& direction) const {
    const Eigen::MatrixXd MX = relaxation_.times(X);
    const double value = MX.cwiseProduct(X).sum();
    LiftedPoses best;
    for (double step = std::sqrt(static_cast<double>(X.rows())); step > kEscapeMin; step *= 0.5) {
      LiftedPoses moved(X.rows(), X.cols() + 1);
      moved << X, step * direction;
      normalize_orientations(moved);
      if (relaxation_.times(moved).cwiseProduct(moved).sum() < value) {
        best = std::move(moved);
        break;
      }
    }
    if (best.size() == 0) {
      best = LiftedPoses(X.rows(), X.cols() + 1);
      best << X, Eigen::VectorXd::Zero(X.rows());
    }
    X = std::move(best);
  }

  /// Minimises the objective from these poses, and keeps them if they are better.
  bool adopt(std::vector<Pose2> poses) {
    PoseGraph other{std::move(poses), graph_.constraints};
    const Pose2 T_move = graph_.poses.front() * other.poses.front().inverse();
    for (Pose2& pose : other.poses) pose = T_move * pose;
    OptimizeParams params;
    params.rotation_initialization = false;
    params.tolerance = kTolerance;
    const OptimizeResult result = optimize(other, params);
    if (!result.converged || result.objective >= certificate_.objective) return false;
    certificate_.objective = result.objective;
    certificate_.replaced = true;
    graph_.poses = std::move(other.poses);
    return true;
  }

  PoseGraph& graph_;
  CertifyParams params_;
  QuadraticRelaxation relaxation_;
  Certificate certificate_;
};

}  // namespace

Certificate certify(PoseGraph& graph, const CertifyParams& params) {
  if (graph.poses.size() < 2) return {objective(graph), objective(graph), true};
  return Certification(graph, params).run();
}

bool has_implausible_residual(const PoseGraph& graph) {
  return std::ranges::any_of(graph.constraints, [&](const PoseConstraint& c) {
    const auto pose = [&](int node) { return graph.poses[static_cast<std::size_t>(node)]; };
    return energy(c, residual(c, pose(c.from), pose(c.to))) > kImplausible;
  });
}

}  // namespace adit
