// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/merge/merge_summary.hpp"

#include <nlohmann/json.hpp>

namespace adit {
namespace {

using Json = nlohmann::ordered_json;

Json pose_json(const Pose2& pose) {
  return {{"x_m", pose.x}, {"y_m", pose.y}, {"theta_rad", pose.theta}};
}

Json evidence_json(const RunJoin& join) {
  return {{"joined", join.joined},
          {"reason", join.reason},
          {"searched_pairs", join.searched},
          {"possible_poses", join.found},
          {"agreeing", join.agreeing},
          {"places", join.places},
          {"other_alignments", join.rivals},
          {"links", join.links.size()},
          {"rejected_links", join.rejected},
          {"walls_compared_m", join.observed_m},
          {"contradicting_share", join.contradicting_share()},
          {"walls_apart_m", join.walls_apart_m},
          {"walls_apart_within_m", join.own_apart_m}};
}

/// The run of a local map of a group, and its number there.
Json local_map_json(const RunGroup& group, int map) {
  for (const PlacedRun& placed : group.runs) {
    if (map >= placed.first_map && map < placed.first_map + placed.maps)
      return {{"run", placed.run + 1}, {"local_map", map - placed.first_map}};
  }
  return nullptr;
}

Json join_json(const RunGroup& group, const PlacedRun& placed) {
  Json json = evidence_json(*placed.join);
  json["run"] = placed.run + 1;
  Json links = Json::array();
  for (const JoinLink& link : placed.join->links) {
    links.push_back({{"older", local_map_json(group, link.older)},
                     {"newer", local_map_json(group, link.newer)},
                     {"T_older_newer", pose_json(link.T_older_newer)},
                     {"log_likelihood", link.log_likelihood}});
  }
  json["link_list"] = std::move(links);
  return json;
}

Json groups_json(const MergeSummary& summary) {
  Json maps = Json::array();
  for (const RunGroup& group : summary.groups->groups()) {
    Json runs = Json::array();
    Json joins = Json::array();
    for (const PlacedRun& placed : group.runs) {
      runs.push_back({{"run", placed.run + 1},
                      {"first_local_map", placed.first_map},
                      {"local_maps", placed.maps},
                      {"sessions", placed.sessions}});
      if (placed.join) joins.push_back(join_json(group, placed));
    }
    maps.push_back({{"runs", std::move(runs)}, {"joins", std::move(joins)}});
  }
  return maps;
}

Json changes_json(const MergeSummary& summary) {
  Json list = Json::array();
  if (summary.groups->groups().empty()) return list;
  const RunGroup& group = summary.groups->groups().front();
  const auto numbers = [&](const std::vector<std::size_t>& placed) {
    Json runs = Json::array();
    for (const std::size_t i : placed) runs.push_back(group.runs[i].run + 1);
    return runs;
  };
  for (const MapChange& change : summary.changes) {
    list.push_back({{"kind", kind_text(change.kind)},
                    {"x_m", change.p_map.x()},
                    {"y_m", change.p_map.y()},
                    {"width_m", change.size_m.x()},
                    {"height_m", change.size_m.y()},
                    {"cells", change.cells.size()},
                    {"wall_runs", numbers(change.wall_runs)},
                    {"free_runs", numbers(change.free_runs)}});
  }
  return list;
}

}  // namespace

std::string merge_summary_json(const MergeSummary& summary) {
  Json runs = Json::array();
  for (std::size_t i = 0; i < summary.runs.size(); ++i) {
    std::size_t map = 0;
    for (std::size_t k = 0; k < summary.groups->groups().size(); ++k) {
      for (const PlacedRun& placed : summary.groups->groups()[k].runs) {
        if (placed.run == i) map = k;
      }
    }
    runs.push_back({{"run", i + 1},
                    {"name", summary.runs[i].name},
                    {"map", map + 1},
                    {"warnings", summary.warnings[i]}});
  }
  Json rejected = Json::array();
  for (const RejectedJoin& attempt : summary.groups->rejected()) {
    Json json = evidence_json(attempt.join);
    json["run"] = attempt.run + 1;
    json["to_map_of_run"] = attempt.to_run + 1;
    rejected.push_back(std::move(json));
  }
  const Json json = {{"runs", std::move(runs)},
                     {"maps", groups_json(summary)},
                     {"rejected", std::move(rejected)},
                     {"changes", changes_json(summary)},
                     {"optimum",
                      {{"objective", summary.optimum.objective},
                       {"lower_bound", summary.optimum.lower_bound},
                       {"is_global", summary.optimum.is_global},
                       {"constraints", summary.constraints}}},
                     {"journal", summary.has_journal},
                     {"wall_s", summary.wall_s}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace adit
