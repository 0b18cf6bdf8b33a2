// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/page/mission_summary.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tools/report/text_format.hpp"
#include "viewer/scene/json_text.hpp"

namespace adit {
namespace {

using Json = nlohmann::ordered_json;

struct Metric {
  std::string label;
  std::string value;
};
using Metrics = std::vector<Metric>;

/// How the mission ended, without a full stop.
std::string end_phrase(const MissionStatistics& statistics) {
  if (!statistics.last) return "The end of the mission is not in the log";
  switch (statistics.last->outcome) {
    case MissionOutcome::kHome:
      return never_left_start(*statistics.last) ? "The robot did not leave the start" : "Home";
    case MissionOutcome::kHomeUncertain:
      return "Home by its own estimate, not sure";
    case MissionOutcome::kStopped:
      return fmt::format("Stopped by order {} from the start",
                         metres(statistics.distance_from_start_m, 0));
    case MissionOutcome::kStranded:
      return fmt::format("Stranded {} from the start", metres(statistics.distance_from_start_m, 0));
    case MissionOutcome::kInProgress:
      return "The log ends during the mission";
  }
  return "";
}

std::string explored_phrase(const MissionStatistics& statistics) {
  if (!statistics.frontiers) return "";
  const std::string length = metres(statistics.explored_m.value_or(0.0), 0);
  const FrontierCounts& frontiers = *statistics.frontiers;
  if (frontiers.open == 0) return fmt::format("explored what it can reach, {} of tunnel", length);
  std::string phrase = fmt::format("explored {} of tunnel, not completely", length);
  const auto add = [&phrase](std::size_t count, const char* what) {
    if (count > 0) phrase += fmt::format(", {} {}", count_text(count, "frontier"), what);
  };
  add(frontiers.visitable, "still to be visited");
  add(frontiers.unconfirmed, "abandoned without evidence of a blockage");
  return phrase;
}

/// "water at 36 m"; what is not proven is said to be so.
std::string place_phrase(const Blockage& blockage) {
  return fmt::format("{} at {}", blockage.cause, metres(blockage.at_m, 0));
}

std::string blockages_phrase(const std::vector<Blockage>& blockages) {
  double seen_m = 0.0;
  double frontier_m = 0.0;
  for (const Blockage& blockage : blockages) {
    seen_m += blockage.seen_beyond_m;
    frontier_m += blockage.frontier_m;
  }
  const bool proven = std::ranges::all_of(blockages, &Blockage::is_proven);
  const std::string limit = proven ? "what blocks the tunnel" : "where no path was found";
  const std::string what = blockages.size() == 1
                               ? fmt::format("{} ({})", limit, place_phrase(blockages.front()))
                               : fmt::format("{} at {} places", limit, blockages.size());
  return fmt::format("{} seen beyond {}; {} of frontier behind it unknown", metres(seen_m, 0), what,
                     metres(frontier_m, 1));
}

std::string blockage_paragraph(const Blockage& blockage) {
  std::string ids;
  for (const int id : blockage.frontiers) ids += fmt::format("{}{}", ids.empty() ? "" : ", ", id);
  return fmt::format(
      "At {} of the distance travelled: {}{}. {} seen beyond it, {} of frontier behind it unknown "
      "(frontier {}).",
      metres(blockage.at_m, 0), blockage.cause,
      blockage.is_proven ? "" : ", which does not prove that there is none",
      metres(blockage.seen_beyond_m, 1), metres(blockage.frontier_m, 1), ids);
}

Json paragraphs(const MissionStatistics& statistics, const std::vector<Blockage>& blockages) {
  Json texts = Json::array({outcome_text(statistics)});
  if (!statistics.return_home_reason.empty()) {
    texts.push_back("It turned around because: " + sentence(statistics.return_home_reason));
  }
  for (const Blockage& blockage : blockages) texts.push_back(blockage_paragraph(blockage));
  return texts;
}

void add_state(const StateRecord& state, Metrics& metrics) {
  if (state.vehicle_first()) {
    metrics.push_back(
        {"battery", fmt::format("{} to {}", percent(state.vehicle_first()->battery_share),
                                percent(state.vehicle_last()->battery_share))});
  }
  if (const auto& gas = state.gas_extremes()) {
    metrics.push_back({"methane, maximum", percent(gas->methane_share)});
    metrics.push_back({"oxygen, minimum", percent(gas->oxygen_share)});
    metrics.push_back({"carbon monoxide, maximum",
                       fmt::format("{} ppm", fixed(1e6 * gas->carbon_monoxide_share, 0))});
  }
}

/// Errors against the simulated truth.
void add_truth(const MissionStatistics& statistics, Metrics& metrics) {
  if (const auto& score = statistics.score) {
    metrics.push_back({"error against truth, RMSE from the start",
                       fmt::format("{}, {} of the allowed", metres(score->anchored.rmse_m, 2),
                                   fixed(score->plan_of_allowed, 1))});
    metrics.push_back({"error against truth, maximum", metres(score->anchored.max_m, 2)});
  }
  if (const auto& consistency = statistics.consistency) {
    metrics.push_back(
        {"local maps in their 95 % ellipsoid",
         fmt::format("{} of {}", consistency->in_ellipsoid, consistency->local_maps)});
  }
  if (statistics.failure) {
    metrics.push_back({"collisions", statistics.failure->empty() ? "none" : "yes"});
  }
}

Metrics metrics_of(const MissionRecords& records, const MissionStatistics& statistics) {
  Metrics metrics{{"began", date_text(statistics.from_utime)},
                  {"duration", duration_text(statistics.duration_s())},
                  {"distance travelled", metres(statistics.distance_travelled_m)},
                  {"largest distance from the start", metres(statistics.farthest_m)}};
  if (statistics.explored_m) metrics.push_back({"explored", metres(*statistics.explored_m)});
  if (const auto& frontiers = statistics.frontiers) {
    metrics.push_back(
        {"frontiers closed", fmt::format("{} of {}", frontiers->closed, frontiers->found)});
  }
  metrics.push_back({"3D scans, without a path",
                     fmt::format("{}, {}", statistics.scans, statistics.scans_without_path)});
  metrics.push_back({"local maps", fmt::to_string(statistics.local_maps)});
  metrics.push_back({"loop closures accepted, revoked",
                     fmt::format("{}, {}", statistics.loop_closures.accepted, statistics.revoked)});
  metrics.push_back({"stops by the guard",
                     fmt::format("{}, {}", statistics.stops, duration_text(statistics.stopped_s))});
  const std::string time = time_text(statistics.budget);
  if (!time.empty()) metrics.push_back({"time", time});
  metrics.push_back({"restarts and timeouts", fmt::to_string(statistics.restarts)});
  add_state(records.state, metrics);
  add_truth(statistics, metrics);
  if (!statistics.version.empty()) metrics.push_back({"version", statistics.version});
  return metrics;
}

Json files() {
  constexpr std::pair<const char*, const char*> kFiles[] = {
      {"map.png, map.svg", "map with the path of the robot"},
      {"map.pgm, map.yaml", "the same for Nav2's map_server"},
      {"cloud.ply, volume.bt", "points of all 3D scans; OctoMap of the mine"},
      {"trajectory.tum, graph.g2o", "path of the robot; pose graph"},
      {"junctions.geojson", "corridors, junctions, frontiers"},
      {"summary.json", "figures of the mission"},
      {"run.lcmlog", "every message"}};
  Json list = Json::array();
  for (const auto& [name, note] : kFiles) list.push_back({{"name", name}, {"note", note}});
  return list;
}

std::string configuration_text(const LogInfo& log_info) {
  std::string text;
  for (const auto& [stage, config] : log_info.configs) {
    text += fmt::format("# {} ({})\n{}\n", stage, config.version, config.yaml);
  }
  return text;
}

}  // namespace

std::string headline(const MissionStatistics& statistics, const std::vector<Blockage>& blockages) {
  std::string text = end_phrase(statistics);
  const std::string explored = explored_phrase(statistics);
  if (!explored.empty()) text += "; " + explored;
  if (!blockages.empty()) text += ". " + blockages_phrase(blockages);
  return sentence(text);
}

std::string summary_message(const MissionRecords& records, const MissionStatistics& statistics,
                            const std::vector<Blockage>& blockages,
                            const std::vector<std::string>& warnings) {
  Json metrics = Json::array();
  for (const Metric& metric : metrics_of(records, statistics)) {
    metrics.push_back({{"label", metric.label}, {"value", metric.value}});
  }
  Json sentences = Json::array();
  for (const std::string& warning : warnings) sentences.push_back(sentence(warning));
  const Json summary{{"headline", headline(statistics, blockages)},
                     {"paragraphs", paragraphs(statistics, blockages)},
                     {"metrics", std::move(metrics)},
                     {"warnings", std::move(sentences)},
                     {"files", files()},
                     {"configuration", configuration_text(records.log_info)}};
  return json_text(summary);
}

}  // namespace adit
