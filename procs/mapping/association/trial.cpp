// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/trial.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include "common/pose_graph/pose_graph.hpp"

namespace adit {
namespace {

constexpr double kTurnMax = 0.01;   // of a map, beyond which the field is linearised again [rad]
constexpr int kLinearisations = 4;  // of the field before the graph is optimised
constexpr int kFewSteps = 15;       // to an optimum near the poses
constexpr double kTurnFar = 0.5;    // beyond which iteration may not converge to the optimum [rad]

double largest_turn(const Eigen::VectorXd& mode) {
  double turn = 0.0;
  for (Eigen::Index i = 2; i < mode.size(); i += 3) turn = std::max(turn, std::abs(mode[i]));
  return turn;
}

/// Of (x, y, θ), from the frame of the older map to that of the newer.
Eigen::Matrix3d rotation_to_newer(const Pose2& T_older_newer) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(-T_older_newer.theta).toRotationMatrix();
  return R;
}

Eigen::Matrix3d in_frame_of_newer(const Eigen::Matrix3d& covariance, const Pose2& T_older_newer) {
  const Eigen::Matrix3d R = rotation_to_newer(T_older_newer);
  return R * covariance * R.transpose();
}

double position_sd(const Eigen::Matrix3d& covariance) {
  return std::sqrt(std::max(0.0, covariance(0, 0) + covariance(1, 1)));
}

/// Standard deviation of the position of a map in any map from `end` on to `middle` that the
/// odometry between these adds, or takes away; `lever_m` from `middle` to the map.
double drift_m(const OdometryChain& odometry, int end, int middle, double lever_m) {
  constexpr double kMargin = 1.5;  // the odometry is composed to first order
  const Eigen::Matrix3d covariance = odometry.between(end, middle).covariance;
  return kMargin * (position_sd(covariance) + lever_m * std::sqrt(std::max(0.0, covariance(2, 2))));
}

constexpr int kStretchMin = 8;  // maps whose covariances are computed one by one

/// Searches the maps that may be near the newest, by halving the path.
class NearMapSearch {
 public:
  NearMapSearch(Trial& trial, const OdometryChain& odometry, const std::vector<Pose2>& poses,
                int map, std::span<const double> reach_m, double sigmas)
      : trial_(trial),
        odometry_(odometry),
        poses_(poses),
        map_(map),
        reach_m_(reach_m),
        sigmas_(sigmas),
        p_map_(poses[as_index(map)].translation()) {
    for (int first = 0; first < map; first += kStretchMin) {
      leaves_.push_back(extent_of(first, std::min(map, first + kStretchMin)));
    }
  }

  std::vector<NearMap> run() {
    visit(0, static_cast<int>(leaves_.size()));
    return std::move(found_);
  }

 private:
  struct Extent {
    Eigen::AlignedBox2d origins;
    double reach_m = 0.0;
  };

  [[nodiscard]] Extent extent_of(int first, int end) const {
    Extent extent;
    for (int i = first; i < end; ++i) {
      extent.origins.extend(poses_[as_index(i)].translation());
      extent.reach_m = std::max(extent.reach_m, reach_m_[as_index(i)]);
    }
    return extent;
  }

  [[nodiscard]] bool is_near(double distance_m, double reach_m, double sd_m) const {
    return distance_m <= reach_m + reach_m_[as_index(map_)] + sigmas_ * sd_m;
  }

  void visit(int first_leaf, int end_leaf) {
    if (first_leaf >= end_leaf) return;
    Extent extent;
    for (int leaf = first_leaf; leaf < end_leaf; ++leaf) {
      extent.origins.extend(leaves_[as_index(leaf)].origins);
      extent.reach_m = std::max(extent.reach_m, leaves_[as_index(leaf)].reach_m);
    }
    const int first = first_leaf * kStretchMin;
    const int end = std::min(map_, end_leaf * kStretchMin);
    const double distance_m = extent.origins.exteriorDistance(p_map_);
    if (!is_near(distance_m, extent.reach_m, 0.0)) {
      const int middle = first + (end - first) / 2;
      const double lever_m = (poses_[as_index(middle)].translation() - p_map_).norm();
      const double sd_m = position_sd(trial_.covariance(middle, map_)) +
                          std::max(drift_m(odometry_, first, middle, lever_m),
                                   drift_m(odometry_, end - 1, middle, lever_m));
      if (!is_near(distance_m, extent.reach_m, sd_m)) return;
    }
    if (end_leaf - first_leaf == 1) return visit_each(first, end);
    const int half = first_leaf + (end_leaf - first_leaf) / 2;
    visit(first_leaf, half);
    visit(half, end_leaf);
  }

  void visit_each(int first, int end) {
    for (int older = first; older < end; ++older) {
      const Eigen::Matrix3d covariance = trial_.covariance(older, map_);
      const double distance_m = (poses_[as_index(older)].translation() - p_map_).norm();
      if (is_near(distance_m, reach_m_[as_index(older)], position_sd(covariance)))
        found_.push_back({older, covariance});
    }
  }

  Trial& trial_;
  const OdometryChain& odometry_;
  const std::vector<Pose2>& poses_;
  int map_;
  std::span<const double> reach_m_;
  double sigmas_;
  Eigen::Vector2d p_map_;
  std::vector<Extent> leaves_;
  std::vector<NearMap> found_;
};

}  // namespace

Trial::Trial(const AssociationProblem& problem, Hypothesis hypothesis, int first)
    : problem_(problem), hypothesis_(std::move(hypothesis)), first_(first) {
  if (first_ > 0) {
    fixed_ = hypothesis_.objective - adit::objective(graph_of(problem_, hypothesis_, first_));
  }
}

Trial::Trial(const AssociationProblem& problem, Hypothesis hypothesis, MapField& map_field)
    : problem_(problem), hypothesis_(std::move(hypothesis)), first_(0), map_field_(&map_field) {
  map_field_->follow(problem_, hypothesis_);
}

std::vector<int> Trial::chosen_loop_closures() const {
  std::vector<int> chosen;
  for (std::size_t k = 0; k < hypothesis_.chosen.size(); ++k) {
    if (hypothesis_.chosen[k] != Association::kNone) chosen.push_back(static_cast<int>(k));
  }
  return chosen;
}

GaussianField& Trial::field() {
  if (!field_) field_.emplace(graph_of(problem_, hypothesis_, first_));
  return *field_;
}

/// Copies the poses of the graph's nodes.
void Trial::set_poses(const std::vector<Pose2>& nodes, Hypothesis& hypothesis) const {
  std::copy(nodes.begin() + (first_ > 0 ? 1 : 0), nodes.end(),
            hypothesis.T_map_local.begin() + first_);
}

/// Whether a chosen loop closure or a bridge links a fixed map to a moving one. If only the
/// odometry does, the fixed maps would not move anyway.
bool Trial::has_fixed_end() const {
  const auto links = [&](const PoseConstraint& c) { return c.from < first_ && c.to >= first_; };
  if (std::ranges::any_of(problem_.bridges, links)) return true;
  for (std::size_t k = 0; k < hypothesis_.chosen.size() && first_ > 0; ++k) {
    if (hypothesis_.chosen[k] == Association::kNone) continue;
    if (links(constraint_of(problem_.loop_closures[k], hypothesis_.chosen[k]))) return true;
  }
  return false;
}

Hypothesis Trial::hypothesis() const {
  Hypothesis hypothesis = hypothesis_;
  hypothesis.partially_optimized |= has_fixed_end();
  if (map_field_ != nullptr && map_field_->field().nodes() > 1) {
    hypothesis.T_map_local = map_field_->poses();
    hypothesis.objective = objective();
  } else if (field_) {
    set_poses(field_->poses(), hypothesis);
    hypothesis.objective = objective();
  }
  return hypothesis;
}

double Trial::objective() const {
  if (map_field_ != nullptr && map_field_->field().nodes() > 1)
    return map_field_->field().objective();
  return field_ ? fixed_ + field_->objective() : hypothesis_.objective;
}

PoseConstraint Trial::chosen_constraint(int loop_closure) const {
  return constraint_of(problem_.loop_closures[as_index(loop_closure)], chosen(loop_closure));
}

std::vector<PoseConstraint> Trial::constraints_in_field(
    const std::vector<int>& loop_closures) const {
  std::vector<PoseConstraint> constraints;
  for (const int k : loop_closures) {
    constraints.push_back(in_graph_from(chosen_constraint(k), hypothesis_, first_));
  }
  return constraints;
}

std::vector<GaussianField::LeaveOneOut> Trial::leave_one_out(const std::vector<int>& loop_closures,
                                                             const PoseConstraint& query) {
  return field().leave_one_out(constraints_in_field(loop_closures),
                               in_graph_from(query, hypothesis_, first_));
}

std::vector<int> Trial::most_coupled(const std::vector<int>& loop_closures,
                                     const PoseConstraint& query, std::size_t most) {
  if (loop_closures.size() <= most) return loop_closures;
  const std::vector<double> couplings = field().couplings(
      constraints_in_field(loop_closures), in_graph_from(query, hypothesis_, first_));
  std::vector<std::size_t> order(loop_closures.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return couplings[a] > couplings[b]; });
  std::vector<int> coupled;
  for (std::size_t i = 0; i < most; ++i) coupled.push_back(loop_closures[order[i]]);
  std::sort(coupled.begin(), coupled.end());
  return coupled;
}

std::vector<Eigen::Matrix3d> Trial::covariances_to(int map) {
  if (map == 0) return {};
  const int shift = first_ > 0 ? first_ - 1 : 0;  // from a node to its map
  const auto by_node = field().relative_covariances_to(map - shift);
  const std::vector<Pose2> nodes = field().poses();
  const auto in_newer = [&](int older) -> Eigen::Matrix3d {
    return in_frame_of_newer(by_node[as_index(older)],
                             between(nodes[as_index(older)], nodes[as_index(map - shift)]));
  };
  std::vector<Eigen::Matrix3d> covariances;
  covariances.reserve(as_index(map));
  if (first_ > 0) covariances.assign(as_index(first_), in_newer(0));  // fixed in the map frame
  for (int older = first_; older < map; ++older) covariances.push_back(in_newer(older - shift));
  return covariances;
}

Eigen::Matrix3d Trial::covariance(int older, int map) {
  if (map_field_ != nullptr) {
    const std::vector<Pose2>& poses = map_field_->poses();
    return in_frame_of_newer(map_field_->field().relative_covariance(older, map),
                             between(poses[as_index(older)], poses[as_index(map)]));
  }
  const auto node = [this](int m) { return std::max(0, m - (first_ > 0 ? first_ - 1 : 0)); };
  const std::vector<Pose2> nodes = field().poses();
  return in_frame_of_newer(field().relative_covariance(node(older), node(map)),
                           between(nodes[as_index(node(older))], nodes[as_index(node(map))]));
}

std::optional<Eigen::Matrix3d> Trial::displacement_response(int map, int to) const {
  if (map_field_ == nullptr) return std::nullopt;
  const std::vector<Pose2>& poses = map_field_->poses();
  return rotation_to_newer(between(poses.front(), poses[as_index(map)])) *
         map_field_->field().response(map, map_field_->displacement(to));
}

std::vector<NearMap> Trial::near_maps(int map, std::span<const double> reach_m, double sigmas) {
  if (map == 0) return {};
  if (map_field_ != nullptr) {
    return NearMapSearch(*this, problem_.odometry, map_field_->poses(), map, reach_m, sigmas).run();
  }
  std::vector<NearMap> all;
  for (const Eigen::Matrix3d& covariance : covariances_to(map)) {
    all.push_back({static_cast<int>(all.size()), covariance});
  }
  return all;
}

Eigen::Matrix3d Trial::least_covariance(int map, int end) {
  const std::vector<Pose2> all = poses();
  Eigen::Matrix3d least = covariance(0, map);
  const auto visit = [&](const auto& self, int first, int last) -> void {
    if (first > last) return;
    const int middle = first + (last - first) / 2;
    const Eigen::Matrix3d here = covariance(middle, map);
    if (position_sd(here) < position_sd(least)) least = here;
    const double lever_m =
        (all[as_index(middle)].translation() - all[as_index(map)].translation()).norm();
    const auto may_be_less = [&](int side) {
      return position_sd(here) - drift_m(problem_.odometry, side, middle, lever_m) <
             position_sd(least);
    };
    if (may_be_less(last)) self(self, middle + 1, last);
    if (may_be_less(first)) self(self, first, middle - 1);
  };
  visit(visit, 0, end - 1);
  return least;
}

std::vector<Pose2> Trial::poses() const {
  return map_field_ != nullptr ? map_field_->poses() : hypothesis().T_map_local;
}

void Trial::accept(int loop_closure, int alternative) {
  const auto k = as_index(loop_closure);
  if (map_field_ != nullptr) {
    field_.reset();
    map_field_->accept(problem_, loop_closure, alternative);
  } else {
    field().add(
        in_graph_from(constraint_of(problem_.loop_closures[k], alternative), hypothesis_, first_));
  }
  hypothesis_.chosen[k] = alternative;
  relinearise();
}

/// Linearises at the mode until it hardly moves, which takes a factorisation for each step, or in a
/// map field the elimination of what moved.
void Trial::relinearise() {
  if (map_field_ != nullptr) {
    double turn = map_field_->largest_turn();
    for (int step = 0; turn > kTurnMax; ++step) {
      const bool is_far = turn > kTurnFar || map_field_->is_mostly_far();
      if (is_far || step == kLinearisations) return reoptimize(turn > kTurnFar);
      map_field_->relinearise();
      hypothesis_ = hypothesis();
      turn = map_field_->largest_turn();
    }
    return;
  }
  double turn = largest_turn(field().mode());
  for (int step = 0; turn > kTurnMax; ++step) {
    if (turn > kTurnFar || step == kLinearisations) return reoptimize(turn > kTurnFar);
    hypothesis_ = hypothesis();
    field_.reset();
    turn = largest_turn(field().mode());
  }
}

void Trial::accept(const std::vector<std::array<int, 2>>& choices, bool from_scratch) {
  hypothesis_ = hypothesis();
  field_.reset();
  for (const auto& [loop_closure, alternative] : choices) {
    hypothesis_.chosen[as_index(loop_closure)] = alternative;
  }
  reoptimize(from_scratch, from_scratch ? OptimizeParams{}.iterations_max : kFewSteps);
}

void Trial::revoke(const std::vector<int>& loop_closures) {
  hypothesis_ = hypothesis();
  field_.reset();
  for (const int k : loop_closures) hypothesis_.chosen[as_index(k)] = Association::kNone;
  reoptimize();
}

/// Linearises at the mode until no map moves. False if it does not converge.
bool Trial::settle() {
  for (int step = 0; step < kFewSteps; ++step) {
    if (map_field_->largest_turn() > kTurnFar || map_field_->is_mostly_far()) return false;
    if (!map_field_->relinearise()) {
      hypothesis_ = hypothesis();
      return true;
    }
  }
  return false;
}

void Trial::reoptimize(bool from_scratch, int iterations_max) {
  hypothesis_ = hypothesis();
  field_.reset();
  if (map_field_ != nullptr && !from_scratch && !map_field_->is_mostly_far()) {
    map_field_->follow(problem_, hypothesis_);
    if (settle()) {
      hypothesis_.partially_optimized = false;
      return;
    }
    hypothesis_ = hypothesis();
  }
  PoseGraph graph = graph_of(problem_, hypothesis_, first_);
  OptimizeParams params;
  params.rotation_initialization = from_scratch;
  params.tolerance = 1e-6;
  params.iterations_max = iterations_max;
  hypothesis_.objective = fixed_ + optimize(graph, params).objective;
  set_poses(graph.poses, hypothesis_);
  hypothesis_.partially_optimized &= first_ > 0;
  if (map_field_ != nullptr) map_field_->follow(problem_, hypothesis_);
}

}  // namespace adit
