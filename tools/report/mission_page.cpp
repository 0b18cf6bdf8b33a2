// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/mission_page.hpp"

#include "tools/report/html.hpp"
#include "tools/report/page_sections.hpp"
#include "tools/report/page_style.hpp"
#include "tools/report/scan_cards.hpp"
#include "tools/report/text.hpp"
#include "tools/report/timeline_html.hpp"

namespace adit {
namespace {

std::string section(const std::string& id, const std::string& heading_text,
                    const std::string& html) {
  return std::string("\n") +
         element("section", element("h2", escaped(heading_text)) + html, "id=\"" + id + "\"") +
         "\n";
}

std::string head_html(const MissionFacts& facts, const std::string& title,
                      const std::vector<std::string>& notes) {
  const std::string tag =
      facts.simulated ? element("span", "simulated", "class=\"tag\"") : std::string();
  std::string html = element("h1", escaped(title) + tag) +
                     element("p", escaped(outcome_text(facts)), "class=\"outcome\"");
  std::string why = date_text(facts.from_utime) + ".";
  if (!facts.homeward_reason.empty()) {
    why += std::string(" It turned around because: ") + sentence(facts.homeward_reason);
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
    {"show-way", "way", true},           {"show-scans", "3D scans", true},
    {"show-stubs", "openings", true},    {"show-revoked", "closures taken back", true},
    {"show-graph", "pose graph", false}, {"show-corridors", "corridors", false}};

/// Boxes beside the map, so that no script is needed to show and hide its layers.
std::string map_html(const MapToDraw& map) {
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

std::string sections(const MissionRecords& records, const MissionFacts& facts,
                     const MapToDraw& map) {
  return section("map", "The map", map_html(map)) +
         section("time", "How the time was spent", timeline_html(records, facts)) +
         section("openings", "Openings", openings_html(records)) +
         section("scans", "3D scans and what came of them", scan_cards(records, *map.map)) +
         section("places", "Places recognised", closures_html(*map.map)) +
         section("events", "Events", events_html(records)) +
         section("config", "Configuration", configuration_html(records.census));
}

}  // namespace

std::string mission_page(const MissionRecords& records, const MissionFacts& facts,
                         const MapToDraw& map, const std::string& title,
                         const std::vector<std::string>& notes) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta "
         "name=\"viewport\" content=\"width=device-width,initial-scale=1\">" +
         element("title", escaped(title)) +
         element("style", std::string(map_colours()) + map_style() + page_style()) +
         "</head><body>\n" + head_html(facts, title, notes) + kNav +
         element("main", figures_html(facts, records) + sections(records, facts, map)) +
         element("footer",
                 "Made by adit report. Beside this page: map.png, map.pgm and map.yaml, "
                 "map.svg, graph.g2o, trajectory.tum, cloud.ply, volume.bt, "
                 "junctions.geojson, summary.json and run.lcmlog.") +
         element("script", page_script()) + "</body></html>\n";
}

}  // namespace adit
