// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// wrong_loops_table: compares methods of loop closure selection on public pose graphs with added
// wrong loop closures, as a table in Markdown. Each method selects the accepted constraints. These
// are then optimized in the same manner for all methods, so that the errors are comparable. The
// reference is the certified optimum of the graph without wrong loop closures.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/pose_graph/certified_optimum.hpp"
#include "common/pose_graph/g2o_file.hpp"
#include "common/pose_graph/optimize.hpp"
#include "procs/mapping/association/finished_graph/lazy_loop_closures.hpp"
#include "tests/eval/mapping/robust_kernels.hpp"
#include "tests/eval/markdown.hpp"
#include "tests/support/graphs/synthetic_graphs.hpp"
#include "tests/support/recordings.hpp"
#include "tools/eval/path_error.hpp"

namespace adit {
namespace {

/// Which constraints are accepted, and whether the method says that it may be wrong.
struct Selection {
  std::vector<bool> accepted;
  bool is_doubtful = false;
};

struct Method {
  const char* name;
  std::function<Selection(const PoseGraph&)> select;
};

Selection accept_all(const PoseGraph& graph) {
  return {std::vector<bool>(graph.constraints.size(), true), false};
}

Selection select_lazily(const PoseGraph& graph, bool best_first) {
  LazyAssociationParams params;
  params.best_first = best_first;
  const LazyLoopClosuresResult result = associate_loops_lazily(graph, params);
  PoseGraph optimized = graph;
  const double objective = optimize_accepted(optimized, result).objective;
  return {result.accepted, !result.doubts.empty() || doubt_of_misfit(result, objective)};
}

const std::vector<Method>& methods() {
  static const std::vector<Method> all = {
      {"least squares", accept_all},
      {"Huber",
       [](const PoseGraph& graph) {
         return Selection{accepted_by_huber(graph), false};
       }},
      {"DCS",
       [](const PoseGraph& graph) {
         return Selection{accepted_by_dcs(graph), false};
       }},
      {"GNC",
       [](const PoseGraph& graph) {
         return Selection{accepted_by_gnc(graph), false};
       }},
      {"lazy", [](const PoseGraph& graph) { return select_lazily(graph, true); }},
      {"lazy, paper's order", [](const PoseGraph& graph) { return select_lazily(graph, false); }}};
  return all;
}

/// A graph at its optimum, and wrong loops to add.
struct Trial {
  std::string graph_name;
  std::string kind;
  const PoseGraph& clean;
  std::vector<PoseConstraint> wrong;
};

/// RMSE of the node positions from those of the clean graph, after rigid alignment [m].
double rmse_m(const std::vector<Pose2>& poses, const std::vector<Pose2>& reference) {
  const auto trajectory = [](const std::vector<Pose2>& nodes) {
    Trajectory result;
    for (const Pose2& node : nodes) {
      result.push_back({static_cast<std::int64_t>(result.size()), node});
    }
    return result;
  };
  return path_error(trajectory(poses), trajectory(reference)).rmse_m;
}

double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Counts of loops, without odometry constraints.
struct Count {
  int right = 0;
  int right_accepted = 0;
  int wrong_accepted = 0;
};

Count count_loops(const Trial& trial, const std::vector<bool>& accepted) {
  Count count;
  for (std::size_t i = 0; i < accepted.size(); ++i) {
    const bool wrong = i >= trial.clean.constraints.size();
    if (!wrong && !test::is_loop(trial.clean.constraints[i])) continue;
    count.right += wrong ? 0 : 1;
    if (accepted[i]) ++(wrong ? count.wrong_accepted : count.right_accepted);
  }
  return count;
}

PoseGraph accepted_graph(const PoseGraph& graph, const std::vector<bool>& accepted) {
  PoseGraph result{graph.poses, {}};
  for (std::size_t i = 0; i < accepted.size(); ++i) {
    if (accepted[i]) result.constraints.push_back(graph.constraints[i]);
  }
  return result;
}

double ratio(int count, int total) {
  return total > 0 ? static_cast<double>(count) / static_cast<double>(total) : 1.0;
}

void print_row(const Trial& trial, const Method& method) {
  PoseGraph graph = trial.clean;
  graph.constraints.insert(graph.constraints.end(), trial.wrong.begin(), trial.wrong.end());
  chain_odometry(graph);  // initial guess of all methods
  const double begin_s = cpu_s();
  const auto [accepted, is_doubtful] = method.select(graph);
  const double selected_s = cpu_s();
  const Count count = count_loops(trial, accepted);
  PoseGraph optimized = accepted_graph(graph, accepted);
  double objective = optimize(optimized, {}).objective;
  const double optimized_s = cpu_s();
  const bool certifies = count.wrong_accepted == 0 && has_implausible_residual(optimized);
  if (certifies) objective = certify(optimized).objective;
  std::printf("| %s | %zu, %s | %s | %.4f | %.4f | %.7g | %.3f | %.2f | %.2f | %s |\n",
              trial.graph_name.c_str(), trial.wrong.size(), trial.kind.c_str(), method.name,
              ratio(count.right_accepted, count.right_accepted + count.wrong_accepted),
              ratio(count.right_accepted, count.right), objective,
              rmse_m(optimized.poses, trial.clean.poses), selected_s - begin_s,
              optimized_s - selected_s, is_doubtful ? "yes" : "");
  std::fflush(stdout);
}

struct Options {
  std::vector<std::string> graphs = {"intel", "manhattan"};
  std::vector<int> counts = {0, 10, 100, 1000};
  std::vector<std::string> kinds = {"random", "groups"};
  std::vector<std::string> only;  // names of methods; empty: all
  std::uint32_t seed = 1;
  bool no_head = false;
};

void print_trial(const Trial& trial, const Options& options) {
  for (const Method& method : methods()) {
    const auto& only = options.only;
    const bool requested =
        only.empty() || std::find(only.begin(), only.end(), method.name) != only.end();
    if (requested) print_row(trial, method);
  }
}

void print_graph(const std::string& name, const Options& options) {
  const auto path = test::find_recording("posegraph/" + name + ".g2o");
  if (!path) {
    std::cerr << "recording " << name << " not found; set ADIT_DATA\n";
    return;
  }
  PoseGraph clean = read_g2o(*path).graph;
  optimize(clean, {});
  certify(clean);
  for (const int count : options.counts) {
    for (const std::string& kind : options.kinds) {
      const bool consistent = kind == "groups";
      if (count == 0 && consistent) continue;
      const auto make = consistent ? test::consistent_wrong_loops : test::random_wrong_loops;
      print_trial(
          {name, consistent ? "in groups" : "at random", clean, make(clean, count, options.seed)},
          options);
    }
  }
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app(
      "Compares selection methods on pose graphs with added wrong loops, as a table in Markdown");
  adit::Options options;
  app.add_option("--graphs", options.graphs, "Names of the recorded graphs")->capture_default_str();
  app.add_option("--counts", options.counts, "Numbers of wrong loops")->capture_default_str();
  app.add_option("--kinds", options.kinds, "Kinds of wrong loops")
      ->check(CLI::IsMember({"random", "groups"}))
      ->capture_default_str();
  app.add_option("--only", options.only, "Names of the methods (default: all)");
  app.add_option("--seed", options.seed, "Seed of the wrong loops")->capture_default_str();
  app.add_flag("--no-head", options.no_head, "Omit the table heading");
  CLI11_PARSE(app, argc, argv);
  if (!options.no_head) {
    adit::print_heading(
        "| graph | wrong loops | method | precision | recall | objective | RMSE (m) "
        "| selection, CPU (s) | optimum, CPU (s) | doubtful |");
  }
  for (const std::string& graph : options.graphs) adit::print_graph(graph, options);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "wrong_loops_table: " << error.what() << "\n";
  return 2;
}
