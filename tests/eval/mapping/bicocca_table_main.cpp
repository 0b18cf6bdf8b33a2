// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// bicocca_table: compares methods of loop closure selection on loops of place recognition, a third
// of them wrong, as a table in Markdown. Each method selects the accepted constraints. These are
// then optimized once by plain least squares and once as in lazy data association, so that the
// errors are comparable.
#include <chrono>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/pose_graph/optimize.hpp"
#include "procs/mapping/association/finished_graph/lazy_loop_closures.hpp"
#include "tests/eval/mapping/robust_kernels.hpp"
#include "tests/eval/markdown.hpp"
#include "tests/support/graphs/labelled_graph.hpp"
#include "tests/support/recordings.hpp"

namespace adit {
namespace {

using test::LabelledGraph;
using test::LoopLabel;

struct Method {
  const char* name;
  std::function<std::vector<bool>(const LabelledGraph&)> select_loops;
};

std::vector<bool> lazy(const PoseGraph& graph, bool best_first) {
  LazyAssociationParams params;
  params.best_first = best_first;
  return associate_loops_lazily(graph, params).accepted;
}

template <class LoopSelection>
std::vector<bool> accept_if(const LabelledGraph& labelled, const LoopSelection& accepts) {
  std::vector<bool> accepted;
  for (const LoopLabel label : labelled.labels) accepted.push_back(accepts(label));
  return accepted;
}

const std::vector<Method>& methods() {
  static const std::vector<Method> all = {
      {"no loops",
       [](const auto& l) {
         return accept_if(l, [](LoopLabel label) { return label == LoopLabel::kNone; });
       }},
      {"least squares", [](const auto& l) { return accept_if(l, [](LoopLabel) { return true; }); }},
      {"Huber", [](const auto& l) { return accepted_by_huber(l.graph); }},
      {"DCS", [](const auto& l) { return accepted_by_dcs(l.graph); }},
      {"**lazy**", [](const auto& l) { return lazy(l.graph, true); }},
      {"lazy, paper's order", [](const auto& l) { return lazy(l.graph, false); }},
      {"ground truth", [](const auto& l) {
         return accept_if(l, [](LoopLabel label) {
           return label == LoopLabel::kNone || label == LoopLabel::kRight;
         });
       }}};
  return all;
}

double plain_rmse_m(const LabelledGraph& labelled, const std::vector<bool>& accepted) {
  PoseGraph accepted_graph{labelled.graph.poses, {}};
  for (std::size_t k = 0; k < accepted.size(); ++k) {
    if (accepted[k]) accepted_graph.constraints.push_back(labelled.graph.constraints[k]);
  }
  optimize(accepted_graph, {});
  return test::rmse_m(labelled, accepted_graph.poses);
}

double weighted_rmse_m(const LabelledGraph& labelled, const std::vector<bool>& accepted) {
  PoseGraph graph = labelled.graph;
  optimize_accepted(graph, accepted);
  return test::rmse_m(labelled, graph.poses);
}

void print_row(const std::string& name, const LabelledGraph& labelled, const Method& method) {
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<bool> accepted = method.select_loops(labelled);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  std::printf("| %s | %s | %d | %d | %d | %.2f | %.2f | %.2f |\n", name.c_str(), method.name,
              test::count_accepted(labelled, accepted, LoopLabel::kRight),
              test::count_accepted(labelled, accepted, LoopLabel::kWrong),
              test::count_accepted(labelled, accepted, LoopLabel::kUnknown),
              plain_rmse_m(labelled, accepted), weighted_rmse_m(labelled, accepted), wall.count());
  std::fflush(stdout);
}

void print_graph(const std::string& name) {
  const auto g2o = test::find_recording("posegraph/" + name + ".g2o");
  const auto truth = test::find_recording("posegraph/bicocca_ground_truth.txt.gz");
  if (!g2o || !truth) {
    std::cerr << "recording " << name << " not found; set ADIT_DATA\n";
    return;
  }
  LabelledGraph labelled = test::read_labelled_graph(*g2o, *truth);
  chain_odometry(labelled.graph);  // initial guess of all methods
  for (const Method& method : methods()) print_row(name, labelled, method);
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app("Compares selection methods on loops of place recognition, as a table in Markdown");
  std::vector<std::string> graphs = {"bicocca_0.150", "bicocca_0.500"};
  app.add_option("--graphs", graphs, "Names of the recorded graphs")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  adit::print_heading(
      "| graph | method | right accepted | wrong accepted | unknown accepted "
      "| RMSE, unweighted (m) | RMSE, loops weighted by fit (m) | selection time (s) |");
  for (const std::string& graph : graphs) adit::print_graph(graph);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "bicocca_table: " << error.what() << "\n";
  return 2;
}
