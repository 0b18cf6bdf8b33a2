// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/html.hpp"
#include "tools/report/page_sections.hpp"
#include "tools/report/text.hpp"

namespace adit {
namespace {

HtmlFigures headline(const MissionFacts& facts) {
  HtmlFigures figures{{"Time", duration_text(facts.seconds())},
                      {"Way", metres(facts.way_m)},
                      {"Farthest from the start", metres(facts.farthest_m)},
                      {"3D scans", std::to_string(facts.scans)}};
  if (facts.explored_m) figures.emplace_back("Corridors known", metres(*facts.explored_m));
  if (facts.stubs) {
    figures.emplace_back("Openings closed", std::to_string(facts.stubs->closed) + " of " +
                                                std::to_string(facts.stubs->found));
  }
  figures.emplace_back("Places recognised", std::to_string(facts.closures.in_force));
  if (facts.revoked > 0) figures.emplace_back("Taken back", std::to_string(facts.revoked));
  if (facts.score) {
    figures.emplace_back("Path against the truth, RMSE", metres(facts.score->aligned.rmse_m, 2));
  }
  if (facts.failure) figures.emplace_back("Collisions", facts.failure->empty() ? "none" : "yes");
  return figures;
}

HtmlFigures map_figures(const MissionFacts& facts) {
  HtmlFigures figures{
      {"Local maps", std::to_string(facts.local_maps)},
      {"Closures proposed", std::to_string(facts.closures.proposed)},
      {"Closures in force", std::to_string(facts.closures.in_force)},
      {"Decisions revised", std::to_string(facts.closures.revised)},
      {"Closures revoked", std::to_string(facts.revoked)},
      {"Scans without a path", std::to_string(facts.scans_without_path)},
      {"Stops by the guard", std::to_string(facts.stops) + ", " + duration_text(facts.stopped_s)},
      {"Restarts and silences", std::to_string(facts.restarts)}};
  if (facts.score) {
    figures.emplace_back("Farthest from the truth", metres(facts.score->aligned.max_m, 2));
    figures.emplace_back("RMSE, laid on at the start", metres(facts.score->anchored.rmse_m, 2));
    figures.emplace_back("True way", metres(facts.score->true_length_m));
  }
  return figures;
}

void add_state(const StateRecord& state, HtmlFigures& figures) {
  if (state.vehicle_first()) {
    figures.emplace_back("Battery", percent(state.vehicle_first()->battery_share) + " to " +
                                        percent(state.vehicle_last()->battery_share));
  }
  if (!state.air()) return;
  figures.emplace_back("Most methane", percent(state.air()->methane_share));
  figures.emplace_back("Least oxygen", percent(state.air()->oxygen_share));
  figures.emplace_back("Most carbon monoxide",
                       fixed(1e6 * state.air()->carbon_monoxide_share, 0) + " ppm");
}

}  // namespace

std::string figures_html(const MissionFacts& facts, const MissionRecords& records) {
  HtmlFigures more = map_figures(facts);
  add_state(records.state, more);
  if (!facts.version.empty()) more.emplace_back("Version", escaped(facts.version));
  return html_figures(headline(facts)) + html_fold("More figures", html_figures(more));
}

}  // namespace adit
