// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/pose_graph/pose_graph.hpp"
#include "common/pose_graph/sparse_cholesky.hpp"

namespace adit {

/// Poses as points of a product of spheres: per node four rows, (x, y, cos θ, sin θ), and a column
/// per dimension of the relaxation. The lower two rows of each node have norm 1. With one column it
/// is a set of planar poses.
using LiftedPoses = Eigen::MatrixXd;

LiftedPoses lifted(const std::vector<Pose2>& poses);
/// Returns to the spheres after a step.
void normalize_orientations(LiftedPoses& X);

/// A quadratic form that is nowhere above the objective of a pose graph: tr(Xᵀ M X) + β (Rosen,
/// Carlone, Bandeira, Leonard, "SE-Sync", IJRR 2019; in the plane Carlone et al., "Planar pose
/// graph optimization: duality, optimal solutions, and verification", T-RO 2016).
///
/// The information of a constraint is split, R = diag(τ, τ, w) + N with N positive semidefinite.
/// The first part gives τ |t_to − t_from − R_from t|² + w θ². Of the second the form has the
/// tangent at a residual e₀, eᵀ N e ≥ 2 (N e₀)ᵀ e − e₀ᵀ N e₀, which is linear in the residual and
/// so of second degree in X. Its term of θ is joined to w θ² by completing the square, and the
/// square of the shifted angle ψ bounded by its chord: ψ² ≥ a (2 − 2 cos ψ) + b with equality at
/// ±ψ₀ for a = ψ₀ / sin ψ₀. The bound is tight, and has the gradient of the objective, at poses
/// whose residuals are the e₀. With e₀ = 0, `loosen`, N has no part.
class QuadraticRelaxation {
 public:
  explicit QuadraticRelaxation(const PoseGraph& graph);

  /// Makes the bound tight at the poses of the graph. False, without a change, if an angle residual
  /// is so large (150°) that no bound of this form is useful.
  bool tighten_at(const PoseGraph& graph);
  /// Undoes this: e₀ = 0.
  void loosen();

  [[nodiscard]] int nodes() const { return nodes_; }
  /// Constant part β of the bound.
  [[nodiscard]] double offset() const { return offset_; }
  /// Mean of the diagonal of M over the orientations: its scale.
  [[nodiscard]] double scale() const;

  /// M X.
  [[nodiscard]] Eigen::MatrixXd times(const LiftedPoses& X) const;
  /// M + diag(shift) of the rows of orientations, per node, to be factorised.
  [[nodiscard]] SparseCholesky shifted(const Eigen::VectorXd& shift) const;

 private:
  struct Term {
    int from;
    int to;
    double tau;
    double w;
    double theta;                    ///< measured rotation
    Eigen::Vector2d t;               ///< measured translation, in the frame of `from`
    Eigen::Matrix3d rest;            ///< N
    double weight = 0.0;             ///< a w
    double shift = 0.0;              ///< ψ − θ
    Eigen::Vector2d pull{0.0, 0.0};  ///< (N e₀) of x and y, in the frame of `from`
  };

  int nodes_;
  double offset_ = 0.0;
  std::vector<Term> terms_;
  BlockPattern pattern_;
  BlockOrdering ordering_;
};

/// The multipliers of the unit norms at a stationary point: tr(Λ) is the value of the form there.
Eigen::VectorXd multipliers(const Eigen::MatrixXd& MX, const LiftedPoses& X);

/// Whether M − Λ + η is positive semidefinite: then tr(Λ) − η n is a lower bound of the form over
/// all poses (weak duality). Otherwise a direction of negative curvature, of unit norm.
struct CertificateCheck {
  bool holds = false;
  Eigen::VectorXd direction;  ///< empty if it holds, or if the matrix is singular to rounding
};
CertificateCheck check_certificate(const QuadraticRelaxation& relaxation,
                                   const Eigen::VectorXd& lambda, double eta);

struct DescentResult {
  LiftedPoses X;
  double value = 0.0;  ///< tr(Xᵀ M X)
  int iterations = 0;
  bool converged = false;
};

/// A stationary point of the form over the product of spheres, by a Riemannian trust region with
/// truncated conjugate gradients (Absil, Baker, Gallivan, "Trust-region methods on Riemannian
/// manifolds", 2007), preconditioned by a factor of M. Converged where a step of steepest descent
/// predicts a relative decrease below `tolerance`.
DescentResult descend(const QuadraticRelaxation& relaxation, LiftedPoses start, int iterations_max,
                      double tolerance);

}  // namespace adit
