// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/graphs/labelled_graph.hpp"

#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/pose_graph/g2o_file.hpp"
#include "tools/carmen/gzip_line_reader.hpp"
#include "tools/eval/path_error.hpp"

namespace adit::test {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

void for_each_line(const std::filesystem::path& path,
                   const std::function<void(std::istringstream&)>& use) {
  GzipLineReader lines(path);
  while (const auto line = lines.next()) {
    if (!line->error.empty())
      throw std::runtime_error(path.string() + ": " + std::string(line->error));
    if (line->text.starts_with('#')) continue;
    std::istringstream words{std::string(line->text)};
    use(words);
  }
  if (!lines.damage().empty()) throw std::runtime_error(path.string() + ": is damaged");
}

LoopLabel label_of(const std::string& verdict) {
  if (verdict == "ok") return LoopLabel::kRight;
  return verdict == "wrong" ? LoopLabel::kWrong : LoopLabel::kUnknown;
}

Trajectory trajectory(const LabelledGraph& graph, const std::function<Pose2(std::size_t)>& pose) {
  Trajectory result;
  for (std::size_t i = 0; i < graph.true_nodes.size(); ++i) {
    result.push_back({graph.true_nodes[i], pose(i)});
  }
  return result;
}

}  // namespace

LabelledGraph read_labelled_graph(const std::filesystem::path& g2o,
                                  const std::filesystem::path& ground_truth) {
  G2oGraph file = read_g2o(g2o);
  LabelledGraph result;
  std::map<long, int> node_of;
  for (const long id : file.ids) node_of.emplace(id, static_cast<int>(node_of.size()));
  std::map<std::pair<long, long>, std::size_t> constraint_of;
  for (std::size_t k = 0; k < file.graph.constraints.size(); ++k) {
    const PoseConstraint& c = file.graph.constraints[k];
    constraint_of[{file.ids[at(c.from)], file.ids[at(c.to)]}] = k;
  }
  result.graph = std::move(file.graph);
  result.labels.assign(result.graph.constraints.size(), LoopLabel::kNone);
  for_each_line(std::filesystem::path(g2o).replace_extension(".labels"), [&](auto& words) {
    long from = 0;
    long to = 0;
    std::string verdict;
    if (!(words >> from >> to >> verdict)) return;
    const auto k = constraint_of.find({from, to});
    if (k == constraint_of.end())
      throw std::runtime_error("a label has no loop closure in the graph");
    result.labels[k->second] = label_of(verdict);
  });
  for_each_line(ground_truth, [&](auto& words) {
    long id = 0;
    Pose2 pose;
    if (!(words >> id >> pose.x >> pose.y >> pose.theta) || !node_of.contains(id)) return;
    result.true_nodes.push_back(node_of.at(id));
    result.truth.push_back(pose);
  });
  return result;
}

int count_accepted(const LabelledGraph& graph, const std::vector<bool>& accepted, LoopLabel label) {
  int count = 0;
  for (std::size_t k = 0; k < accepted.size(); ++k) {
    count += accepted[k] && graph.labels[k] == label ? 1 : 0;
  }
  return count;
}

double rmse_m(const LabelledGraph& graph, const std::vector<Pose2>& poses) {
  const auto found = [&](std::size_t i) { return poses[at(graph.true_nodes[i])]; };
  const auto truth = [&](std::size_t i) { return graph.truth[i]; };
  return path_error(trajectory(graph, found), trajectory(graph, truth)).rmse_m;
}

}  // namespace adit::test
