// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Time to revoke a group of wrong loop closures and to repeat the later data association, at the
// end of trajectories of different length: on contradicting loop closures, and on a map
// inconsistency. The affected loop is the same in all cases, so that the time should not depend on
// the length.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/pose_graph/height_field.hpp"
#include "procs/mapping/association/lazy_association.hpp"

namespace adit {
namespace {

constexpr double kStepM = 5.0;
constexpr int kLongSide = 28;  // steps
constexpr int kShortSide = 2;
constexpr int kRound = 2 * (kLongSide + kShortSide);
constexpr int kRevisited = 12;  // local maps of a second round, each with a loop closure
constexpr int kGap = 8;         // steps to the next loop
constexpr int kLoop = kRound + kRevisited + kGap;
constexpr int kRoundsGrown = 2;
constexpr int kWrong = 12;  // loop closures
constexpr int kRight = 16;  // loop closures that contradict them
constexpr int kLast = kRound + kWrong + kRight;

const Eigen::Vector3d kStepSd(0.05, 0.05, 0.012);   // of one step: m, m, rad
const Eigen::Vector3d kSmallSd(0.02, 0.02, 0.002);  // as scan matching has it
const Eigen::Vector3d kLoopClosureSd(0.05, 0.05, 0.005);

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Eigen::Matrix3d information(const Eigen::Vector3d& sd) {
  return sd.cwiseInverse().cwiseAbs2().asDiagonal();
}

/// Rounds of narrow rectangles, each revisited over its first steps before the next one follows. At
/// the end, wrong loop closures place the second round on the opposite long side.
class LongTrajectory {
 public:
  LongTrajectory(int maps, const Eigen::Vector3d& step_sd) : step_sd_(step_sd) {
    const int loops = (maps - kLast) / kLoop;
    truth_.emplace_back();
    go(maps - kLast - loops * kLoop);
    for (int k = 0; k < loops; ++k) add_loop();
    start_ = static_cast<int>(truth_.size()) - 1;
    go_round();
    go(kWrong + kRight - 1);
    for (int i = 0; i < kWrong; ++i) {
      previous_loop_closures_.push_back(loop_closure(
          start_ + kRound - kShortSide - i, start_ + kRound + i, {0.0, 0.0, std::numbers::pi}));
    }
    first_of_last_rounds_ = 1 + std::max(0, maps - kLast - kRoundsGrown * kLoop);
    measure();
  }

  /// The map from which a few of the former rounds follow, and the one after them.
  [[nodiscard]] int first_grown() const { return first_of_last_rounds_; }
  [[nodiscard]] int end_grown() const { return start_; }

  [[nodiscard]] int maps() const { return static_cast<int>(truth_.size()); }
  [[nodiscard]] int first_right() const { return start_ + kRound + kWrong; }

  /// Restores the first `maps` local maps and all their loop closures, including the wrong ones.
  void restore(LazyAssociation& association, int maps) const {
    for (int map = 0; map < maps; ++map) add_map(association, map);
    std::vector<Association> decisions;
    for (const LoopClosure& loop_closure : previous_loop_closures_) {
      if (loop_closure.newer_map >= maps) continue;
      Association a;
      a.loop_closure = loop_closure;
      a.loop_closure.id = static_cast<int>(decisions.size());
      a.chosen = 0;
      decisions.push_back(a);
    }
    association.restore(decisions);
  }

  void add_map(LazyAssociation& association, int map) const {
    association.add_map(steps_[at(map)], information(step_sd_));
  }

  /// The measured loop closures of a local map of a former round.
  [[nodiscard]] std::vector<LoopClosure> measured_loop_closures(int map) const {
    std::vector<LoopClosure> found;
    for (const LoopClosure& c : previous_loop_closures_) {
      if (c.newer_map == map) found.push_back(c);
    }
    return found;
  }

  /// A loop closure from the last map of the former rounds to the first map.
  [[nodiscard]] LoopClosure loop_of_all() const {
    return loop_closure(0, end_grown() - 1, between(truth_[0], truth_[at(end_grown() - 1)]));
  }

  /// The right loop closures of a local map of a second round.
  [[nodiscard]] std::vector<LoopClosure> right_loop_closures(int map) const {
    const auto found = starts_.upper_bound(map);
    if (found == starts_.begin()) return {};
    const int start = *std::prev(found);
    const int position = map - start;
    const bool revisited =
        position >= kRound && (position < kRound + kRevisited || start == start_);
    if (!revisited) return {};
    return {loop_closure(map - kRound, map, between(truth_[at(map - kRound)], truth_[at(map)]))};
  }

  /// Position error of a local map relative to the start of the last loop [m].
  [[nodiscard]] double error_m(const std::vector<Pose2>& poses, int map) const {
    const Pose2 estimated = between(poses[at(start_)], poses[at(map)]);
    return between(between(truth_[at(start_)], truth_[at(map)]), estimated).translation().norm();
  }

 private:
  void go(int steps, double turn_at_end = 0.0) {
    for (int k = 1; k <= steps; ++k) {
      truth_.push_back(truth_.back() * Pose2{kStepM, 0.0, k == steps ? turn_at_end : 0.0});
    }
  }

  void go_round() {
    starts_.insert(static_cast<int>(truth_.size()) - 1);
    for (const int side : {kLongSide, kShortSide, kLongSide, kShortSide}) {
      go(side, std::numbers::pi / 2.0);
    }
  }

  void add_loop() {
    const int start = static_cast<int>(truth_.size()) - 1;
    go_round();
    go(kRevisited, -std::numbers::pi / 2.0);
    go(kGap, std::numbers::pi / 2.0);
    for (int map = start + kRound; map < start + kRound + kRevisited; ++map) {
      for (const LoopClosure& c : right_loop_closures(map)) previous_loop_closures_.push_back(c);
    }
  }

  static LoopClosure loop_closure(int older, int newer, const Pose2& T_older_newer) {
    LoopClosure c;
    c.newer_map = newer;
    c.alternatives = {{older, T_older_newer, information(kLoopClosureSd), 10.0}};
    return c;
  }

  void measure() {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    const auto noise = [&](const Eigen::Vector3d& sd) {
      const Eigen::Vector3d n(normal(random), normal(random), normal(random));
      return Pose2::from_vector(sd.cwiseProduct(n));
    };
    steps_.emplace_back();
    for (std::size_t i = 1; i < truth_.size(); ++i) {
      steps_.push_back(between(truth_[i - 1], truth_[i]) * noise(0.5 * step_sd_));
    }
    for (LoopClosure& c : previous_loop_closures_) {
      Pose2& T = c.alternatives.front().T_older_newer;
      T = T * noise(0.5 * kLoopClosureSd);
    }
  }

  Eigen::Vector3d step_sd_;
  std::vector<Pose2> truth_;
  std::vector<Pose2> steps_;
  std::vector<LoopClosure> previous_loop_closures_;
  std::set<int> starts_;
  int start_ = 0;  // of the last loop
  int first_of_last_rounds_ = 0;
};

const LongTrajectory& trajectory_of(int maps, const Eigen::Vector3d& step_sd = kStepSd) {
  static std::map<std::pair<int, double>, LongTrajectory> trajectories;
  return trajectories.try_emplace({maps, step_sd.z()}, maps, step_sd).first->second;
}

/// Evidence from the ground truth, without matching.
class TrueEvidence : public Evidence {
 public:
  explicit TrueEvidence(const LongTrajectory& trajectory) : trajectory_(trajectory) {}

  [[nodiscard]] std::vector<LoopClosure> loop_closures(int map, Trial& trial, bool) const override {
    benchmark::DoNotOptimize(trial.hypothesis().T_map_local);
    benchmark::DoNotOptimize(trial.covariances_to(map));
    return trajectory_.right_loop_closures(map);
  }

  [[nodiscard]] double map_inconsistency(const std::vector<Pose2>& T_map_local) const override {
    const int newest = static_cast<int>(T_map_local.size()) - 1;
    return trajectory_.error_m(T_map_local, newest) > 2.0 ? 200.0 : 0.0;
  }

 private:
  const LongTrajectory& trajectory_;
};

/// Measures CPU time, which does not depend on other processes.
class Stopwatch {
 public:
  [[nodiscard]] double s() const { return now() - begin_; }

 private:
  static double now() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }

  double begin_ = now();
};

/// Covariances that every new local map needs before any decision.
void compute_covariances(LazyAssociation& association, int map) {
  benchmark::DoNotOptimize(association.trial().covariances_to(map));
}

bool revised(const std::vector<Association>& decided) {
  return std::any_of(decided.begin(), decided.end(), [](const Association& a) {
    return a.action == Association::Action::kRevised;
  });
}

constexpr double kReachM = 15.0;  // of the walls of a local map
constexpr double kSigmas = 3.0;   // of the gate in which they are searched

/// Times of local maps of a kind.
class Times {
 public:
  void add(double s) { ms_.push_back(1e3 * s); }

  void count(benchmark::State& state, const std::string& kind) {
    if (ms_.empty()) return;
    std::sort(ms_.begin(), ms_.end());
    state.counters[kind + "_median_ms"] = quantile(0.5);
    state.counters[kind + "_p95_ms"] = quantile(0.95);
    state.counters[kind + "_max_ms"] = ms_.back();
  }

 private:
  [[nodiscard]] double quantile(double share) const {
    return ms_[static_cast<std::size_t>(share * static_cast<double>(ms_.size() - 1))];
  }

  std::vector<double> ms_;
};

/// A mission continues: each new local map is added, the older ones near it are searched with their
/// covariances, and its loop closures are decided. Maps with and without loop closures apart. The
/// first map after the restart, which builds the field, is not counted.
void new_map(benchmark::State& state) {
  const LongTrajectory& trajectory = trajectory_of(static_cast<int>(state.range(0)), kSmallSd);
  const std::vector<double> reach_m(static_cast<std::size_t>(trajectory.maps()), kReachM);
  Times clean;
  Times loops;
  double near = 0.0;
  for (auto _ : state) {
    LazyAssociation association{LazyAssociationParams{}};
    trajectory.restore(association, trajectory.first_grown() - 1);
    double total_s = 0.0;
    for (int map = trajectory.first_grown() - 1; map < trajectory.end_grown(); ++map) {
      std::vector<LoopClosure> found = trajectory.measured_loop_closures(map);
      const bool has_loop = !found.empty();
      const Stopwatch stopwatch;
      trajectory.add_map(association, map);
      near += static_cast<double>(association.trial().near_maps(map, reach_m, kSigmas).size());
      benchmark::DoNotOptimize(association.decide(std::move(found), 0));
      const double s = stopwatch.s();
      if (map < trajectory.first_grown()) continue;
      total_s += s;
      (has_loop ? loops : clean).add(s);
    }
    const int maps = trajectory.end_grown() - trajectory.first_grown();
    state.SetIterationTime(total_s / maps);
    state.counters["near"] = near / maps;
    near = 0.0;
  }
  clean.count(state, "clean");
  loops.count(state, "loop");
}

/// One loop closure around all local maps, which moves nearly all of them.
void loop_of_all(benchmark::State& state) {
  const LongTrajectory& trajectory = trajectory_of(static_cast<int>(state.range(0)), kSmallSd);
  for (auto _ : state) {
    LazyAssociation association{LazyAssociationParams{}};
    trajectory.restore(association, trajectory.end_grown() - 2);
    for (int map = trajectory.end_grown() - 2; map < trajectory.end_grown(); ++map) {
      trajectory.add_map(association, map);
      benchmark::DoNotOptimize(association.trial().covariance(0, map));
    }
    const Stopwatch stopwatch;
    const auto decided = association.decide({trajectory.loop_of_all()}, 0);
    state.SetIterationTime(stopwatch.s());
    if (decided.front().chosen == Association::kNone) return state.SkipWithError("rejected");
  }
}

/// The loop closure at which the wrong group is revoked.
void contradicted(benchmark::State& state) {
  const LongTrajectory& trajectory = trajectory_of(static_cast<int>(state.range(0)));
  double slowest_s = 0.0;
  for (auto _ : state) {
    LazyAssociation association{LazyAssociationParams{}};
    trajectory.restore(association, trajectory.first_right());
    bool done = false;
    for (int map = trajectory.first_right(); map < trajectory.maps() && !done; ++map) {
      trajectory.add_map(association, map);
      compute_covariances(association, map);
      const Stopwatch stopwatch;
      done = revised(association.decide(trajectory.right_loop_closures(map), 0));
      const double s = stopwatch.s();
      slowest_s = std::max(slowest_s, s);
      if (done) state.SetIterationTime(s);
    }
    if (!done ||
        trajectory.error_m(association.hypothesis().T_map_local, trajectory.first_right()) > 2.0) {
      return state.SkipWithError("the wrong group was not revoked");
    }
    state.counters["hypotheses"] = association.trials();
  }
  state.counters["slowest_ms"] = 1e3 * slowest_s;  // of the preceding loop closures
}

/// A local map that is inconsistent with the map.
void map_inconsistency(benchmark::State& state) {
  const LongTrajectory& trajectory = trajectory_of(static_cast<int>(state.range(0)));
  const TrueEvidence evidence(trajectory);
  for (auto _ : state) {
    LazyAssociation association{LazyAssociationParams{}};
    trajectory.restore(association, trajectory.first_right());
    compute_covariances(association, trajectory.first_right() - 1);
    const Stopwatch stopwatch;
    const bool done = revised(association.revise(evidence, 0));
    state.SetIterationTime(stopwatch.s());
    if (!done) return state.SkipWithError("the wrong group was not revoked");
    state.counters["hypotheses"] = association.trials();
  }
}

/// Heights of a path with a loop closure for each seventh map: `maps` nodes, then a few more.
void heights(benchmark::State& state) {
  constexpr int kMore = 200;
  const int maps = static_cast<int>(state.range(0));
  const auto climb = [](int node) {
    return HeightConstraint{node - 1, node, 0.1, 0.02, {{{0, kStepM}}}};
  };
  HeightField field(0.005);
  const auto add = [&](int node) {
    field.add_node();
    field.add(climb(node));
    if (node > kRound && node % 7 == 0) field.add({node - kRound, node, 0.0, 0.03, {}});
  };
  for (int node = 1; node < maps; ++node) add(node);
  field.update();
  Times times;
  for (auto _ : state) {
    const int first = field.nodes();
    for (int node = first; node < first + kMore; ++node) {
      const Stopwatch stopwatch;
      add(node);
      field.update();
      benchmark::DoNotOptimize(field.variance(0, node));
      times.add(stopwatch.s());
    }
    const Stopwatch stopwatch;
    benchmark::DoNotOptimize(field.variances_to(0));
    state.SetIterationTime(stopwatch.s());
  }
  times.count(state, "new");
}

void lengths(benchmark::internal::Benchmark* bench) {
  bench->Arg(300)->Arg(1000)->Arg(3000)->Arg(10000)->Arg(30000)->Unit(benchmark::kMillisecond);
}

BENCHMARK(new_map)->Apply(lengths)->UseManualTime()->Iterations(3);
BENCHMARK(loop_of_all)->Apply(lengths)->UseManualTime()->Iterations(3);
BENCHMARK(heights)->Apply(lengths)->UseManualTime()->Iterations(3);
BENCHMARK(contradicted)->Apply(lengths)->UseManualTime();
BENCHMARK(map_inconsistency)->Apply(lengths)->UseManualTime();

}  // namespace
}  // namespace adit
