// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/html/mission_page.hpp"

#include <algorithm>
#include <string>

#include "tools/report/html/html_elements.hpp"
#include "tools/report/html/page_sections.hpp"
#include "tools/report/html/page_style.hpp"
#include "tools/report/html/scan_cards.hpp"
#include "tools/report/html/text_format.hpp"
#include "tools/report/mission_statistics.hpp"

namespace adit {
namespace {

/// The phases over time, a lane each, with what led to them; and the same as a table that folds.
std::string timeline_html(const MissionRecords& records, const MissionStatistics& statistics);

constexpr double kWidth = 1000.0;
constexpr double kLeastWidth = 0.8;  // of what is short, so that it is seen
constexpr int kTicks = 5;

/// From times to the width of a lane.
class TimeScale {
 public:
  TimeScale(std::int64_t from_utime, std::int64_t to_utime)
      : from_(from_utime), length_(std::max<std::int64_t>(to_utime - from_utime, 1)) {}

  [[nodiscard]] double at(std::int64_t utime) const {
    const double share = static_cast<double>(utime - from_) / static_cast<double>(length_);
    return kWidth * std::clamp(share, 0.0, 1.0);
  }

 private:
  std::int64_t from_;
  std::int64_t length_;
};

std::string bar(const TimeScale& scale, std::int64_t from_utime, std::int64_t to_utime,
                const std::string& text) {
  const double x = scale.at(from_utime);
  const double width = std::max(scale.at(to_utime) - x, kLeastWidth);
  return std::string("<rect x=\"") + fixed(x, 1) + "\" width=\"" + fixed(width, 1) +
         "\" height=\"10\"><title>" + escaped(text) + "</title></rect>";
}

std::string lane(const std::string& name, const std::string& css_class, const std::string& bars,
                 const std::string& how_long, const std::string& turn) {
  return "<div class=\"lane " + css_class + "\"><span>" + escaped(name) +
         "</span><svg viewBox=\"0 0 1000 10\" preserveAspectRatio=\"none\" role=\"img\" "
         "aria-label=\"" +
         escaped(name + ": " + how_long) + "\">" + bars + turn + "</svg><span>" +
         escaped(how_long) + "</span></div>";
}

std::string interval_text(const PhaseInterval& interval) {
  const std::string why = sentence(interval.phase.reason);
  return clock_text(interval.phase.utime) + ", " + name_of(interval.phase.phase) + " for " +
         duration_text(interval.seconds()) + (why.empty() ? "" : ": " + why);
}

std::string phase_lane(const MissionRecords& records, const PhaseShare& share,
                       const TimeScale& scale, const std::string& turn) {
  std::string bars;
  for (const PhaseInterval& interval : records.phases.intervals()) {
    if (interval.phase.phase != share.phase) continue;
    bars += bar(scale, interval.phase.utime, interval.to_utime, interval_text(interval));
  }
  const std::string name = name_of(share.phase);
  return lane(name, name, bars, duration_text(share.seconds) + ", " + percent(share.share), turn);
}

std::string stop_lane(const MissionRecords& records, const MissionStatistics& statistics,
                      const TimeScale& scale, const std::string& turn) {
  std::string bars;
  for (const MissionEvent& event : records.events.events()) {
    if (event.kind != MissionEvent::Kind::kStop) continue;
    bars += bar(scale, event.utime, event.to_utime,
                clock_text(event.utime) + ", stopped by the guard for " +
                    duration_text(event.seconds()) + ": " + event.description);
  }
  return bars.empty() ? ""
                      : lane("guard", "stopped", bars,
                             count_text(statistics.stops, "stop") + ", " +
                                 duration_text(statistics.stopped_s),
                             turn);
}

std::string axis(const MissionStatistics& statistics) {
  std::string ticks;
  for (int i = 0; i < kTicks; ++i) {
    ticks += element("span", duration_text(statistics.seconds() * i / (kTicks - 1)));
  }
  return element("div", "<span></span>" + element("div", ticks) + "<span></span>",
                 "class=\"lane axis\" aria-hidden=\"true\"");
}

std::string table(const MissionRecords& records) {
  std::vector<HtmlRow> rows;
  for (const PhaseInterval& interval : records.phases.intervals()) {
    const MissionPhase& phase = interval.phase;
    rows.push_back(
        {{clock_text(phase.utime), name_of(phase.phase), duration_text(interval.seconds()),
          records.phases.reported() ? metres(interval.end_distance_travelled_m) : "",
          phase.returning_home ? "homeward" : "", escaped(sentence(phase.reason))}});
  }
  return html_details(std::string("All phases as a table (") + std::to_string(rows.size()) + ")",
                      html_table("Phases of the mission",
                                 {"begin (UTC)", "phase", "length", "way then", "", "why"}, rows));
}

std::string timeline_html(const MissionRecords& records, const MissionStatistics& statistics) {
  if (records.phases.intervals().empty()) return "<p>The log tells nothing of the phases.</p>";
  const TimeScale scale(statistics.from_utime, statistics.to_utime);
  std::string turn;
  if (statistics.homeward_utime) {
    const std::string x = fixed(scale.at(*statistics.homeward_utime), 1);
    turn = "<path class=\"turn\" d=\"M" + x + " 0V10\"><title>turned around</title></path>";
  }
  std::string lanes;
  for (const PhaseShare& share : statistics.phases) {
    if (share.phase != Phase::kEnded) lanes += phase_lane(records, share, scale, turn);
  }
  lanes += stop_lane(records, statistics, scale, turn);
  std::string note;
  if (!records.phases.reported()) {
    note = element("p",
                   "The log has no PHASE: what is shown was read from scan requests, 3D scans and "
                   "what driving said of itself.",
                   "class=\"note\"");
  }
  return note + element("div", lanes + axis(statistics), "class=\"timeline\"") + table(records);
}

std::string section(const std::string& id, const std::string& heading_text,
                    const std::string& html) {
  return std::string("\n") +
         element("section", element("h2", escaped(heading_text)) + html, "id=\"" + id + "\"") +
         "\n";
}

std::string head_html(const MissionStatistics& statistics, const std::string& title,
                      const std::vector<std::string>& notes) {
  const std::string tag =
      statistics.simulated ? element("span", "simulated", "class=\"tag\"") : std::string();
  std::string html = element("h1", escaped(title) + tag) +
                     element("p", escaped(outcome_text(statistics)), "class=\"outcome\"");
  std::string why = date_text(statistics.from_utime) + ".";
  if (!statistics.return_home_reason.empty()) {
    why += std::string(" It turned around because: ") + sentence(statistics.return_home_reason);
  }
  html += element("p", escaped(why), "class=\"why\"");
  for (const std::string& note : notes) {
    html += element("p", escaped(sentence(note)), "class=\"note\"");
  }
  return element("header", html);
}

struct Layer {
  const char* id;
  const char* name;
  bool shown;
};
constexpr Layer kLayers[] = {
    {"show-path", "way", true},           {"show-scans", "3D scans", true},
    {"show-frontiers", "openings", true}, {"show-revoked", "closures taken back", true},
    {"show-graph", "pose graph", false},  {"show-corridors", "corridors", false}};

/// Boxes beside the map, so that no script is needed to show and hide its layers.
std::string map_html(const MapContent& map) {
  std::string html;
  for (const auto& [id, name, shown] : kLayers) {
    const std::string box = std::string("<input type=\"checkbox\" id=\"") + id + "\"" +
                            (shown ? " checked" : "") + "> ";
    html += element("label", box + name) + "\n";
  }
  const char* keys =
      "<p class=\"note\">The way out is a solid line, the way home a dashed one. Numbers are 3D "
      "scans and lead to their cards; red ones found no way. Rings are openings: red where the "
      "mine "
      "still goes on. Lines of the pose graph are green where a "
      "place was recognised; dashed orange ones were taken back.</p>";
  return element("div", html + element("div", map_svg(map), "class=\"map\" tabindex=\"0\""),
                 "class=\"layers\"") +
         keys;
}

constexpr const char* kNav =
    "<nav aria-label=\"Sections\"><a href=\"#map\">Map</a><a href=\"#time\">Timeline</a><a "
    "href=\"#scans\">3D scans</a><a href=\"#openings\">Openings</a><a href=\"#places\">Places "
    "recognised</a><a href=\"#events\">Events</a><a href=\"#config\">Configuration</a></nav>";

std::string sections(const MissionRecords& records, const MissionStatistics& statistics,
                     const MapContent& map) {
  return section("map", "The map", map_html(map)) +
         section("time", "How the time was spent", timeline_html(records, statistics)) +
         section("openings", "Openings", frontiers_html(records)) +
         section("scans", "3D scans and what came of them", scan_cards(records, *map.map)) +
         section("places", "Places recognised", loop_closures_html(*map.map)) +
         section("events", "Events", events_html(records)) +
         section("config", "Configuration", configuration_html(records.log_info));
}

}  // namespace

std::string mission_page(const MissionRecords& records, const MissionStatistics& statistics,
                         const MapContent& map, const std::string& title,
                         const std::vector<std::string>& notes) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta "
         "name=\"viewport\" content=\"width=device-width,initial-scale=1\">" +
         element("title", escaped(title)) +
         element("style", std::string(map_colours()) + map_style() + page_style()) +
         "</head><body>\n" + head_html(statistics, title, notes) + kNav +
         element("main", metrics_html(statistics, records) + sections(records, statistics, map)) +
         element("footer",
                 "Made by adit report. Beside this page: map.png, map.pgm and map.yaml, "
                 "map.svg, graph.g2o, trajectory.tum, cloud.ply, volume.bt, "
                 "junctions.geojson, summary.json and run.lcmlog.") +
         element("script", page_script()) + "</body></html>\n";
}

}  // namespace adit
