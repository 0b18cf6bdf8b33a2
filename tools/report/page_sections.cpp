// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/page_sections.hpp"

#include <algorithm>
#include <map>

#include "tools/report/html.hpp"
#include "tools/report/map_layers.hpp"
#include "tools/report/text.hpp"

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
  return a.chosen_before == Association::kNone ? "accepted after all" : "revised";
}

std::string older_map_of(const Association& a) {
  const int index = a.chosen != Association::kNone ? a.chosen : a.chosen_before;
  const auto i = static_cast<std::size_t>(std::max(index, 0));
  if (i >= a.closure.alternatives.size()) return "";
  return std::to_string(a.closure.alternatives[i].older_map);
}

/// How often each thing happened, the most frequent first.
std::string tally_html(const std::vector<MissionEvent>& events) {
  std::map<std::string, std::size_t> counts;
  for (const MissionEvent& event : events) ++counts[event.who + ": " + event.what];
  std::vector<std::pair<std::size_t, std::string>> sorted;
  for (const auto& [what, count] : counts) sorted.emplace_back(count, what);
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

std::string openings_html(const MissionRecords& records) {
  const auto& report = records.state.exploration();
  if (!report) return "<p>The log has no EXPLORATION.</p>";
  std::vector<Stub> stubs = report->stubs;
  std::stable_sort(stubs.begin(), stubs.end(), [](const Stub& a, const Stub& b) {
    return is_closed(a.state) < is_closed(b.state);
  });
  std::vector<HtmlRow> rows;
  for (const Stub& stub : stubs) {
    rows.push_back(
        {{std::to_string(stub.id), escaped(name_of(stub.state)),
          fixed(stub.p_map.x(), 1) + ", " + fixed(stub.p_map.y(), 1), metres(stub.width_m),
          stub.utime > 0 ? clock_text(stub.utime) : "", escaped(sentence(stub.evidence))},
         std::string("id=\"stub-") + std::to_string(stub.id) + "\" class=\"" +
             (is_closed(stub.state) ? "closed" : "open") + "\""});
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

std::string closures_html(const MissionMap& map) {
  std::vector<HtmlRow> rows;
  for (const Association* a : map.whole().associations) {
    const std::string decision = decision_of(*a);
    rows.push_back(
        {{clock_text(a->utime), decision, std::to_string(a->closure.newer_map), older_map_of(*a),
          std::to_string(a->closure.alternatives.size()), escaped(sentence(a->reason))},
         decision == "revoked" ? "class=\"revoked\"" : ""});
  }
  if (rows.empty()) return "<p>No place was seen again.</p>";
  return html_fold(
      std::string("All decisions (") + std::to_string(rows.size()) + ")",
      html_table("Decisions on places that were seen again",
                 {"time", "decision", "local map", "as", "alternatives", "why"}, rows));
}

std::string events_html(const MissionRecords& records) {
  const std::vector<MissionEvent>& events = records.events.events();
  if (events.empty()) return "<p>Nothing out of the ordinary.</p>";
  std::vector<HtmlRow> rows;
  for (const MissionEvent& event : events) {
    rows.push_back({{clock_text(event.utime), name_of(event.kind), escaped(event.who),
                     event.to_utime > event.utime ? duration_text(event.seconds()) : "",
                     escaped(sentence(event.what))}});
  }
  std::string more;
  if (records.events.left_out() > 0) {
    more = std::string("<p class=\"note\">") + std::to_string(records.events.left_out()) +
           " more events are not shown.</p>";
  }
  return tally_html(events) + more +
         html_fold(std::string("All events (") + std::to_string(rows.size()) + ")",
                   html_table("Events", {"time", "what", "who", "length", "of what kind"}, rows));
}

std::string configuration_html(const LogCensus& census) {
  std::string folds;
  for (const auto& [stage, copy] : census.configs) {
    folds += html_fold(stage + " (" + copy.version + ")", element("pre", escaped(copy.yaml)));
  }
  std::vector<HtmlRow> rows;
  for (const auto& [channel, count] : census.messages) {
    rows.push_back({{escaped(channel), std::to_string(count)}});
  }
  folds += html_fold("messages of the log",
                     html_table("Messages of the log", {"channel", "messages"}, rows));
  return folds;
}

}  // namespace adit
