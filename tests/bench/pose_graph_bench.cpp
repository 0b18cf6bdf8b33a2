// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Times of pose graph optimization from chained odometry to the optimum, in total and by step, on
// the installed public graphs, and of the Gaussian field operations of data association. The target
// of the total is 1.5 times one analysis and four factorizations.
#include <benchmark/benchmark.h>

#include "common/pose_graph/g2o_file.hpp"
#include "common/pose_graph/gaussian_field.hpp"
#include "common/pose_graph/optimize.hpp"
#include "common/pose_graph/rotation_initialization.hpp"
#include "tests/support/recordings.hpp"

namespace adit {
namespace {

constexpr const char* kGraphs[] = {"intel", "CSAIL", "MIT", "manhattan", "M3500a", "bicocca_0.500"};

PoseGraph from_odometry(const std::filesystem::path& path) {
  PoseGraph graph = read_g2o(path).graph;
  chain_odometry(graph);
  return graph;
}

void analysis(benchmark::State& state, const std::filesystem::path& path) {
  const PoseGraph graph = from_odometry(path);
  for (auto _ : state) {
    const GraphStructure structure = analyse(graph);
    NormalEquations equations(structure);
    benchmark::DoNotOptimize(equations);
  }
}

void linearisation(benchmark::State& state, const std::filesystem::path& path) {
  const PoseGraph graph = from_odometry(path);
  NormalEquations equations(analyse(graph));
  for (auto _ : state) benchmark::DoNotOptimize(equations.linearise(graph));
}

void factorisation(benchmark::State& state, const std::filesystem::path& path) {
  const PoseGraph graph = from_odometry(path);
  NormalEquations equations(analyse(graph));
  equations.linearise(graph);
  for (auto _ : state) benchmark::DoNotOptimize(equations.matrix().factorise());
  state.counters["entries"] = static_cast<double>(equations.matrix().factor_entries());
}

void solution(benchmark::State& state, const std::filesystem::path& path) {
  const PoseGraph graph = from_odometry(path);
  NormalEquations equations(analyse(graph));
  equations.linearise(graph);
  if (!equations.matrix().factorise()) return state.SkipWithError("singular");
  for (auto _ : state) benchmark::DoNotOptimize(equations.matrix().solve(equations.b()));
}

void rotation_initialization(benchmark::State& state, const std::filesystem::path& path) {
  const PoseGraph odometry = from_odometry(path);
  const GraphStructure structure = analyse(odometry);
  NormalEquations equations(structure);
  for (auto _ : state) {
    PoseGraph graph = odometry;
    benchmark::DoNotOptimize(initialize_from_rotations(graph, structure, equations));
  }
}

void full_optimization(benchmark::State& state, const std::filesystem::path& path) {
  const PoseGraph odometry = from_odometry(path);
  OptimizeResult result;
  for (auto _ : state) {
    PoseGraph graph = odometry;
    result = optimize(graph, {});
  }
  state.counters["objective"] = result.objective;
  state.counters["iterations"] = result.iterations;
  state.counters["factorisations"] = result.factorisations;
}

GaussianField optimal_field(const std::filesystem::path& path) {
  PoseGraph graph = from_odometry(path);
  optimize(graph, {});
  return GaussianField(graph);
}

/// Adds and removes a constraint between distant nodes.
void update_and_downdate(benchmark::State& state, const std::filesystem::path& path) {
  const int last = static_cast<int>(from_odometry(path).poses.size()) - 1;
  GaussianField field = optimal_field(path);
  const PoseConstraint loop{last / 3, last, {}, Eigen::Matrix3d::Identity()};
  for (auto _ : state) {
    field.add(loop);
    benchmark::DoNotOptimize(field.remove(loop));
  }
}

void covariance(benchmark::State& state, const std::filesystem::path& path) {
  const int last = static_cast<int>(from_odometry(path).poses.size()) - 1;
  const GaussianField field = optimal_field(path);
  for (auto _ : state) benchmark::DoNotOptimize(field.relative_covariance(last / 3, last));
}

void covariances(benchmark::State& state, const std::filesystem::path& path) {
  const int last = static_cast<int>(from_odometry(path).poses.size()) - 1;
  GaussianField field = optimal_field(path);
  for (auto _ : state) benchmark::DoNotOptimize(field.relative_covariances_to(last));
}

void marginals(benchmark::State& state, const std::filesystem::path& path) {
  PoseGraph graph = from_odometry(path);
  optimize(graph, {});
  NormalEquations equations(analyse(graph));
  equations.linearise(graph);
  if (!equations.matrix().factorise()) return state.SkipWithError("singular");
  for (auto _ : state) benchmark::DoNotOptimize(equations.matrix().inverse_diagonal());
}

using Measure = void (*)(benchmark::State&, const std::filesystem::path&);
constexpr std::pair<const char*, Measure> kMeasures[] = {
    {"analysis", analysis},
    {"linearisation", linearisation},
    {"factorisation", factorisation},
    {"solution", solution},
    {"rotation_initialization", rotation_initialization},
    {"total", full_optimization},
    {"update_and_downdate", update_and_downdate},
    {"relative_covariance", covariance},
    {"relative_covariances_to", covariances},
    {"marginals", marginals}};

void register_all() {
  for (const char* graph : kGraphs) {
    const auto path = test::find_recording(std::string("posegraph/") + graph + ".g2o");
    if (!path) continue;
    for (const auto& [name, measure] : kMeasures) {
      const std::string title = std::string(graph) + "/" + name;
      benchmark::RegisterBenchmark(title.c_str(), [run = measure,
                                                   file = *path](benchmark::State& state) {
        run(state, file);
      })->Unit(benchmark::kMillisecond);
    }
  }
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  adit::register_all();
  benchmark::RunSpecifiedBenchmarks();
}
