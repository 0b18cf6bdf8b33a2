// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/quadratic_relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/geometry/pose2.hpp"
#include "common/geometry/symmetric_eigen.hpp"

namespace adit {
namespace {

constexpr double kAngleMax = 2.6;              // residual beyond which the bound is useless [rad]
constexpr double kPreconditionerShift = 1e-3;  // share of the scale
constexpr double kAcceptMin = 0.1;             // share of the predicted decrease
constexpr int kInnerMax = 200;

Eigen::Index row_of_node(int node) { return Eigen::Index{4} * node; }

/// Multiplication of a planar vector by the complex number x + i y.
Eigen::Matrix2d complex_factor(double x, double y) {
  return (Eigen::Matrix2d() << x, -y, y, x).finished();
}

/// The largest diag(τ, τ, w) of the shape of the diagonal that is nowhere above the information.
Eigen::Vector2d isotropic_part(const Eigen::Matrix3d& R) {
  const Eigen::Matrix2d translation = R.topLeftCorner<2, 2>();
  const double tau = std::max(symmetric_eigen(translation).values[0], 0.0);
  const double w = std::max(R(2, 2), 0.0);
  if (R.topRightCorner<2, 1>().isZero() || tau <= 0.0 || w <= 0.0) return {tau, w};
  const Eigen::Vector3d root = Eigen::Vector3d(tau, tau, w).cwiseSqrt().cwiseInverse();
  const Eigen::Matrix3d normalised = root.asDiagonal() * R * root.asDiagonal();
  const double share = std::max(symmetric_eigen(normalised).values[0], 0.0);
  return {share * tau, share * w};
}

Eigen::Vector3d residual_of(const PoseConstraint& c, const std::vector<Pose2>& poses) {
  return residual(c, poses[static_cast<std::size_t>(c.from)],
                  poses[static_cast<std::size_t>(c.to)]);
}

}  // namespace

LiftedPoses lifted(const std::vector<Pose2>& poses) {
  LiftedPoses X(row_of_node(static_cast<int>(poses.size())), 1);
  const Pose2 T_first_map = poses.empty() ? Pose2{} : poses.front().inverse();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose2 pose = T_first_map * poses[i];
    X.block<4, 1>(row_of_node(static_cast<int>(i)), 0) << pose.x, pose.y, std::cos(pose.theta),
        std::sin(pose.theta);
  }
  return X;
}

void normalize_orientations(LiftedPoses& X) {
  for (Eigen::Index i = 0; i < X.rows(); i += 4) {
    auto z = X.middleRows<2>(i + 2);
    z /= z.norm();
  }
}

QuadraticRelaxation::QuadraticRelaxation(const PoseGraph& graph)
    : nodes_(static_cast<int>(graph.poses.size())) {
  pattern_.blocks = nodes_;
  for (const PoseConstraint& c : graph.constraints) {
    const Eigen::Vector2d part = isotropic_part(c.information);
    const Eigen::Matrix3d core = Eigen::Vector3d(part[0], part[0], part[1]).asDiagonal();
    Term term{c.from,
              c.to,
              part[0],
              part[1],
              c.T_from_to.theta,
              c.T_from_to.translation(),
              c.information - core};
    terms_.push_back(term);
    pattern_.pairs.push_back({c.from, c.to});
  }
  ordering_ = order_blocks(pattern_);
  loosen();
}

bool QuadraticRelaxation::tighten_at(const PoseGraph& graph) {
  std::vector<Term> terms = terms_;
  double offset = 0.0;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const PoseConstraint& c = graph.constraints[i];
    Term& term = terms[i];
    const Eigen::Vector3d e = residual_of(c, graph.poses);
    const Eigen::Vector3d g = term.rest * e;
    term.shift = term.w > 0.0 ? g[2] / term.w : 0.0;
    const double psi = std::abs(e[2] + term.shift);
    if (psi > kAngleMax) return false;
    const double a = psi > 1e-6 ? psi / std::sin(psi) : 1.0;
    term.weight = a * term.w;
    const Eigen::Matrix2d R = complex_factor(std::cos(term.theta), std::sin(term.theta));
    term.pull = R * g.head<2>();
    offset += term.w * psi * psi - term.weight * (2.0 - 2.0 * std::cos(psi)) -
              term.w * term.shift * term.shift - e.dot(g) - 2.0 * term.pull.dot(term.t);
  }
  terms_ = std::move(terms);
  offset_ = offset;
  return true;
}

void QuadraticRelaxation::loosen() {
  for (Term& term : terms_) {
    term.weight = term.w;
    term.shift = 0.0;
    term.pull.setZero();
  }
  offset_ = 0.0;
}

double QuadraticRelaxation::scale() const {
  double sum = 0.0;
  for (const Term& term : terms_) {
    sum += 2.0 * term.weight + term.tau * term.t.squaredNorm();
  }
  return sum / std::max(nodes_, 1);
}

Eigen::MatrixXd QuadraticRelaxation::times(const LiftedPoses& X) const {
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(X.rows(), X.cols());
  product.topRows<2>() = X.topRows<2>();  // fixes the translation of node 0
  for (const Term& term : terms_) {
    const Eigen::Index from = row_of_node(term.from);
    const Eigen::Index to = row_of_node(term.to);
    const double c = std::cos(term.theta - term.shift);
    const double s = std::sin(term.theta - term.shift);
    const double q0 = term.pull.x();
    const double q1 = term.pull.y();
    for (Eigen::Index k = 0; k < X.cols(); ++k) {
      const double* x = X.data() + k * X.rows();
      double* out = product.data() + k * X.rows();
      const double z0 = x[from + 2];
      const double z1 = x[from + 3];
      const double d0 = x[to] - x[from];
      const double d1 = x[to + 1] - x[from + 1];
      const double e0 = term.tau * (d0 - term.t.x() * z0 + term.t.y() * z1);
      const double e1 = term.tau * (d1 - term.t.y() * z0 - term.t.x() * z1);
      const double r0 = term.weight * (x[to + 2] - c * z0 + s * z1);
      const double r1 = term.weight * (x[to + 3] - s * z0 - c * z1);
      const double p0 = e0 + q0 * z0 - q1 * z1;
      const double p1 = e1 + q1 * z0 + q0 * z1;
      out[to] += p0;
      out[to + 1] += p1;
      out[from] -= p0;
      out[from + 1] -= p1;
      out[to + 2] += r0;
      out[to + 3] += r1;
      out[from + 2] += q0 * d0 + q1 * d1 - term.t.x() * e0 - term.t.y() * e1 - c * r0 - s * r1;
      out[from + 3] += q0 * d1 - q1 * d0 + term.t.y() * e0 - term.t.x() * e1 + s * r0 - c * r1;
    }
  }
  return product;
}

SparseCholesky QuadraticRelaxation::shifted(const Eigen::VectorXd& shift) const {
  using Block = Eigen::Matrix4d;
  SparseCholesky A(pattern_, ordering_, 4);
  for (int i = 0; i < nodes_; ++i) {
    Block diagonal = Block::Zero();
    diagonal.diagonal().tail<2>().setConstant(shift[i]);
    if (i == 0) diagonal.diagonal().head<2>().setOnes();
    A.add_to_diagonal<4>(i, diagonal);
  }
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    const Term& term = terms_[k];
    const Eigen::Matrix2d P = complex_factor(term.t.x(), term.t.y());
    const Eigen::Matrix2d Q = complex_factor(term.pull.x(), term.pull.y());
    const double angle = term.theta - term.shift;
    const Eigen::Matrix2d C = complex_factor(std::cos(angle), std::sin(angle));
    Block from;
    from << term.tau * I, term.tau * P - Q, (term.tau * P - Q).transpose(),
        (term.tau * term.t.squaredNorm() + term.weight) * I;
    Block to = Block::Zero();
    to.diagonal() << term.tau, term.tau, term.weight, term.weight;
    Block cross;  // rows of `from`, columns of `to`
    cross << -term.tau * I, Eigen::Matrix2d::Zero(), (Q - term.tau * P).transpose(),
        -term.weight * C.transpose();
    A.add_to_diagonal<4>(term.from, from);
    A.add_to_diagonal<4>(term.to, to);
    A.add_to_pair<4>(static_cast<int>(k), cross);
  }
  return A;
}

Eigen::VectorXd multipliers(const Eigen::MatrixXd& MX, const LiftedPoses& X) {
  Eigen::VectorXd lambda(X.rows() / 4);
  for (Eigen::Index i = 0; i < lambda.size(); ++i) {
    lambda[i] = MX.middleRows<2>(4 * i + 2).cwiseProduct(X.middleRows<2>(4 * i + 2)).sum();
  }
  return lambda;
}

CertificateCheck check_certificate(const QuadraticRelaxation& relaxation,
                                   const Eigen::VectorXd& lambda, double eta) {
  SparseCholesky S = relaxation.shifted((eta - lambda.array()).matrix());
  if (S.factorise()) return {true, {}};
  Eigen::VectorXd direction = S.negative_curvature();
  if (direction.size() > 0) direction.normalize();
  return {false, std::move(direction)};
}

namespace {

/// The descent on the product of spheres.
class TrustRegion {
 public:
  TrustRegion(const QuadraticRelaxation& relaxation, LiftedPoses start, double tolerance)
      : relaxation_(relaxation),
        tolerance_(tolerance),
        preconditioner_(relaxation.shifted(Eigen::VectorXd::Constant(
            relaxation.nodes(), kPreconditionerShift * relaxation.scale()))),
        X_(std::move(start)) {
    has_preconditioner_ = preconditioner_.factorise();
    evaluate();
  }

  DescentResult run(int iterations_max) {
    DescentResult result;
    double radius = 0.0;
    while (has_preconditioner_ && result.iterations < iterations_max) {
      const Eigen::MatrixXd Pg = precondition(gradient_);
      const double expected = 0.5 * inner(gradient_, Pg);
      if (expected <= tolerance_ * (value_ + 1.0)) {
        result.converged = true;
        break;
      }
      if (radius == 0.0) radius = 10.0 * std::sqrt(2.0 * expected);
      const auto [step, predicted, at_boundary] = truncated_cg(radius);
      ++result.iterations;
      const double ratio = try_step(step, predicted);
      if (ratio < 0.25) radius *= 0.25;
      if (ratio > 0.75 && at_boundary) radius *= 2.0;
      if (radius < 1e-12) {
        result.converged = true;  // the remainder is rounding
        break;
      }
    }
    result.X = std::move(X_);
    result.value = value_;
    return result;
  }

 private:
  struct Step {
    Eigen::MatrixXd eta;
    double predicted = 0.0;
    bool at_boundary = false;
  };

  static double inner(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
    return A.cwiseProduct(B).sum();
  }

  void evaluate() {
    const Eigen::MatrixXd MX = relaxation_.times(X_);
    value_ = inner(MX, X_);
    lambda_ = multipliers(MX, X_);
    gradient_ = project(2.0 * MX);
  }

  /// Onto the tangent space: removes from each orientation the part along itself.
  [[nodiscard]] Eigen::MatrixXd project(Eigen::MatrixXd V) const {
    for (Eigen::Index i = 0; i < X_.rows(); i += 4) {
      const auto z = X_.middleRows<2>(i + 2);
      auto v = V.middleRows<2>(i + 2);
      v -= v.cwiseProduct(z).sum() * z;
    }
    return V;
  }

  [[nodiscard]] Eigen::MatrixXd hessian(const Eigen::MatrixXd& V) const {
    Eigen::MatrixXd HV = relaxation_.times(V);
    for (Eigen::Index i = 0; i < lambda_.size(); ++i) {
      HV.middleRows<2>(4 * i + 2) -= lambda_[i] * V.middleRows<2>(4 * i + 2);
    }
    return project(2.0 * HV);
  }

  [[nodiscard]] Eigen::MatrixXd precondition(const Eigen::MatrixXd& V) const {
    Eigen::MatrixXd result(V.rows(), V.cols());
    for (Eigen::Index k = 0; k < V.cols(); ++k) {
      result.col(k) = 0.5 * preconditioner_.solve(V.col(k));
    }
    return project(std::move(result));
  }

  /// Steihaug and Toint: conjugate gradients until the boundary, negative curvature or convergence.
  /// Norms are those of the preconditioner.
  [[nodiscard]] Step truncated_cg(double radius) const {
    Step step{Eigen::MatrixXd::Zero(X_.rows(), X_.cols())};
    Eigen::MatrixXd r = gradient_;
    Eigen::MatrixXd z = precondition(r);
    Eigen::MatrixXd d = -z;
    double rz = inner(r, z);
    const double rz_first = rz;
    double step_norm2 = 0.0;
    double step_d = 0.0;
    double d_norm2 = rz;
    Eigen::MatrixXd H_eta = step.eta;
    for (int i = 0; i < kInnerMax; ++i) {
      const Eigen::MatrixXd Hd = hessian(d);
      const double curvature = inner(d, Hd);
      const double alpha = curvature > 0.0 ? rz / curvature : 0.0;
      const double next_norm2 = step_norm2 + 2.0 * alpha * step_d + alpha * alpha * d_norm2;
      if (curvature <= 0.0 || next_norm2 >= radius * radius) {
        const double root = std::sqrt(step_d * step_d + d_norm2 * (radius * radius - step_norm2));
        const double to_boundary = (root - step_d) / d_norm2;
        step.eta += to_boundary * d;
        H_eta += to_boundary * Hd;
        step.at_boundary = true;
        break;
      }
      step.eta += alpha * d;
      H_eta += alpha * Hd;
      r += alpha * Hd;
      step_norm2 = next_norm2;
      z = precondition(r);
      const double rz_next = inner(r, z);
      // Superlinear convergence (Absil et al., section 3.2).
      if (rz_next <= rz_first * std::min(rz_first / (value_ + 1.0), 0.01)) break;
      const double beta = rz_next / rz;
      step_d = beta * (step_d + alpha * d_norm2);
      d_norm2 = rz_next + beta * beta * d_norm2;
      d = -z + beta * d;
      rz = rz_next;
    }
    step.predicted = -inner(gradient_, step.eta) - 0.5 * inner(step.eta, H_eta);
    return step;
  }

  /// Moves if the form decreases enough. Returns the ratio of the decrease to its prediction.
  double try_step(const Eigen::MatrixXd& eta, double predicted) {
    LiftedPoses before = X_;
    const double value_before = value_;
    X_ += eta;
    normalize_orientations(X_);
    evaluate();
    const double ratio = (value_before - value_) / predicted;
    if (ratio > kAcceptMin && predicted > 0.0) return ratio;
    X_ = std::move(before);
    evaluate();
    return 0.0;
  }

  const QuadraticRelaxation& relaxation_;
  double tolerance_;
  SparseCholesky preconditioner_;
  bool has_preconditioner_ = false;
  LiftedPoses X_;
  double value_ = 0.0;
  Eigen::VectorXd lambda_;
  Eigen::MatrixXd gradient_;
};

}  // namespace

DescentResult descend(const QuadraticRelaxation& relaxation, LiftedPoses start, int iterations_max,
                      double tolerance) {
  return TrustRegion(relaxation, std::move(start), tolerance).run(iterations_max);
}

}  // namespace adit
