// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// generated_graphs_table: compares methods of loop closure selection on generated pose graphs with
// wrong loop closures and known truth, one row per seed and method, as CSV.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <exception>
#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "procs/mapping/association/finished_graph/lazy_loop_closures.hpp"
#include "tests/eval/mapping/robust_kernels.hpp"
#include "tests/support/graphs/generated_graph.hpp"

namespace adit {
namespace {

using test::LabelledGraph;
using test::LoopLabel;

/// Which constraints are accepted, and whether the method says that it may be wrong.
struct Selection {
  std::vector<bool> accepted;
  bool is_doubtful = false;
  std::vector<Pose2> start;  ///< of the optimisation under them; empty: from rotation averaging
};

struct Method {
  const char* name;
  std::function<Selection(const LabelledGraph&)> select;
};

const std::vector<Method>& methods() {
  static const std::vector<Method> all = {
      {"truth",
       [](const LabelledGraph& l) {
         std::vector<bool> accepted;
         for (const LoopLabel label : l.labels) accepted.push_back(label != LoopLabel::kWrong);
         return Selection{std::move(accepted), false, l.truth};
       }},
      {"lazy",
       [](const LabelledGraph& l) {
         LazyLoopClosuresResult result = associate_loops_lazily(l.graph, {});
         PoseGraph graph = l.graph;
         const double objective = optimize_accepted(graph, result).objective;
         const bool is_doubtful = !result.doubts.empty() || doubt_of_misfit(result, objective);
         return Selection{std::move(result.accepted), is_doubtful, std::move(result.T_map_node)};
       }},
      {"gnc",
       [](const LabelledGraph& l) {
         return Selection{accepted_by_gnc(l.graph), false, {}};
       }},
      {"dcs", [](const LabelledGraph& l) {
         return Selection{accepted_by_dcs(l.graph), false, {}};
       }}};
  return all;
}

double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double rmse_m(const LabelledGraph& labelled, const Selection& selection) {
  PoseGraph graph = labelled.graph;
  const bool has_start = !selection.start.empty();
  if (has_start) graph.poses = selection.start;
  optimize_accepted(graph, selection.accepted, {}, has_start);
  return test::rmse_m(labelled, graph.poses);
}

void print_row(const test::GraphScenario& scenario, const LabelledGraph& labelled,
               const Method& method) {
  const double begin = cpu_s();
  const Selection selection = method.select(labelled);
  const double took_s = cpu_s() - begin;
  const auto count = [&](LoopLabel label) {
    return static_cast<int>(std::count(labelled.labels.begin(), labelled.labels.end(), label));
  };
  std::printf("%u,%s,%s,%zu,%d,%d,%.4f,%s,%d,%d,%.3f,%.2f,%d\n", scenario.seed,
              test::text(scenario.world).c_str(), test::text(scenario.wrong).c_str(),
              labelled.graph.poses.size(), count(LoopLabel::kRight), count(LoopLabel::kWrong),
              scenario.drift, method.name,
              test::count_accepted(labelled, selection.accepted, LoopLabel::kRight),
              test::count_accepted(labelled, selection.accepted, LoopLabel::kWrong),
              rmse_m(labelled, selection), took_s, selection.is_doubtful ? 1 : 0);
  std::fflush(stdout);
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app("Compares selection methods on generated pose graphs, as CSV");
  std::uint32_t first = 1;
  std::uint32_t count = 200;
  std::uint32_t step = 1;
  std::vector<std::string> only = {"truth", "lazy"};
  int poses = 0;
  int right = 0;
  double wrong_share = -1.0;
  bool lose_heading = false;
  app.add_option("--first", first, "First seed")->capture_default_str();
  app.add_option("--count", count, "Number of seeds")->capture_default_str();
  app.add_option("--step", step, "Difference of seeds")->capture_default_str();
  app.add_option("--only", only, "Methods: truth, lazy, gnc, dcs")->capture_default_str();
  app.add_option("--poses", poses, "Number of poses (default: drawn)");
  app.add_option("--right", right, "Number of right loop closures (default: drawn)");
  app.add_option("--wrong-share", wrong_share, "Share of wrong loop closures (default: drawn)");
  app.add_flag("--lose-heading", lose_heading, "With an odometry that errs by 0.2 rad per metre");
  CLI11_PARSE(app, argc, argv);
  std::cout << "seed,world,wrong loops,poses,right,wrong,drift,method,right accepted,"
               "wrong accepted,RMSE (m),CPU (s),doubtful"
            << std::endl;
  for (std::uint32_t i = 0; i < count; ++i) {
    adit::test::GraphScenario scenario = adit::test::random_scenario(first + i * step);
    if (poses > 0) scenario.poses = poses;
    if (right > 0) scenario.right = right;
    if (wrong_share >= 0.0) scenario.wrong_share = wrong_share;
    adit::test::LabelledGraph labelled = adit::test::generated_graph(scenario);
    if (lose_heading) adit::test::lose_heading(labelled, scenario.seed);
    for (const adit::Method& method : adit::methods()) {
      if (std::find(only.begin(), only.end(), method.name) == only.end()) continue;
      adit::print_row(scenario, labelled, method);
    }
  }
  return 0;
} catch (const std::exception& error) {
  std::cerr << "generated_graphs_table: " << error.what() << "\n";
  return 2;
}
