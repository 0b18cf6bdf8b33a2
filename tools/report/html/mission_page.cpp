// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/html/mission_page.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tools/map/map_files.hpp"
#include "tools/report/html/markup.hpp"
#include "tools/report/html/text_format.hpp"

namespace adit {
namespace {

HtmlMetrics headline_metrics(const MissionStatistics& statistics) {
  HtmlMetrics metrics{{"Duration", duration_text(statistics.duration_s())},
                      {"Distance travelled", metres(statistics.distance_travelled_m)},
                      {"Largest distance from the start", metres(statistics.farthest_m)},
                      {"3D scans", fmt::to_string(statistics.scans)}};
  if (statistics.explored_m) {
    metrics.emplace_back("Corridors explored", metres(*statistics.explored_m));
  }
  if (const auto& frontiers = statistics.frontiers) {
    metrics.emplace_back("Frontiers closed",
                         fmt::format("{} of {}", frontiers->closed, frontiers->found));
  }
  metrics.emplace_back("Loop closures accepted", fmt::to_string(statistics.loop_closures.accepted));
  if (statistics.revoked > 0) {
    metrics.emplace_back("Loop closures revoked", fmt::to_string(statistics.revoked));
  }
  if (statistics.score) {
    metrics.emplace_back("RMSE of the trajectory", metres(statistics.score->aligned.rmse_m, 2));
  }
  if (statistics.failure) {
    metrics.emplace_back("Collisions", statistics.failure->empty() ? "none" : "yes");
  }
  return metrics;
}

HtmlMetrics map_metrics(const MissionStatistics& statistics) {
  HtmlMetrics metrics{{"Local maps", fmt::to_string(statistics.local_maps)},
                      {"Loop closures proposed", fmt::to_string(statistics.loop_closures.proposed)},
                      {"Loop closures accepted", fmt::to_string(statistics.loop_closures.accepted)},
                      {"Decisions revised", fmt::to_string(statistics.loop_closures.revised)},
                      {"Loop closures revoked", fmt::to_string(statistics.revoked)},
                      {"Stretches on which the map contradicts itself",
                       fmt::to_string(statistics.contradictory.size())},
                      {"Scans without a path", fmt::to_string(statistics.scans_without_path)},
                      {"Stops by the guard", fmt::format("{}, {}", statistics.stops,
                                                         duration_text(statistics.stopped_s))},
                      {"Restarts and timeouts", fmt::to_string(statistics.restarts)}};
  if (statistics.score) {
    metrics.emplace_back("Largest trajectory error", metres(statistics.score->aligned.max_m, 2));
    metrics.emplace_back("RMSE, anchored at the start",
                         metres(statistics.score->anchored.rmse_m, 2));
    if (statistics.score->heights) {
      metrics.emplace_back("RMSE in height, anchored",
                           metres(statistics.score->anchored.z.rmse_m, 2));
    }
    metrics.emplace_back("True path length", metres(statistics.score->true_length_m));
  }
  if (const auto& consistency = statistics.consistency) {
    metrics.emplace_back(
        "In their 95 % ellipsoid",
        fmt::format("{} of {} local maps", consistency->in_ellipsoid, consistency->local_maps));
  }
  return metrics;
}

void add_state(const StateRecord& state, HtmlMetrics& metrics) {
  if (state.vehicle_first()) {
    metrics.emplace_back("Battery",
                         fmt::format("{} to {}", percent(state.vehicle_first()->battery_share),
                                     percent(state.vehicle_last()->battery_share)));
  }
  if (!state.gas_extremes()) return;
  metrics.emplace_back("Methane, maximum", percent(state.gas_extremes()->methane_share));
  metrics.emplace_back("Oxygen, minimum", percent(state.gas_extremes()->oxygen_share));
  metrics.emplace_back(
      "Carbon monoxide, maximum",
      fmt::format("{} ppm", fixed(1e6 * state.gas_extremes()->carbon_monoxide_share, 0)));
}

/// The main figures; the other figures in a closed <details>.
std::string metrics_html(const MissionStatistics& statistics, const MissionRecords& records) {
  HtmlMetrics more = map_metrics(statistics);
  add_state(records.state, more);
  if (!statistics.version.empty()) more.emplace_back("Version", escaped(statistics.version));
  return html_metrics(headline_metrics(statistics)) +
         html_details("More figures", html_metrics(more));
}

/// All frontiers with state and evidence, open ones first.
std::string frontiers_html(const MissionRecords& records) {
  const auto& report = records.state.exploration();
  if (!report) return "<p>The log has no EXPLORATION.</p>";
  std::vector<Frontier> frontiers = report->frontiers;
  std::stable_sort(frontiers.begin(), frontiers.end(), [](const Frontier& a, const Frontier& b) {
    return is_closed(a.state) < is_closed(b.state);
  });
  std::vector<HtmlRow> rows;
  for (const Frontier& frontier : frontiers) {
    rows.push_back(
        {{fmt::to_string(frontier.id), escaped(name_of(frontier.state)),
          fmt::format("{}, {}", fixed(frontier.p_map.x(), 1), fixed(frontier.p_map.y(), 1)),
          metres(frontier.width_m), frontier.utime > 0 ? clock_text(frontier.utime) : "",
          escaped(sentence(frontier.evidence))},
         fmt::format(R"(id="frontier-{}" class="{}")", frontier.id,
                     is_closed(frontier.state) ? "closed" : "open")});
  }
  if (rows.empty()) return "<p>No frontiers were found.</p>";
  const std::string summary =
      report->decision.complete
          ? "<p>The exploration is complete: every frontier is closed, with the evidence below.</p>"
          : "<p>The exploration is not complete. Open frontiers remain for another mission.</p>";
  return summary +
         html_table("Frontiers with state and evidence",
                    {"no.", "state", "x, y in the map [m]", "width", "since (UTC)", "evidence"},
                    rows);
}

std::string older_map_of(const Association& a) {
  const int index = a.chosen != Association::kNone ? a.chosen : a.previously_chosen;
  const auto i = static_cast<std::size_t>(std::max(index, 0));
  if (i >= a.loop_closure.alternatives.size()) return "";
  return fmt::to_string(a.loop_closure.alternatives[i].older_map);
}

/// Decisions of data association, in order of time.
std::string loop_closures_html(const MissionMap& map) {
  std::vector<HtmlRow> rows;
  for (const Association* a : map.full_map().associations) {
    const std::string decision = decision_text(*a);
    rows.push_back({{clock_text(a->utime), decision, fmt::to_string(a->loop_closure.newer_map),
                     older_map_of(*a), fmt::to_string(a->loop_closure.alternatives.size()),
                     escaped(sentence(a->reason))},
                    decision == "revoked" ? "class=\"revoked\"" : ""});
  }
  if (rows.empty()) return "<p>No loop closures were proposed.</p>";
  return html_details(
      fmt::format("All decisions ({})", rows.size()),
      html_table("Decisions of data association",
                 {"time (UTC)", "decision", "newer map", "older map", "alternatives", "reason"},
                 rows));
}

const char* name_of(MissionEvent::Kind kind) {
  switch (kind) {
    case MissionEvent::Kind::kStop:
      return "stop";
    case MissionEvent::Kind::kOrder:
      return "order";
    case MissionEvent::Kind::kRestart:
      return "restart";
    case MissionEvent::Kind::kHealth:
      return "health";
    case MissionEvent::Kind::kDriving:
      return "driving";
  }
  return "";
}

/// The most frequent events with their counts.
std::string event_counts_html(const std::vector<MissionEvent>& events) {
  std::map<std::string, std::size_t> counts;
  for (const MissionEvent& event : events)
    ++counts[fmt::format("{}: {}", event.source, event.description)];
  std::vector<std::pair<std::size_t, std::string>> sorted;
  for (const auto& [description, count] : counts) sorted.emplace_back(count, description);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  constexpr std::size_t kShown = 8;
  std::string items;
  for (std::size_t i = 0; i < std::min(kShown, sorted.size()); ++i) {
    const auto& [count, description] = sorted[i];
    const std::string times = count > 1 ? fmt::format(" <small>{} times</small>", count) : "";
    items += element("li", escaped(description) + times);
  }
  if (sorted.size() > kShown) items += element("li", "and others, see the table");
  return element("ul", items);
}

/// Stops, orders, restarts, health and driving failures.
std::string events_html(const MissionRecords& records) {
  const std::vector<MissionEvent>& events = records.events.events();
  if (events.empty()) return "<p>No events.</p>";
  std::vector<HtmlRow> rows;
  for (const MissionEvent& event : events) {
    rows.push_back({{clock_text(event.utime), name_of(event.kind), escaped(event.source),
                     event.to_utime > event.utime ? duration_text(event.duration_s()) : "",
                     escaped(sentence(event.description))}});
  }
  std::string more;
  if (records.events.dropped() > 0) {
    more = element("p", fmt::format("{} more events are not shown.", records.events.dropped()),
                   "class=\"note\"");
  }
  return event_counts_html(events) + more +
         html_details(
             fmt::format("All events ({})", rows.size()),
             html_table("Events", {"time (UTC)", "kind", "source", "duration", "description"},
                        rows));
}

/// CONFIG of each stage, and the number of messages per channel.
std::string configuration_html(const LogInfo& log_info) {
  std::string details;
  for (const auto& [stage, copy] : log_info.configs) {
    details += html_details(fmt::format("{} ({})", stage, copy.version),
                            element("pre", escaped(copy.yaml)));
  }
  std::vector<HtmlRow> rows;
  for (const auto& [channel, count] : log_info.messages) {
    rows.push_back({{escaped(channel), fmt::to_string(count)}});
  }
  details += html_details("Messages in the log",
                          html_table("Messages in the log", {"channel", "messages"}, rows));
  return details;
}

}  // namespace

std::string mission_page(const MissionRecords& records, const MissionStatistics& statistics,
                         const MapContent& map, const std::string& title,
                         const std::vector<std::string>& warnings) {
  std::string notes;
  for (const std::string& warning : warnings) {
    notes += element("p", escaped(sentence(warning)), "class=\"note\"");
  }
  const std::string& reason = statistics.return_home_reason;
  return fill_template(
      page_file("page"),
      {{"title", escaped(title)},
       {"simulated",
        statistics.simulated ? element("span", "simulated", "class=\"tag\"") : std::string()},
       {"map_style", page_file("map")},
       {"page_style", page_file("style")},
       {"script", page_file("script")},
       {"outcome", escaped(outcome_text(statistics))},
       {"start_time", date_text(statistics.from_utime)},
       {"return_home_reason",
        reason.empty() ? "" : fmt::format("Reason for the return: {}", escaped(sentence(reason)))},
       {"warnings", notes},
       {"metrics", metrics_html(statistics, records)},
       {"map", map_svg(map)},
       {"timeline", timeline_html(records, statistics)},
       {"frontiers", frontiers_html(records)},
       {"scans", scan_cards_html(records, *map.map)},
       {"loop_closures", loop_closures_html(*map.map)},
       {"events", events_html(records)},
       {"configuration", configuration_html(records.log_info)}});
}

}  // namespace adit
