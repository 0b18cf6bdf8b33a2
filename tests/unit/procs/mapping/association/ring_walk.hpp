// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "procs/mapping/association/association_problem.hpp"
#include "procs/mapping/association/lazy_association.hpp"

namespace adit::test {

/// Standard normal random numbers, the same with every library (Box and Muller).
class Normal {
 public:
  explicit Normal(std::uint32_t seed) : rng_(seed) {}

  double operator()() {
    const double u = (static_cast<double>(rng_()) + 1.0) / 4294967297.0;
    const double v = static_cast<double>(rng_()) / 4294967296.0;
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
  }

  /// A random small motion with these standard deviations.
  Pose2 motion(const Eigen::Vector3d& sd) {
    const double x = (*this)() * sd.x();
    const double y = (*this)() * sd.y();
    return {x, y, (*this)() * sd.z()};
  }

 private:
  std::mt19937 rng_;
};

inline Eigen::Matrix3d information_of(const Eigen::Vector3d& sd) {
  return sd.array().square().inverse().matrix().asDiagonal();
}

/// Laps of a square of 50 m a side, a step per metre, so that map i + 200 is at the place of map i.
/// Over a lap the odometry is uncertain by some metres, to the next corner by some decimetres.
class RingWalk {
 public:
  static constexpr int kRound = 200;

  explicit RingWalk(int maps, std::uint32_t seed = 1) : normal_(seed) {
    Pose2 pose;
    for (int i = 0; i < maps; ++i) {
      truth.push_back(pose);
      pose = pose * Pose2{1.0, 0.0, (i + 1) % 50 == 0 ? std::numbers::pi / 2.0 : 0.0};
    }
    for (int i = 0; i + 1 < maps; ++i) {
      chain.push_back(
          {i, i + 1, true_motion(i, i + 1) * normal_.motion(kStep), information_of(kStep)});
    }
  }

  /// A loop closure with the true pose plus noise, or displaced by `error`.
  LoopClosureAlternative alternative(int older, int newer, const Pose2& error = {},
                                     double log_likelihood = 0.0) {
    return {older, true_motion(older, newer) * error * normal_.motion(kLoopClosure),
            information_of(kLoopClosure), log_likelihood};
  }
  LoopClosure loop_closure(int older, int newer, const Pose2& error = {}) {
    LoopClosure result;
    result.newer_map = newer;
    result.alternatives = {alternative(older, newer, error)};
    return result;
  }
  /// Loop closures of `count` maps from `newer` on with those one lap before, all with the same
  /// error.
  std::vector<LoopClosure> group(int newer, int count, const Pose2& error = {}) {
    std::vector<LoopClosure> result;
    for (int k = 0; k < count; ++k) {
      result.push_back(loop_closure(newer + k - kRound, newer + k, error));
    }
    return result;
  }

  std::vector<Pose2> truth;
  std::vector<PoseConstraint> chain;

 private:
  inline static const Eigen::Vector3d kStep{0.05, 0.05, 0.01};
  inline static const Eigen::Vector3d kLoopClosure{0.05, 0.05, 0.01};

  [[nodiscard]] Pose2 true_motion(int from, int to) const {
    return between(truth[static_cast<std::size_t>(from)], truth[static_cast<std::size_t>(to)]);
  }

  Normal normal_;
};

inline std::vector<LoopClosure> together(const std::vector<std::vector<LoopClosure>>& groups) {
  std::vector<LoopClosure> all;
  for (const auto& group : groups) all.insert(all.end(), group.begin(), group.end());
  return all;
}

/// Adds the maps of the walk one by one and decides the loop closures, given in order of their
/// newer map, as soon as that map exists. Returns the decisions.
inline std::vector<Association> drive(LazyAssociation& association, const RingWalk& walk,
                                      const std::vector<LoopClosure>& loop_closures) {
  std::vector<Association> history;
  auto next = loop_closures.begin();
  for (int map = 0; map < static_cast<int>(walk.truth.size()); ++map) {
    const PoseConstraint step =
        map > 0 ? walk.chain[static_cast<std::size_t>(map - 1)] : PoseConstraint{};
    association.add_map(step.T_from_to, step.information);
    std::vector<LoopClosure> here;
    while (next != loop_closures.end() && next->newer_map == map) here.push_back(*next++);
    const auto decided = association.decide(here, map);
    history.insert(history.end(), decided.begin(), decided.end());
  }
  return history;
}

/// The same as an undecided problem; every loop closure in its own group.
inline AssociationProblem problem_of(const RingWalk& walk, std::vector<LoopClosure> loop_closures) {
  AssociationProblem problem;
  problem.chain = walk.chain;
  problem.odometry.add_map({});
  for (const PoseConstraint& step : walk.chain) problem.odometry.add_map(measured_by(step));
  for (std::size_t k = 0; k < loop_closures.size(); ++k) {
    loop_closures[k].id = static_cast<int>(k);
    problem.groups.push_back(static_cast<int>(k));
    problem.plausible.push_back(true);
  }
  problem.loop_closures = std::move(loop_closures);
  return problem;
}

/// The hypothesis without loop closures: poses by odometry.
inline Hypothesis nothing_chosen(const AssociationProblem& problem) {
  Hypothesis hypothesis;
  hypothesis.chosen.assign(problem.loop_closures.size(), Association::kNone);
  hypothesis.T_map_local.emplace_back();
  for (const PoseConstraint& step : problem.chain) {
    hypothesis.T_map_local.push_back(hypothesis.T_map_local.back() * step.T_from_to);
  }
  return hypothesis;
}

}  // namespace adit::test
