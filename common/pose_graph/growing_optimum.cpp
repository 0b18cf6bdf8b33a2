// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/growing_optimum.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/SparseCore>

namespace adit {
namespace {

// Ratio of successive predicted decreases above which the factor is renewed.
constexpr double kSlow = 0.2;
// Share of a negligible decrease that conjugate gradients may leave.
constexpr double kLeft = 0.1;
constexpr double kGrowthMax = 0.1;   // of the poses since the factor was renewed
constexpr int kGradientsMax = 1000;  // iterations; safety limit

using SparseMatrix = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

int triple(int i) { return 3 * i; }

void append(Triplets& triplets, int row, int column, const Eigen::Matrix3d& M) {
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) triplets.emplace_back(triple(row) + r, triple(column) + c, M(r, c));
  }
}

SparseMatrix matrix(int rows, int columns, const Triplets& triplets) {
  SparseMatrix M(triple(rows), triple(columns));
  M.setFromTriplets(triplets.begin(), triplets.end());
  return M;
}

/// What added constraints contribute to the normal equations, linearised at the poses of a graph.
class AddedEquations {
 public:
  /// `first_new`: the first pose that the kept factor does not know.
  AddedEquations(std::span<const PoseConstraint> constraints, int first_new, int poses)
      : constraints_(constraints), first_new_(first_new), new_(poses - first_new) {
    BlockPattern pattern{new_, {}};
    for (const PoseConstraint& c : constraints) {
      for (const int node : {c.from, c.to}) touch(node);
      if (c.from >= first_new && c.to >= first_new)
        pattern.pairs.push_back({c.from - first_new, c.to - first_new});
    }
    if (new_ > 0) C_.emplace(pattern, order_blocks(pattern), 3);
  }

  /// False if the constraints leave new poses free to move while the others are held.
  [[nodiscard]] bool linearise(const PoseGraph& graph) {
    Triplets D;
    Triplets B;
    int pair = 0;
    if (C_) C_->set_zero();
    for (const PoseConstraint& c : constraints_) {
      const ConstraintHessian H =
          hessian(c, adit::linearise(c, graph.poses[static_cast<std::size_t>(c.from)],
                                     graph.poses[static_cast<std::size_t>(c.to)]));
      add_own(c.from, H.from, D);
      add_own(c.to, H.to, D);
      if (is_new(c.from) && is_new(c.to)) {
        C_->add_to_pair<3>(pair++, H.from_to);
      } else if (is_new(c.from)) {
        if (c.to != 0) append(B, c.from - first_new_, touched_.at(c.to), H.from_to);
      } else if (is_new(c.to)) {
        if (c.from != 0) append(B, c.to - first_new_, touched_.at(c.from), H.from_to.transpose());
      } else if (c.from != 0 && c.to != 0) {
        append(D, touched_.at(c.from), touched_.at(c.to), H.from_to);
        append(D, touched_.at(c.to), touched_.at(c.from), H.from_to.transpose());
      }
    }
    const auto touched = static_cast<int>(blocks_.size());
    D_ = matrix(touched, touched, D);
    B_ = matrix(new_, touched, B);
    return !C_ || C_->factorise();
  }

  /// Blocks of the kept factor with added constraints.
  [[nodiscard]] const std::vector<int>& blocks() const { return blocks_; }

  /// K x = (D − Bᵀ C⁻¹ B) x.
  [[nodiscard]] Eigen::VectorXd operator*(const Eigen::VectorXd& x) const {
    Eigen::VectorXd y = D_ * x;
    if (C_) y -= B_.transpose() * C_->solve(B_ * x);
    return y;
  }
  /// Bᵀ C⁻¹ b of the gradient of the new poses.
  [[nodiscard]] Eigen::VectorXd eliminated(const Eigen::VectorXd& b_new) const {
    if (!C_) return Eigen::VectorXd::Zero(D_.rows());
    return B_.transpose() * C_->solve(b_new);
  }
  /// The step of the new poses, from that of the touched ones.
  [[nodiscard]] Eigen::VectorXd step(const Eigen::VectorXd& b_new, const Eigen::VectorXd& x) const {
    if (!C_) return {};
    return C_->solve(b_new - B_ * x);
  }

 private:
  [[nodiscard]] bool is_new(int node) const { return node >= first_new_; }

  void touch(int node) {
    if (node == 0 || is_new(node)) return;
    if (touched_.emplace(node, static_cast<int>(blocks_.size())).second)
      blocks_.push_back(node - 1);
  }

  void add_own(int node, const Eigen::Matrix3d& M, Triplets& D) {
    if (is_new(node)) {
      C_->add_to_diagonal<3>(node - first_new_, M);
    } else if (node != 0) {
      append(D, touched_.at(node), touched_.at(node), M);
    }
  }

  std::span<const PoseConstraint> constraints_;
  int first_new_;
  int new_;
  std::unordered_map<int, int> touched_;  // index among blocks_ by pose
  std::vector<int> blocks_;
  std::optional<SparseCholesky> C_;  // empty without new poses
  SparseMatrix D_;
  SparseMatrix B_;
};

Eigen::VectorXd rows_of(const Eigen::VectorXd& v, const std::vector<int>& blocks) {
  Eigen::VectorXd part(triple(static_cast<int>(blocks.size())));
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    part.segment<3>(triple(static_cast<int>(i))) = v.segment<3>(triple(blocks[i]));
  }
  return part;
}

void add_to_rows(Eigen::VectorXd& v, const std::vector<int>& blocks, const Eigen::VectorXd& part) {
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    v.segment<3>(triple(blocks[i])) += part.segment<3>(triple(static_cast<int>(i)));
  }
}

/// The kept H with the poses as they have moved since: displacements count in the frame of each
/// pose, in which H changes only with poses relative to each other. With Q the rotations of the
/// poses since then, it is Q H Qᵀ.
class MovedMatrix {
 public:
  MovedMatrix(const SparseCholesky& H, const std::vector<Pose2>& then,
              const std::vector<Pose2>& now, std::vector<int> blocks)
      : H_(H), among_(H.among(std::move(blocks))) {
    for (std::size_t i = 1; i < then.size(); ++i) {
      turns_.emplace_back(Eigen::Rotation2Dd(now[i].theta - then[i].theta).toRotationMatrix());
    }
  }

  [[nodiscard]] Eigen::VectorXd solve(Eigen::VectorXd b) const {
    for (std::size_t i = 0; i < turns_.size(); ++i) turn(turns_[i].transpose(), i, b);
    Eigen::VectorXd x = H_.solve(b);
    for (std::size_t i = 0; i < turns_.size(); ++i) turn(turns_[i], i, x);
    return x;
  }

  /// The same among the blocks (SparseCholesky::solve_among).
  [[nodiscard]] Eigen::VectorXd solve_among(Eigen::VectorXd b) const {
    for (std::size_t i = 0; i < among_.blocks.size(); ++i) turn(turn_of(i).transpose(), i, b);
    Eigen::VectorXd x = H_.solve_among(among_, b);
    for (std::size_t i = 0; i < among_.blocks.size(); ++i) turn(turn_of(i), i, x);
    return x;
  }

 private:
  static void turn(const Eigen::Matrix2d& R, std::size_t block, Eigen::VectorXd& v) {
    const Eigen::Vector2d turned = R * v.segment<2>(triple(static_cast<int>(block)));
    v.segment<2>(triple(static_cast<int>(block))) = turned;
  }
  [[nodiscard]] const Eigen::Matrix2d& turn_of(std::size_t i) const {
    return turns_[static_cast<std::size_t>(among_.blocks[i])];
  }

  const SparseCholesky& H_;
  SparseCholesky::Among among_;
  std::vector<Eigen::Matrix2d> turns_;  // by block
};

/// The step δ of the complete system with the kept H. The energy that conjugate gradients leave is
/// at most rᵀ H⁻¹ r, as K ⪰ 0; they end where that is below `left`.
Eigen::VectorXd solve(const MovedMatrix& H, Eigen::Index kept, const AddedEquations& added,
                      const Eigen::VectorXd& b, double left) {
  const Eigen::VectorXd b_new = b.tail(b.size() - kept);
  Eigen::VectorXd b_kept = b.head(kept);
  add_to_rows(b_kept, added.blocks(), -added.eliminated(b_new));
  // x: of the touched poses; w: right-hand side of H whose solution is the step of the kept poses.
  Eigen::VectorXd x = rows_of(H.solve(b_kept), added.blocks());
  Eigen::VectorXd r = -(added * x);
  Eigen::VectorXd w = Eigen::VectorXd::Zero(x.size());
  Eigen::VectorXd z = H.solve_among(r);
  Eigen::VectorXd p = z;
  Eigen::VectorXd Hp = r;
  double rz = r.dot(z);
  for (int i = 0; i < kGradientsMax && rz > left; ++i) {
    const Eigen::VectorXd Sp = Hp + added * p;
    const double share = rz / p.dot(Sp);
    x += share * p;
    w += share * Hp;
    r -= share * Sp;
    z = H.solve_among(r);
    const double next = r.dot(z);
    p = z + next / rz * p;
    Hp = r + next / rz * Hp;
    rz = next;
  }
  add_to_rows(b_kept, added.blocks(), w);
  Eigen::VectorXd step(b.size());
  step << H.solve(b_kept), added.step(b_new, x);
  return step;
}

}  // namespace

GrowingOptimum::GrowingOptimum(PoseGraph graph, const OptimizeParams& params,
                               const OptimizeObserver& observer)
    : graph_(std::move(graph)), params_(params), first_(optimize(graph_, params, observer)) {
  if (first_.converged) keep_factor();
}

GrowingOptimum::~GrowingOptimum() = default;
GrowingOptimum::GrowingOptimum(GrowingOptimum&&) noexcept = default;
GrowingOptimum& GrowingOptimum::operator=(GrowingOptimum&&) noexcept = default;

void GrowingOptimum::keep_factor() {
  kept_.reset();
  kept_poses_ = graph_.poses;
  kept_constraints_ = graph_.constraints.size();
  if (kept_poses_.size() < 2) return;
  kept_ = std::make_unique<NormalEquations>(analyse(graph_));
  kept_->linearise(graph_);
  if (!kept_->matrix().factorise()) kept_.reset();
}

OptimizeResult GrowingOptimum::add(int poses, const std::vector<PoseConstraint>& constraints,
                                   const OptimizeObserver& observer) {
  const std::size_t poses_before = graph_.poses.size();
  const std::size_t constraints_before = graph_.constraints.size();
  const auto undo = [&] {
    graph_.poses.resize(poses_before);
    graph_.constraints.resize(constraints_before);
  };
  graph_.poses.resize(graph_.poses.size() + static_cast<std::size_t>(poses));
  graph_.constraints.insert(graph_.constraints.end(), constraints.begin(), constraints.end());
  OptimizeResult result;
  if (const auto node = first_unconnected_node(graph_)) {
    undo();
    result.reason = OptimizeReason::kUnconnected;
    result.node = *node;
    return result;
  }
  start_from_map(poses_before, constraints_before);
  const double growth = static_cast<double>(graph_.poses.size() - kept_poses_.size());
  const bool few = growth <= kGrowthMax * static_cast<double>(kept_poses_.size());
  if (kept_ && few && descend(result)) return result;
  const int steps = result.iterations;
  result = optimize(graph_, params_, observer);
  result.iterations += steps;
  if (result.reason == OptimizeReason::kUndetermined) undo();
  if (result.converged) keep_factor();
  return result;
}

/// Sets the new poses to the optimum of their constraints while the others are held.
void GrowingOptimum::start_from_map(std::size_t poses_before, std::size_t constraints_before) {
  const auto first = static_cast<int>(poses_before);
  PoseGraph run;
  run.poses.resize(1 + graph_.poses.size() - poses_before);
  for (std::size_t i = constraints_before; i < graph_.constraints.size(); ++i) {
    PoseConstraint c = graph_.constraints[i];
    if (c.from < first && c.to < first) continue;
    if (c.from >= first && c.to >= first) {
      c.from -= first - 1;
      c.to -= first - 1;
    } else {
      const bool forward = c.to >= first;
      const Pose2& T_map_known = graph_.poses[static_cast<std::size_t>(forward ? c.from : c.to)];
      c.T_from_to = T_map_known * (forward ? c.T_from_to : c.T_from_to.inverse());
      c.to = (forward ? c.to : c.from) - (first - 1);
      c.from = 0;
    }
    run.constraints.push_back(c);
  }
  optimize(run, {});
  std::copy(run.poses.begin() + 1, run.poses.end(),
            graph_.poses.begin() + static_cast<std::ptrdiff_t>(poses_before));
}

/// False if steps with the kept factor do not converge.
bool GrowingOptimum::descend(OptimizeResult& result) {
  AddedEquations added(std::span(graph_.constraints).subspan(kept_constraints_),
                       static_cast<int>(kept_poses_.size()), static_cast<int>(graph_.poses.size()));
  Eigen::VectorXd b;
  result.objective = gradient(graph_, b);
  double before = std::numeric_limits<double>::infinity();
  while (result.iterations < params_.iterations_max) {
    if (!added.linearise(graph_)) return false;
    const double negligible = params_.negligible_decrease(result.objective);
    const MovedMatrix H(kept_->matrix(), kept_poses_, graph_.poses, added.blocks());
    const Eigen::VectorXd step = solve(H, kept_->b().size(), added, b, kLeft * negligible);
    const double predicted = step.dot(b);
    const bool done = predicted <= negligible;
    if (!done && !(predicted <= kSlow * before)) return false;
    before = predicted;
    std::vector<Pose2> poses = graph_.poses;
    move_poses(step, graph_.poses);
    const double objective = gradient(graph_, b);
    if (objective <= result.objective) {
      result.objective = objective;
      ++result.iterations;
    } else {
      graph_.poses = std::move(poses);
      if (!done) return false;
    }
    if (done) {
      result.converged = true;
      result.reason = OptimizeReason::kConverged;
      return true;
    }
  }
  return false;
}

}  // namespace adit
