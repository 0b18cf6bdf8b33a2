// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/finished_graph/loop_consensus.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "common/pose_graph/certified_optimum.hpp"
#include "common/pose_graph/gaussian_field.hpp"
#include "common/pose_graph/optimize.hpp"
#include "procs/mapping/association/association_problem.hpp"

namespace adit {
namespace {

constexpr int kNeighbourPoses = 10;     // apart along the odometry, at both ends
constexpr double kChiSquare99 = 11.34;  // three degrees of freedom
constexpr double kChanceOfFitMax = 0.01;
constexpr int kRoundsMax = 30;
constexpr int kSteps = 10;           // of the optimisation of a selection that is not yet settled
constexpr double kTolerance = 1e-3;  // of the same
constexpr int kRoundsUnsettled = 4;  // before groups that contradict each other are recognised
constexpr double kUnsettledRejectedMax = 0.15;  // of the supported loops
constexpr double kSupportedRejectedMax = 0.05;
constexpr int kHalvingsMax = 8;  // of the gate of a loop that was revoked
constexpr double kScaleMargin = 1.5;
constexpr double kScaleMin = 0.02;

/// Shares of a chi-square distribution with three degrees of freedom, and their quantiles.
constexpr std::array<std::array<double, 2>, 3> kQuantiles = {
    {{0.5, 2.366}, {0.9, 6.251}, {0.95, 7.815}}};

/// By how much the squared errors are smaller than the information claims: at most 1. Quantiles up
/// to 0.95, so that few wrong loops among the accepted ones do not count.
double scale_of(std::vector<double> chi_squares) {
  if (chi_squares.empty()) return 1.0;
  std::ranges::sort(chi_squares);
  double scale = kScaleMin;
  for (const auto& [share, quantile] : kQuantiles) {
    const double index = share * static_cast<double>(chi_squares.size() - 1);
    scale = std::max(scale, kScaleMargin * chi_squares[static_cast<std::size_t>(index)] / quantile);
  }
  return std::min(scale, 1.0);
}

/// The covariance of a residual with respect to the map without the constraint; nothing if only the
/// constraint determines it.
std::optional<Eigen::Matrix3d> covariance_without(const Eigen::Matrix3d& covariance_with,
                                                  const Eigen::Matrix3d& information) {
  const Eigen::Matrix3d others = covariance_with.inverse() - information;
  if (Eigen::LLT<Eigen::Matrix3d>(others).info() != Eigen::Success) return std::nullopt;
  return others.inverse();
}

class ConsensusSearch {
 public:
  ConsensusSearch(const PoseGraph& graph, const GraphOdometry& odometry, double gate)
      : graph_(graph),
        odometry_(odometry),
        gate_(gate),
        gate_at_scale_(gate),
        map_{graph.poses, {}} {
    chain_.add_map({});
    for (const UncertainPose& step : odometry.steps) chain_.add_map(step);
    find_support();
    accepted_ = supported_;
    revoked_.assign(accepted_.size(), 0);
  }

  std::optional<LoopConsensus> run() {
    const bool has_support = std::ranges::find(supported_, true) != supported_.end();
    if (!has_support && !supported_.empty()) return std::nullopt;
    for (int round = 0; round < kRoundsMax; ++round) {
      optimise(round == 0);
      std::vector<bool> next = fitting();
      const double rejected = supported_rejected(next);
      if (round >= kRoundsUnsettled && rejected > kUnsettledRejectedMax) return std::nullopt;
      const bool settled = next == accepted_;
      accepted_ = std::move(next);
      if (!settled || improve()) continue;
      if (rejected > kSupportedRejectedMax) return std::nullopt;
      return result();
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] const PoseConstraint& loop(std::size_t i) const {
    return graph_.constraints[as_index(odometry_.loops[i])];
  }

  /// Finds the loops that more neighbours support than contradict.
  void find_support() {
    std::vector<PoseConstraint> loops;
    for (std::size_t i = 0; i < odometry_.loops.size(); ++i) loops.push_back(forward(loop(i)));
    std::vector<int> balance(loops.size(), 0);
    for (std::size_t a = 0; a < loops.size(); ++a) {
      for (std::size_t b = a + 1; b < loops.size(); ++b) {
        if (loops[b].to - loops[a].to > kNeighbourPoses) break;
        if (std::abs(loops[a].from - loops[b].from) > kNeighbourPoses) continue;
        const int support = support_between(loops[a], loops[b]);
        balance[a] += support;
        balance[b] += support;
      }
    }
    for (const int sum : balance) supported_.push_back(sum > 0);
  }

  /// 1 if they support each other, −1 if they contradict each other, else 0.
  [[nodiscard]] int support_between(const PoseConstraint& a, const PoseConstraint& b) const {
    const CycleResidual cycle = cycle_residual(chain_, a, b);
    if (cycle.disagreement > kChiSquare99) return -1;
    return chance(cycle.covariance, kChiSquare99) < kChanceOfFitMax ? 1 : 0;
  }

  [[nodiscard]] double chance(const Eigen::Matrix3d& covariance, double gate) const {
    return chance_of_fit(covariance, gate, chain_.area_m2());
  }

  /// Moves the map to the optimum under the accepted loops.
  void optimise(bool from_scratch) {
    map_.constraints.clear();
    std::vector<bool> is_left_out(graph_.constraints.size(), false);
    for (std::size_t i = 0; i < accepted_.size(); ++i) {
      is_left_out[as_index(odometry_.loops[i])] = !accepted_[i];
    }
    for (const int k : odometry_.bridges) is_left_out[as_index(k)] = true;
    for (std::size_t k = 0; k < is_left_out.size(); ++k) {
      if (!is_left_out[k]) map_.constraints.push_back(graph_.constraints[k]);
    }
    // With some information in each direction: the odometry and they determine all poses.
    for (const int k : odometry_.bridges) {
      PoseConstraint bridge = graph_.constraints[as_index(k)];
      bridge.information = measured_by(bridge).covariance.inverse();
      map_.constraints.push_back(bridge);
    }
    OptimizeParams params;
    params.rotation_initialization = from_scratch;
    params.tolerance = kTolerance;
    params.iterations_max = kSteps;
    optimize(map_, params);
  }

  /// Whether each loop is accepted at the map.
  [[nodiscard]] std::vector<bool> fitting() {
    std::vector<std::size_t> present;
    std::vector<PoseConstraint> constraints;
    for (std::size_t i = 0; i < accepted_.size(); ++i) {
      if (!accepted_[i]) continue;
      present.push_back(i);
      constraints.push_back(loop(i));
    }
    std::vector<bool> next = accepted_;
    if (present.empty()) return next;
    const GaussianField field(map_);
    const auto without = field.leave_one_out(constraints, constraints.front());
    std::vector<double> decreases;
    for (const auto& one : without) decreases.push_back(one.objective_decrease);
    const double gate = gate_ * scale_of(std::move(decreases));
    gate_at_scale_ = gate;
    for (std::size_t k = 0; k < present.size(); ++k) {
      const std::size_t i = present[k];
      const bool fits = without[k].objective_decrease <= gate;
      if (!fits) ++revoked_[i];
      next[i] = fits && is_evident_without(field, loop(i), gate);
    }
    for (std::size_t i = 0; i < accepted_.size(); ++i) {
      if (accepted_[i]) continue;
      // Half the gate for each time that it was revoked: the selection settles.
      const double limit = gate / (1 << std::min(revoked_[i], kHalvingsMax));
      next[i] = field.objective_increase(loop(i)) < limit &&
                is_evident(field.predicted_covariance(loop(i)), loop(i), gate);
    }
    return next;
  }

  [[nodiscard]] bool is_evident(const Eigen::Matrix3d& covariance, const PoseConstraint& c,
                                double gate) const {
    return chance(covariance + measured_by(c).covariance, gate) < kChanceOfFitMax;
  }

  [[nodiscard]] bool is_evident_without(const GaussianField& field, const PoseConstraint& c,
                                        double gate) const {
    const auto covariance = covariance_without(field.predicted_covariance(c), c.information);
    return covariance && is_evident(*covariance, c, gate);
  }

  /// The share of the supported loops that is rejected.
  [[nodiscard]] double supported_rejected(const std::vector<bool>& accepted) const {
    int supported = 0;
    int rejected = 0;
    for (std::size_t i = 0; i < accepted.size(); ++i) {
      supported += supported_[i] ? 1 : 0;
      rejected += supported_[i] && !accepted[i] ? 1 : 0;
    }
    return static_cast<double>(rejected) / std::max(supported, 1);
  }

  /// Moves the map to the global optimum. Whether it was another one.
  bool improve() {
    OptimizeParams exact;
    exact.rotation_initialization = false;
    exact.tolerance = 1e-14;  // a certificate needs a stationary point
    optimize(map_, exact);
    CertifyParams params;
    params.rank_max = 3;
    params.tolerance = 1e-4;  // a better start for the optimisation
    const Certificate certificate = certify(map_, params);
    is_certified_ = certificate.is_global;
    return certificate.replaced;
  }

  /// The accepted loops in groups: those of different groups are apart along the odometry.
  [[nodiscard]] std::vector<std::vector<std::size_t>> groups_of_accepted() const {
    std::vector<std::vector<std::size_t>> groups(accepted_.size());
    std::vector<std::size_t> group_of(accepted_.size());
    for (std::size_t b = 0; b < accepted_.size(); ++b) {
      if (!accepted_[b]) continue;
      group_of[b] = b;
      groups[b] = {b};
      const PoseConstraint newer = forward(loop(b));
      for (std::size_t a = b; a-- > 0;) {
        const PoseConstraint older = forward(loop(a));
        if (newer.to - older.to > kNeighbourPoses) break;
        if (!accepted_[a] || std::abs(older.from - newer.from) > kNeighbourPoses) continue;
        std::size_t less = group_of[a];
        std::size_t more = group_of[b];
        if (less == more) continue;
        if (groups[less].size() > groups[more].size()) std::swap(less, more);
        for (const std::size_t i : groups[less]) group_of[i] = more;
        groups[more].insert(groups[more].end(), groups[less].begin(), groups[less].end());
        groups[less].clear();
      }
    }
    std::erase_if(groups, [](const auto& group) { return group.size() < 2; });
    return groups;
  }

  /// Whether an accepted loop does not fit the map without its group. Wrong loops that agree with
  /// each other each fit only with the others.
  [[nodiscard]] bool has_contradiction() const {
    const auto groups = groups_of_accepted();
    if (groups.empty()) return false;
    GaussianField field(map_);
    for (const auto& group : groups) {
      std::vector<PoseConstraint> removed;
      for (const std::size_t i : group) {
        if (field.remove(loop(i))) removed.push_back(loop(i));
      }
      for (const PoseConstraint& c : removed) {
        if (field.objective_increase(c) > gate_at_scale_) return true;
      }
      for (const PoseConstraint& c : removed) field.add(c);
    }
    return false;
  }

  [[nodiscard]] LoopConsensus result() const {
    LoopConsensus consensus{std::vector<bool>(graph_.constraints.size(), true), map_.poses,
                            is_certified_, has_contradiction()};
    for (std::size_t i = 0; i < accepted_.size(); ++i) {
      consensus.accepted[as_index(odometry_.loops[i])] = accepted_[i];
    }
    return consensus;
  }

  const PoseGraph& graph_;
  const GraphOdometry& odometry_;
  double gate_;
  double gate_at_scale_;  // by the errors of the accepted loops
  OdometryChain chain_;
  std::vector<bool> supported_;  // of each loop of the odometry's list, as the following
  std::vector<bool> accepted_;
  std::vector<int> revoked_;  // how often
  PoseGraph map_;             // with the accepted constraints
  bool is_certified_ = false;
};

}  // namespace

bool loses_heading(const GraphOdometry& odometry) {
  double variance = 0.0;
  for (const UncertainPose& step : odometry.steps) variance += step.covariance(2, 2);
  // A step without any information has no optimum, which the search for it reports.
  return std::isfinite(variance) && variance > std::numbers::pi * std::numbers::pi;
}

std::optional<LoopConsensus> find_consensus(const PoseGraph& graph, const GraphOdometry& odometry,
                                            double gate) {
  return ConsensusSearch(graph, odometry, gate).run();
}

}  // namespace adit
