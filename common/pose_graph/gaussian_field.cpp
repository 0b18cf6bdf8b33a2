// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/gaussian_field.hpp"

#include <stdexcept>

#include "common/geometry/symmetric_eigen.hpp"
#include "common/geometry/symmetric_solve.hpp"
#include "common/pose_graph/optimize.hpp"

namespace adit {
namespace {

/// Maximum share of the information on a relative pose that a removed constraint may have
/// contributed.
constexpr double kShareMax = 1.0 - 1e-9;

/// G with G Gᵀ = R, which may be singular.
Eigen::Matrix3d square_root(const Eigen::Matrix3d& R) {
  const SymmetricEigen<3> eigen = symmetric_eigen(R);
  return eigen.vectors * eigen.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

GraphStructure analyse_connected(const PoseGraph& graph) {
  if (graph.poses.size() < 2) throw std::runtime_error("a field needs at least two poses");
  if (const auto node = first_unconnected_node(graph)) {
    throw std::runtime_error(text(OptimizeReason::kUnconnected, *node));
  }
  return analyse(graph);
}

/// Constraints from which one recursion over the factor is cheaper than a path for each.
constexpr std::size_t kManyConstraints = 50;

/// The derivatives of T_from_to = T_map_from⁻¹ · T_map_to: those of a residual against the
/// identity.
LinearPotential relative_pose(const Pose2& T_map_from, const Pose2& T_map_to) {
  return linearise(PoseConstraint{}, T_map_from, T_map_to);
}

/// The blocks of two nodes, without node 0, which is fixed.
std::vector<int> blocks_of(int from, int to) {
  std::vector<int> blocks;
  if (from != 0) blocks.push_back(from - 1);
  if (to != 0) blocks.push_back(to - 1);
  return blocks;
}

/// The derivatives by these blocks, side by side.
Eigen::MatrixXd jacobian(const LinearPotential& potential, int from, int to) {
  Eigen::MatrixXd J(3, (from != 0 ? 3 : 0) + (to != 0 ? 3 : 0));
  if (from != 0) J.leftCols<3>() = potential.jacobian_from();
  if (to != 0) J.rightCols<3>() = potential.J_to;
  return J;
}

}  // namespace

GaussianField::GaussianField(const PoseGraph& graph)
    : poses_(graph.poses), equations_(analyse_connected(graph)) {
  objective_at_linearisation_ = equations_.linearise(graph);
  b_ = equations_.b();
  if (!equations_.matrix().factorise()) {
    throw std::runtime_error(
        text(OptimizeReason::kUndetermined, equations_.matrix().weakest_block() + 1));
  }
}

void GaussianField::add(const PoseConstraint& constraint) {
  const LinearPotential potential = linear(constraint);
  const Eigen::MatrixXd J = jacobian(potential, constraint.from, constraint.to);
  if (!equations_.matrix().update(blocks_of(constraint.from, constraint.to),
                                  J.transpose() * square_root(constraint.information))) {
    throw std::runtime_error("a constraint that is not finite");
  }
  change_sums(constraint, potential, 1.0);
}

bool GaussianField::remove(const PoseConstraint& constraint) {
  const LinearPotential potential = linear(constraint);
  const Eigen::MatrixXd J = jacobian(potential, constraint.from, constraint.to);
  const Eigen::MatrixXd C = J.transpose() * square_root(constraint.information);
  const std::vector<int> blocks = blocks_of(constraint.from, constraint.to);
  // H − C Cᵀ is positive definite iff I − Cᵀ H⁻¹ C is; checked first, since a failed downdate
  // destroys the factor.
  const Eigen::Matrix3d share = C.transpose() * equations_.matrix().inverse_among(blocks) * C;
  if (symmetric_eigen(share).values.maxCoeff() > kShareMax) return false;
  if (!equations_.matrix().downdate(blocks, C)) {
    throw std::runtime_error("the field is too ill-conditioned to remove a constraint");
  }
  change_sums(constraint, potential, -1.0);
  return true;
}

/// Updates right-hand side and objective, and invalidates the cached results.
void GaussianField::change_sums(const PoseConstraint& c, const LinearPotential& potential,
                                double sign) {
  const Eigen::Vector3d weighted = c.information * potential.e;
  if (c.from != 0) {
    b_.segment<3>(row_of(c.from)) -= sign * potential.jacobian_from().transpose() * weighted;
  }
  if (c.to != 0) b_.segment<3>(row_of(c.to)) -= sign * potential.J_to.transpose() * weighted;
  objective_at_linearisation_ += sign * potential.e.dot(weighted);
  was_changed_ = true;
  mode_.resize(0);
  marginals_.clear();
  among_.clear();
}

LinearPotential GaussianField::linear(const PoseConstraint& c) const {
  return linearise(c, pose(c.from), pose(c.to));
}

const Pose2& GaussianField::pose(int node) const { return poses_[static_cast<std::size_t>(node)]; }

const Eigen::VectorXd& GaussianField::mode() const {
  if (mode_.size() == 0) mode_ = equations_.matrix().solve(b_);
  return mode_;
}

std::vector<Pose2> GaussianField::poses() const {
  std::vector<Pose2> moved = poses_;
  move_poses(mode(), moved);
  return moved;
}

double GaussianField::objective() const { return objective_at_linearisation_ - mode().dot(b_); }

/// A constraint linearised in the field.
struct GaussianField::ConstraintView {
  Eigen::MatrixXd J;  // by the blocks of its nodes
  Eigen::Vector3d d;  // residual at the mode
  Eigen::Matrix3d G;  // G Gᵀ = R, which may be singular
  std::vector<int> blocks;

  /// J A for a matrix A with a row for each row of the field.
  [[nodiscard]] Eigen::MatrixXd times(const Eigen::MatrixXd& A) const {
    Eigen::MatrixXd product = Eigen::MatrixXd::Zero(3, A.cols());
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      product += J.middleCols<3>(3 * static_cast<Eigen::Index>(i)) *
                 A.middleRows<3>(row_of(blocks[i] + 1));
    }
    return product;
  }
};

GaussianField::ConstraintView GaussianField::view_of(const PoseConstraint& c) const {
  const LinearPotential potential = linear(c);
  ConstraintView view{jacobian(potential, c.from, c.to), potential.e, square_root(c.information),
                      blocks_of(c.from, c.to)};
  view.d += view.times(mode());
  return view;
}

namespace {

/// dᵀ (Σ + R⁻¹)⁻¹ d with R = G Gᵀ.
double increase_of(const Eigen::Vector3d& d, const Eigen::Matrix3d& Sigma,
                   const Eigen::Matrix3d& G) {
  const Eigen::Vector3d Gd = G.transpose() * d;
  const Eigen::Matrix3d S = Eigen::Matrix3d::Identity() + G.transpose() * Sigma * G;
  return Gd.dot(solve_symmetric(S, Gd));
}

}  // namespace

/// Σ of the measured relative pose.
Eigen::Matrix3d GaussianField::covariance_of(const ConstraintView& view,
                                             const PoseConstraint& c) const {
  Eigen::MatrixXd& among = among_[{c.from, c.to}];
  if (among.size() == 0) among = equations_.matrix().inverse_among(view.blocks);
  return view.J * among * view.J.transpose();
}

double GaussianField::objective_increase(const PoseConstraint& c) const {
  const ConstraintView view = view_of(c);
  return increase_of(view.d, covariance_of(view, c), view.G);
}

Eigen::Matrix3d GaussianField::predicted_covariance(const PoseConstraint& c) const {
  return covariance_of(view_of(c), c);
}

/// The parts of H⁻¹ for constraints of the factorised matrix, all by one recursion.
void GaussianField::find_all_among(const std::vector<PoseConstraint>& present) const {
  std::vector<std::array<int, 2>> pairs;
  for (const PoseConstraint& c : present) {
    if (c.from != 0 && c.to != 0) pairs.push_back({c.from - 1, c.to - 1});
  }
  const SparseCholesky::SelectedInverse inverse = equations_.matrix().selected_inverse(pairs);
  const auto marginal = [&](int node) {
    return inverse.diagonal[static_cast<std::size_t>(node) - 1];
  };
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const int from = pairs[k][0] + 1;
    const int to = pairs[k][1] + 1;
    Eigen::MatrixXd& among = among_[{from, to}];
    among.resize(6, 6);
    among << marginal(from), inverse.pairs[k], inverse.pairs[k].transpose(), marginal(to);
  }
}

/// H⁻¹ Jᵀ of a constraint.
Eigen::MatrixXd GaussianField::columns_of(const ConstraintView& c) const {
  Eigen::MatrixXd columns(b_.size(), 3);
  for (int k = 0; k < 3; ++k) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(b_.size());
    for (std::size_t i = 0; i < c.blocks.size(); ++i) {
      row.segment<3>(row_of(c.blocks[i] + 1)) =
          c.J.block<1, 3>(k, 3 * static_cast<Eigen::Index>(i)).transpose();
    }
    columns.col(k) = equations_.matrix().solve(row);
  }
  return columns;
}

std::vector<double> GaussianField::couplings(const std::vector<PoseConstraint>& present,
                                             const PoseConstraint& query) const {
  const ConstraintView c = view_of(query);
  const Eigen::MatrixXd columns = columns_of(c);
  std::vector<double> couplings;
  for (const PoseConstraint& constraint : present) {
    const ConstraintView u = view_of(constraint);
    const Eigen::Vector3d shift = u.times(columns).transpose() * constraint.information * u.d;
    couplings.push_back((c.G.transpose() * shift).norm());
  }
  return couplings;
}

std::vector<GaussianField::LeaveOneOut> GaussianField::leave_one_out(
    const std::vector<PoseConstraint>& present, const PoseConstraint& query) const {
  const ConstraintView c = view_of(query);
  const Eigen::MatrixXd columns = columns_of(c);
  const Eigen::Matrix3d S_cc = c.times(columns);
  if (present.size() > kManyConstraints && !was_changed_) find_all_among(present);
  std::vector<LeaveOneOut> all;
  for (const PoseConstraint& constraint : present) {
    const ConstraintView u = view_of(constraint);
    // Removing u is adding it with −R: (R⁻¹ − S_uu)⁻¹ = G (I − Gᵀ S_uu G)⁻¹ Gᵀ.
    const Eigen::Matrix3d remaining =
        Eigen::Matrix3d::Identity() - u.G.transpose() * covariance_of(u, constraint) * u.G;
    const Eigen::Matrix3d W = u.G * solve_symmetric(remaining, Eigen::Matrix3d(u.G.transpose()));
    const Eigen::Matrix3d S_cu = u.times(columns).transpose();
    all.push_back({u.d.dot(W * u.d),
                   increase_of(c.d + S_cu * W * u.d, S_cc + S_cu * W * S_cu.transpose(), c.G)});
  }
  return all;
}

Eigen::Matrix3d GaussianField::relative_covariance(int from, int to) const {
  if (from == to) return Eigen::Matrix3d::Zero();
  const Eigen::MatrixXd J = jacobian(relative_pose(pose(from), pose(to)), from, to);
  return J * equations_.matrix().inverse_among(blocks_of(from, to)) * J.transpose();
}

std::vector<Eigen::Matrix3d> GaussianField::relative_covariances_to(int to) const {
  if (marginals_.empty()) marginals_ = equations_.matrix().inverse_diagonal();
  const auto marginal = [&](int node) -> Eigen::Matrix3d {
    if (node == 0) return Eigen::Matrix3d::Zero();
    return marginals_[static_cast<std::size_t>(node) - 1];
  };
  Eigen::MatrixXd columns;
  if (to != 0) columns = equations_.matrix().inverse_columns(to - 1);
  std::vector<Eigen::Matrix3d> covariances;
  for (int from = 0; from < static_cast<int>(poses_.size()); ++from) {
    const LinearPotential potential = relative_pose(pose(from), pose(to));
    const Eigen::Matrix3d J_from = potential.jacobian_from();
    Eigen::Matrix3d covariance = J_from * marginal(from) * J_from.transpose() +
                                 potential.J_to * marginal(to) * potential.J_to.transpose();
    if (from != 0 && to != 0) {
      const Eigen::Matrix3d cross =
          J_from * columns.middleRows<3>(row_of(from)) * potential.J_to.transpose();
      covariance += cross + cross.transpose();
    }
    covariances.push_back(from == to ? Eigen::Matrix3d::Zero() : covariance);
  }
  return covariances;
}

}  // namespace adit
