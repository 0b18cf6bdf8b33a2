// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/normal_equations.hpp"

#include <cmath>
#include <numeric>

namespace adit {
namespace {

/// Disjoint sets of linked nodes, each represented by its smallest member.
class LinkedSets {
 public:
  explicit LinkedSets(std::size_t nodes) : parent_(nodes) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  std::size_t smallest(std::size_t node) {
    while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
    return node;
  }
  void link(std::size_t a, std::size_t b) {
    a = smallest(a);
    b = smallest(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

GraphStructure analyse(const PoseGraph& graph) {
  GraphStructure structure;
  structure.pattern.blocks = static_cast<int>(graph.poses.size()) - 1;
  for (const PoseConstraint& c : graph.constraints) {
    const bool with_fixed = c.from == 0 || c.to == 0;
    structure.pair_of_constraint.push_back(
        with_fixed ? -1 : static_cast<int>(structure.pattern.pairs.size()));
    if (!with_fixed) structure.pattern.pairs.push_back({c.from - 1, c.to - 1});
  }
  structure.ordering = order_blocks(structure.pattern);
  return structure;
}

std::optional<int> first_unconnected_node(const PoseGraph& graph) {
  LinkedSets sets(graph.poses.size());
  for (const PoseConstraint& c : graph.constraints) {
    sets.link(static_cast<std::size_t>(c.from), static_cast<std::size_t>(c.to));
  }
  for (std::size_t node = 0; node < graph.poses.size(); ++node) {
    if (sets.smallest(node) != 0) return static_cast<int>(node);
  }
  return std::nullopt;
}

namespace {

Eigen::Vector2d measured_lever(const PoseConstraint& c, const Pose2& T_map_from) {
  const double cos_from = std::cos(T_map_from.theta);
  const double sin_from = std::sin(T_map_from.theta);
  const Eigen::Vector2d d(cos_from * c.T_from_to.x - sin_from * c.T_from_to.y,
                          sin_from * c.T_from_to.x + cos_from * c.T_from_to.y);
  return {-d.y(), d.x()};
}

/// −Jᵀ R e; J_from = −J_to M.
void add_to_b(const PoseConstraint& c, const LinearPotential& potential,
              const Eigen::Vector3d& weighted, Eigen::VectorXd& b) {
  Eigen::Vector3d g = potential.J_to.transpose() * weighted;
  if (c.to != 0) b.segment<3>(row_of(c.to)) -= g;
  if (c.from == 0) return;
  g.z() += potential.lever.dot(g.head<2>());
  b.segment<3>(row_of(c.from)) += g;
}

}  // namespace

NormalEquations::NormalEquations(const GraphStructure& structure)
    : pair_of_constraint_(structure.pair_of_constraint),
      H_(structure.pattern, structure.ordering, 3),
      b_(Eigen::VectorXd::Zero(row_of(structure.pattern.blocks + 1))) {}

double NormalEquations::linearise(const PoseGraph& graph) {
  H_.set_zero();
  return accumulate<Matrix::kFirstOrder>(graph);
}

double NormalEquations::linearise_with_curvature(const PoseGraph& graph, double share) {
  curvature_share_ = share;
  H_.set_zero();
  return accumulate<Matrix::kSecondOrder>(graph);
}

double NormalEquations::linearise_at_measurements(const PoseGraph& graph) {
  H_.set_zero();
  return accumulate<Matrix::kAtMeasurements>(graph);
}

double NormalEquations::linearise_gradient(const PoseGraph& graph) { return gradient(graph, b_); }

template <NormalEquations::Matrix kMatrix>
double NormalEquations::accumulate(const PoseGraph& graph) {
  b_.setZero();
  double sum = 0.0;
  for (std::size_t i = 0; i < graph.constraints.size(); ++i) {
    const PoseConstraint& c = graph.constraints[i];
    const Pose2& T_map_from = graph.poses[static_cast<std::size_t>(c.from)];
    LinearPotential potential =
        adit::linearise(c, T_map_from, graph.poses[static_cast<std::size_t>(c.to)]);
    if constexpr (kMatrix == Matrix::kAtMeasurements) {
      potential.lever = measured_lever(c, T_map_from);
    }
    const Eigen::Vector3d weighted = c.information * potential.e;
    sum += potential.e.dot(weighted);
    add_to_b(c, potential, weighted, b_);
    add_to_matrix(c, pair_of_constraint_[i], potential);
    if constexpr (kMatrix == Matrix::kSecondOrder) {
      add_curvature(c, pair_of_constraint_[i], potential, weighted);
    }
  }
  return sum;
}

void NormalEquations::add_to_matrix(const PoseConstraint& c, int pair,
                                    const LinearPotential& potential) {
  const ConstraintHessian H = hessian(c, potential);
  if (c.to != 0) H_.add_to_diagonal<3>(c.to - 1, H.to);
  if (c.from == 0) return;
  if (pair >= 0) H_.add_to_pair<3>(pair, H.from_to);
  H_.add_to_diagonal<3>(c.from - 1, H.from);
}

/// The second derivatives of the residual, weighted. With g = J_toᵀ R e, the force on the position
/// of `to`, and d = t_to − t_from, they are −gᵀ d for the rotation of `from`, and S g for this
/// rotation and the position of `to`, its negative for that of `from`.
void NormalEquations::add_curvature(const PoseConstraint& c, int pair,
                                    const LinearPotential& potential,
                                    const Eigen::Vector3d& weighted) {
  if (c.from == 0) return;  // its rotation is fixed
  const Eigen::Vector2d g = curvature_share_ * (potential.J_to.transpose() * weighted).head<2>();
  const Eigen::Vector2d Sg(-g.y(), g.x());
  const Eigen::Vector2d d(potential.lever.y(), -potential.lever.x());  // −S (S d)
  Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
  own(2, 2) = -g.dot(d);
  own.topRightCorner<2, 1>() = -Sg;
  own.bottomLeftCorner<1, 2>() = -Sg.transpose();
  H_.add_to_diagonal<3>(c.from - 1, own);
  if (pair < 0) return;
  Eigen::Matrix3d mixed = Eigen::Matrix3d::Zero();
  mixed.bottomLeftCorner<1, 2>() = Sg.transpose();
  H_.add_to_pair<3>(pair, mixed);
}

ConstraintHessian hessian(const PoseConstraint& constraint, const LinearPotential& potential) {
  ConstraintHessian H;
  H.to = potential.J_to.transpose() * constraint.information * potential.J_to;
  Eigen::Matrix3d MtK = H.to;
  MtK.row(2) += potential.lever.transpose() * H.to.topRows<2>();
  H.from_to = -MtK;
  MtK.col(2) += MtK.leftCols<2>() * potential.lever;
  H.from = MtK;
  return H;
}

double gradient(const PoseGraph& graph, Eigen::VectorXd& b) {
  b.setZero(row_of(static_cast<int>(graph.poses.size())));
  double sum = 0.0;
  for (const PoseConstraint& c : graph.constraints) {
    const LinearPotential potential = linearise(c, graph.poses[static_cast<std::size_t>(c.from)],
                                                graph.poses[static_cast<std::size_t>(c.to)]);
    const Eigen::Vector3d weighted = c.information * potential.e;
    sum += potential.e.dot(weighted);
    add_to_b(c, potential, weighted, b);
  }
  return sum;
}

void move_poses(const Eigen::VectorXd& delta, std::vector<Pose2>& poses) {
  for (std::size_t i = 1; i < poses.size(); ++i) {
    poses[i] =
        Pose2::from_vector(poses[i].vector() + delta.segment<3>(row_of(static_cast<int>(i))));
  }
}

}  // namespace adit
