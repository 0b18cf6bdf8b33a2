// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/html/page_sections.hpp"

#include <algorithm>
#include <map>

#include "tools/report/html/html_elements.hpp"
#include "tools/report/html/text_format.hpp"
#include "tools/report/svg/map_layers.hpp"

namespace adit {
namespace {

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

std::string decision_of(const Association& a) {
  if (a.action == Association::Action::kProposed) {
    return a.chosen == Association::kNone ? "left open" : "accepted";
  }
  if (a.chosen == Association::kNone) return "revoked";
  return a.previously_chosen == Association::kNone ? "accepted after all" : "revised";
}

std::string older_map_of(const Association& a) {
  const int index = a.chosen != Association::kNone ? a.chosen : a.previously_chosen;
  const auto i = static_cast<std::size_t>(std::max(index, 0));
  if (i >= a.loop_closure.alternatives.size()) return "";
  return std::to_string(a.loop_closure.alternatives[i].older_map);
}

/// How often each thing happened, the most frequent first.
std::string event_counts_html(const std::vector<MissionEvent>& events) {
  std::map<std::string, std::size_t> counts;
  for (const MissionEvent& event : events) ++counts[event.source + ": " + event.description];
  std::vector<std::pair<std::size_t, std::string>> sorted;
  for (const auto& [description, count] : counts) sorted.emplace_back(count, description);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  constexpr std::size_t kShown = 8;
  std::string items;
  for (std::size_t i = 0; i < std::min(kShown, sorted.size()); ++i) {
    items += element(
        "li", escaped(sorted[i].second) +
                  (sorted[i].first > 1 ? std::string(" <small>") + std::to_string(sorted[i].first) +
                                             " times</small>"
                                       : ""));
  }
  if (sorted.size() > kShown) items += element("li", "and others, see the table");
  return element("ul", items);
}

}  // namespace

std::string frontiers_html(const MissionRecords& records) {
  const auto& report = records.state.exploration();
  if (!report) return "<p>The log has no EXPLORATION.</p>";
  std::vector<Frontier> frontiers = report->frontiers;
  std::stable_sort(frontiers.begin(), frontiers.end(), [](const Frontier& a, const Frontier& b) {
    return is_closed(a.state) < is_closed(b.state);
  });
  std::vector<HtmlRow> rows;
  for (const Frontier& frontier : frontiers) {
    rows.push_back({{std::to_string(frontier.id), escaped(name_of(frontier.state)),
                     fixed(frontier.p_map.x(), 1) + ", " + fixed(frontier.p_map.y(), 1),
                     metres(frontier.width_m), frontier.utime > 0 ? clock_text(frontier.utime) : "",
                     escaped(sentence(frontier.evidence))},
                    std::string("id=\"stub-") + std::to_string(frontier.id) + "\" class=\"" +
                        (is_closed(frontier.state) ? "closed" : "open") + "\""});
  }
  if (rows.empty()) return "<p>No opening was seen.</p>";
  const std::string certificate =
      report->decision.complete
          ? "<p>Exploration says that the mine is complete: every opening ever seen is closed. The "
            "table is the certificate.</p>"
          : "<p>Places where the mine goes on, or seemed to (the stubs of the log). What is not "
            "closed was left for "
            "another mission.</p>";
  return certificate +
         html_table("Openings, their state and its evidence",
                    {"no.", "state", "x, y in the map [m]", "width", "since", "evidence"}, rows);
}

std::string loop_closures_html(const MissionMap& map) {
  std::vector<HtmlRow> rows;
  for (const Association* a : map.full_map().associations) {
    const std::string decision = decision_of(*a);
    rows.push_back({{clock_text(a->utime), decision, std::to_string(a->loop_closure.newer_map),
                     older_map_of(*a), std::to_string(a->loop_closure.alternatives.size()),
                     escaped(sentence(a->reason))},
                    decision == "revoked" ? "class=\"revoked\"" : ""});
  }
  if (rows.empty()) return "<p>No place was seen again.</p>";
  return html_details(
      std::string("All decisions (") + std::to_string(rows.size()) + ")",
      html_table("Decisions on places that were seen again",
                 {"time", "decision", "local map", "as", "alternatives", "why"}, rows));
}

std::string events_html(const MissionRecords& records) {
  const std::vector<MissionEvent>& events = records.events.events();
  if (events.empty()) return "<p>Nothing out of the ordinary.</p>";
  std::vector<HtmlRow> rows;
  for (const MissionEvent& event : events) {
    rows.push_back({{clock_text(event.utime), name_of(event.kind), escaped(event.source),
                     event.to_utime > event.utime ? duration_text(event.seconds()) : "",
                     escaped(sentence(event.description))}});
  }
  std::string more;
  if (records.events.dropped() > 0) {
    more = std::string("<p class=\"note\">") + std::to_string(records.events.dropped()) +
           " more events are not shown.</p>";
  }
  return event_counts_html(events) + more +
         html_details(
             std::string("All events (") + std::to_string(rows.size()) + ")",
             html_table("Events", {"time", "what", "who", "length", "of what kind"}, rows));
}

std::string configuration_html(const LogInfo& log_info) {
  std::string details;
  for (const auto& [stage, copy] : log_info.configs) {
    details += html_details(stage + " (" + copy.version + ")", element("pre", escaped(copy.yaml)));
  }
  std::vector<HtmlRow> rows;
  for (const auto& [channel, count] : log_info.messages) {
    rows.push_back({{escaped(channel), std::to_string(count)}});
  }
  details += html_details("messages of the log",
                          html_table("Messages of the log", {"channel", "messages"}, rows));
  return details;
}

namespace {

HtmlMetrics headline_metrics(const MissionStatistics& statistics) {
  HtmlMetrics metrics{{"Time", duration_text(statistics.seconds())},
                      {"Way", metres(statistics.distance_travelled_m)},
                      {"Farthest from the start", metres(statistics.farthest_m)},
                      {"3D scans", std::to_string(statistics.scans)}};
  if (statistics.explored_m)
    metrics.emplace_back("Corridors known", metres(*statistics.explored_m));
  if (statistics.frontiers) {
    metrics.emplace_back("Openings closed", std::to_string(statistics.frontiers->closed) + " of " +
                                                std::to_string(statistics.frontiers->found));
  }
  metrics.emplace_back("Places recognised", std::to_string(statistics.loop_closures.in_force));
  if (statistics.revoked > 0)
    metrics.emplace_back("Taken back", std::to_string(statistics.revoked));
  if (statistics.score) {
    metrics.emplace_back("Path against the truth, RMSE",
                         metres(statistics.score->aligned.rmse_m, 2));
  }
  if (statistics.failure)
    metrics.emplace_back("Collisions", statistics.failure->empty() ? "none" : "yes");
  return metrics;
}

HtmlMetrics map_metrics(const MissionStatistics& statistics) {
  HtmlMetrics metrics{{"Local maps", std::to_string(statistics.local_maps)},
                      {"Closures proposed", std::to_string(statistics.loop_closures.proposed)},
                      {"Closures in force", std::to_string(statistics.loop_closures.in_force)},
                      {"Decisions revised", std::to_string(statistics.loop_closures.revised)},
                      {"Closures revoked", std::to_string(statistics.revoked)},
                      {"Scans without a path", std::to_string(statistics.scans_without_path)},
                      {"Stops by the guard", std::to_string(statistics.stops) + ", " +
                                                 duration_text(statistics.stopped_s)},
                      {"Restarts and silences", std::to_string(statistics.restarts)}};
  if (statistics.score) {
    metrics.emplace_back("Farthest from the truth", metres(statistics.score->aligned.max_m, 2));
    metrics.emplace_back("RMSE, laid on at the start",
                         metres(statistics.score->anchored.rmse_m, 2));
    metrics.emplace_back("True way", metres(statistics.score->true_length_m));
  }
  return metrics;
}

void add_state(const StateRecord& state, HtmlMetrics& metrics) {
  if (state.vehicle_first()) {
    metrics.emplace_back("Battery", percent(state.vehicle_first()->battery_share) + " to " +
                                        percent(state.vehicle_last()->battery_share));
  }
  if (!state.gas_extremes()) return;
  metrics.emplace_back("Most methane", percent(state.gas_extremes()->methane_share));
  metrics.emplace_back("Least oxygen", percent(state.gas_extremes()->oxygen_share));
  metrics.emplace_back("Most carbon monoxide",
                       fixed(1e6 * state.gas_extremes()->carbon_monoxide_share, 0) + " ppm");
}

}  // namespace

std::string metrics_html(const MissionStatistics& statistics, const MissionRecords& records) {
  HtmlMetrics more = map_metrics(statistics);
  add_state(records.state, more);
  if (!statistics.version.empty()) more.emplace_back("Version", escaped(statistics.version));
  return html_metrics(headline_metrics(statistics)) +
         html_details("More figures", html_metrics(more));
}

}  // namespace adit
