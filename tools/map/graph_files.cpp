// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/graph_files.hpp"

#include <map>
#include <set>
#include <utility>

#include "common/files/text_file.hpp"
#include "tools/map/association_table.hpp"

namespace adit {
namespace {

using Edge = GraphPicture::Edge;

Edge edge_of(const MapGraph& graph, int from, int to) {
  return {graph.poses[static_cast<std::size_t>(from)].translation(),
          graph.poses[static_cast<std::size_t>(to)].translation()};
}

/// What is chosen for each closure at the end.
std::map<int, int> last_choices(const WholeMap& map) {
  std::map<int, int> chosen;
  for (const Association* a : map.associations) chosen[a->closure.id] = a->chosen;
  return chosen;
}

std::vector<Edge> revoked_edges(const WholeMap& map) {
  const std::map<int, int> in_force = last_choices(map);
  std::set<std::pair<int, int>> revoked;  // older, newer
  for (const Association* a : map.associations) {
    if (a->action != Association::Action::kRevised || a->chosen_before == Association::kNone ||
        in_force.at(a->closure.id) == a->chosen_before) {
      continue;
    }
    const auto& before = a->closure.alternatives[static_cast<std::size_t>(a->chosen_before)];
    revoked.insert({before.older_map, a->closure.newer_map});
  }
  std::vector<Edge> edges;
  for (const auto& [older, newer] : revoked) edges.push_back(edge_of(map.graph, older, newer));
  return edges;
}

}  // namespace

G2oGraph g2o_of(const MapGraph& graph) {
  G2oGraph g2o;
  g2o.graph.poses = graph.poses;
  for (std::size_t i = 0; i < graph.poses.size(); ++i) g2o.ids.push_back(static_cast<long>(i));
  for (const auto& constraint : graph.constraints) {
    g2o.graph.constraints.push_back(constraint.measured);
  }
  return g2o;
}

void write_graph_files(const WholeMap& map, const std::filesystem::path& folder) {
  write_g2o(g2o_of(map.graph), folder / "graph.g2o");
  write_text(association_table(map), folder / "associations.tsv");
}

GraphPicture graph_picture(const WholeMap& map) {
  GraphPicture picture;
  picture.nodes = map.graph.poses;
  for (const auto& [measured, kind] : map.graph.constraints) {
    const Edge edge = edge_of(map.graph, measured.from, measured.to);
    if (kind == MapConstraint::Kind::kClosure) {
      picture.closures.push_back(edge);
    } else if (map.local_maps[static_cast<std::size_t>(measured.from)]->session ==
               map.local_maps[static_cast<std::size_t>(measured.to)]->session) {
      picture.sequential.push_back(edge);
    }
  }
  picture.revoked = revoked_edges(map);
  return picture;
}

}  // namespace adit
