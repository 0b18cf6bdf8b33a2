// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// What it takes to undo a group of wrong closures and to associate anew what came after, at the end
// of ways of different length: by closures that contradict it, and by surprise. The loop that is
// concerned is the same in all, so that the time should be, too.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include <benchmark/benchmark.h>

#include "procs/mapping/association/lazy_association.hpp"

namespace adit {
namespace {

constexpr double kStepM = 5.0;
constexpr int kLongSide = 28;  // steps
constexpr int kShortSide = 2;
constexpr int kRound = 2 * (kLongSide + kShortSide);
constexpr int kRevisited = 12;  // maps of a second round, each with a closure
constexpr int kFar = 8;         // steps to the next loop
constexpr int kLoop = kRound + kRevisited + kFar;
constexpr int kWrong = 12;  // closures
constexpr int kRight = 16;  // that contradict them
constexpr int kLast = kRound + kWrong + kRight;

const Eigen::Vector3d kStepSd(0.05, 0.05, 0.012);  // of a step of the way
const Eigen::Vector3d kLoopClosureSd(0.05, 0.05, 0.005);

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Eigen::Matrix3d information(const Eigen::Vector3d& sd) {
  return sd.cwiseInverse().cwiseAbs2().asDiagonal();
}

/// Rounds of narrow rectangles, each begun a second time and then left for the next; at the end of
/// the way the second round is taken for the other long side.
class LongTrajectory {
 public:
  explicit LongTrajectory(int maps) {
    const int loops = (maps - kLast) / kLoop;
    truth_.emplace_back();
    go(maps - kLast - loops * kLoop);
    for (int k = 0; k < loops; ++k) add_loop();
    start_ = static_cast<int>(truth_.size()) - 1;
    go_round();
    go(kWrong + kRight - 1);
    for (int i = 0; i < kWrong; ++i) {
      previous_closures_.push_back(loop_closure(start_ + kRound - kShortSide - i,
                                                start_ + kRound + i, {0.0, 0.0, std::numbers::pi}));
    }
    measure();
  }

  [[nodiscard]] int maps() const { return static_cast<int>(truth_.size()); }
  [[nodiscard]] int first_right() const { return start_ + kRound + kWrong; }

  /// The way up to a map and all closures until then, the wrong ones too.
  void begin(LazyAssociation& association, int maps) const {
    for (int map = 0; map < maps; ++map) add_map(association, map);
    std::vector<Association> decisions;
    for (const LoopClosure& loop_closure : previous_closures_) {
      Association a;
      a.loop_closure = loop_closure;
      a.loop_closure.id = static_cast<int>(decisions.size());
      a.chosen = 0;
      decisions.push_back(a);
    }
    association.restore(decisions);
  }

  void add_map(LazyAssociation& association, int map) const {
    association.add_map(steps_[at(map)], information(kStepSd));
  }

  /// The closures that are right for a map of a second round.
  [[nodiscard]] std::vector<LoopClosure> right(int map) const {
    const auto found = starts_.upper_bound(map);
    if (found == starts_.begin()) return {};
    const int start = *std::prev(found);
    const int position = map - start;
    const bool revisited =
        position >= kRound && (position < kRound + kRevisited || start == start_);
    if (!revisited) return {};
    return {loop_closure(map - kRound, map, between(truth_[at(map - kRound)], truth_[at(map)]))};
  }

  /// How far a map is from where it should be, seen from the beginning of the last loop [m].
  [[nodiscard]] double error_m(const std::vector<Pose2>& poses, int map) const {
    const Pose2 found = between(poses[at(start_)], poses[at(map)]);
    return between(between(truth_[at(start_)], truth_[at(map)]), found).translation().norm();
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
    go(kFar, std::numbers::pi / 2.0);
    for (int map = start + kRound; map < start + kRound + kRevisited; ++map) {
      for (const LoopClosure& c : right(map)) previous_closures_.push_back(c);
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
      steps_.push_back(between(truth_[i - 1], truth_[i]) * noise(0.5 * kStepSd));
    }
    for (LoopClosure& c : previous_closures_) {
      Pose2& T = c.alternatives.front().T_older_newer;
      T = T * noise(0.5 * kLoopClosureSd);
    }
  }

  std::vector<Pose2> truth_;
  std::vector<Pose2> steps_;
  std::vector<LoopClosure> previous_closures_;
  std::set<int> starts_;
  int start_ = 0;  // of the last loop
};

const LongTrajectory& trajectory_of(int maps) {
  static std::map<int, LongTrajectory> trajectories;
  return trajectories.try_emplace(maps, maps).first->second;
}

/// What is right is at hand, without matching.
class Prepared : public Evidence {
 public:
  explicit Prepared(const LongTrajectory& position) : trajectory_(position) {}

  [[nodiscard]] std::vector<LoopClosure> loop_closures(int map, Trial& trial, bool) const override {
    benchmark::DoNotOptimize(trial.hypothesis().T_map_local);
    benchmark::DoNotOptimize(trial.covariances_to(map));
    return trajectory_.right(map);
  }

  [[nodiscard]] double map_inconsistency(const std::vector<Pose2>& T_map_local) const override {
    const int newest = static_cast<int>(T_map_local.size()) - 1;
    return trajectory_.error_m(T_map_local, newest) > 2.0 ? 200.0 : 0.0;
  }

 private:
  const LongTrajectory& trajectory_;
};

/// Of CPU time, so that others on the machine do not count.
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

/// What every new map asks before anything is decided.
void look(LazyAssociation& association, int map) {
  benchmark::DoNotOptimize(association.trial().covariances_to(map));
}

bool revised(const std::vector<Association>& decided) {
  return std::any_of(decided.begin(), decided.end(), [](const Association& a) {
    return a.action == Association::Action::kRevised;
  });
}

/// A new map, before anything is decided: what every one costs.
void new_map(benchmark::State& state) {
  const LongTrajectory& position = trajectory_of(static_cast<int>(state.range(0)));
  LazyAssociation association{LazyAssociationParams{}};
  position.begin(association, position.first_right());
  for (auto _ : state) {
    Trial trial(association.problem(), association.hypothesis());
    benchmark::DoNotOptimize(trial.covariances_to(position.first_right() - 1));
  }
}

/// The closure at which the wrong group is given up.
void contradicted(benchmark::State& state) {
  const LongTrajectory& position = trajectory_of(static_cast<int>(state.range(0)));
  double slowest_s = 0.0;
  for (auto _ : state) {
    LazyAssociation association{LazyAssociationParams{}};
    position.begin(association, position.first_right());
    bool done = false;
    for (int map = position.first_right(); map < position.maps() && !done; ++map) {
      position.add_map(association, map);
      look(association, map);
      const Stopwatch stopwatch;
      done = revised(association.decide(position.right(map), 0));
      const double s = stopwatch.s();
      slowest_s = std::max(slowest_s, s);
      if (done) state.SetIterationTime(s);
    }
    if (!done ||
        position.error_m(association.hypothesis().T_map_local, position.first_right()) > 2.0) {
      return state.SkipWithError("the wrong group stays");
    }
    state.counters["beliefs"] = association.trials();
  }
  state.counters["slowest_ms"] = 1e3 * slowest_s;  // of the closures until then
}

/// The map that lies where it cannot.
void surprised(benchmark::State& state) {
  const LongTrajectory& position = trajectory_of(static_cast<int>(state.range(0)));
  const Prepared evidence(position);
  for (auto _ : state) {
    LazyAssociation association{LazyAssociationParams{}};
    position.begin(association, position.first_right());
    look(association, position.first_right() - 1);
    const Stopwatch stopwatch;
    const bool done = revised(association.revise(evidence, 0));
    state.SetIterationTime(stopwatch.s());
    if (!done) return state.SkipWithError("the wrong group stays");
    state.counters["beliefs"] = association.trials();
  }
}

void lengths(benchmark::internal::Benchmark* bench) {
  bench->Arg(300)->Arg(1000)->Arg(3000)->Arg(10000)->Unit(benchmark::kMillisecond);
}

BENCHMARK(new_map)->Apply(lengths);
BENCHMARK(contradicted)->Apply(lengths)->UseManualTime();
BENCHMARK(surprised)->Apply(lengths)->UseManualTime();

}  // namespace
}  // namespace adit
