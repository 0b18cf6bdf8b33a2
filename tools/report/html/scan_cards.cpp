// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/html/scan_cards.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/report/html/html_elements.hpp"
#include "tools/report/html/text_format.hpp"
#include "tools/report/svg/terrain_svg.hpp"

namespace adit {
namespace {

bool is_found(const RecordedPlan& plan) { return plan.outcome == PlanOutcome::kFound; }

bool has_path(const RecordedScan& scan) {
  return scan.plans.empty() || std::any_of(scan.plans.begin(), scan.plans.end(), is_found);
}

std::string plan_text(const RecordedPlan& plan) {
  if (!is_found(plan)) {
    return sentence(plan.reason.empty() ? "no path was found" : plan.reason) +
           (plan.blocking > 0
                ? std::string(" ") + count_text(plan.blocking, "cell") + " in the way."
                : "");
  }
  std::string text = std::string("A path of ") + metres(plan.length_m);
  if (std::isfinite(plan.least_clearance_m)) {
    text += std::string(", nowhere nearer than ") + metres(plan.least_clearance_m, 2) +
            " to what is lethal";
  }
  return text + ".";
}

std::string place_text(const std::optional<Pose2>& T_map_body) {
  if (!T_map_body) return "unknown";
  return metres(T_map_body->x) + ", " + metres(T_map_body->y) + ", heading " +
         fixed(rad_to_deg(T_map_body->theta), 0) + "°";
}

std::string picture(const std::string& html, const std::string& caption_text) {
  if (html.empty()) return "";
  return element("figure", html + element("figcaption", escaped(caption_text)));
}

std::string scan_properties(const RecordedScan& scan, const std::optional<Pose2>& T_map_body) {
  const char* laser = !scan.laser ? "unknown" : *scan.laser == LaserId::kFront ? "front" : "rear";
  return html_metrics({{"Time", clock_text(scan.utime)},
                       {"Laser", laser},
                       {"Place in the map", place_text(T_map_body)},
                       {"Points", std::to_string(scan.points) +
                                      (scan.complete ? "" : " (the sweep was cut short)")}});
}

/// Where the planner was asked more than once, all that it said.
std::string plans_of(const RecordedScan& scan) {
  if (scan.plans.size() < 2) return "";
  std::string items;
  for (const RecordedPlan& plan : scan.plans) {
    items += element("li", clock_text(plan.utime) + ": " + escaped(plan_text(plan)));
  }
  return html_details(count_text(scan.plans.size(), "answer") + " of the planner",
                      element("ol", items));
}

std::string card(const RecordedScan& scan, const MissionMap& map) {
  const std::string id = std::string("scan-") + std::to_string(scan.number);
  const ScanPictures& pictures = scan.pictures;
  const std::string heading = fixed(pictures.heading_deg, 0) + "° to the robot";
  return element("article",
                 element("h3", std::string("Scan ") + std::to_string(scan.number)) +
                     element("p", escaped(outcome_text(scan)), "class=\"verdict\"") +
                     element("div",
                             picture(pictures.terrain, "Terrain, and the way over it") +
                                 picture(pictures.c_space, "C-space, at " + heading) +
                                 picture(pictures.view, "The points, as the laser looks"),
                             "class=\"pictures\"") +
                     scan_properties(scan, map.T_map_body_at(scan.utime)) + plans_of(scan) +
                     "<p class=\"up\"><a href=\"#map\">to the map</a></p>",
                 "class=\"card" + std::string(has_path(scan) ? "" : " stuck") + "\" id=\"" + id +
                     "\"") +
         "\n";
}

std::string legend_entry(const std::string& style, const std::string& text) {
  return element("li", "<i style=\"" + style + "\"></i>" + escaped(text));
}

std::string legend() {
  std::string blocking;
  for (int i = 0; i <= static_cast<int>(BlockingCell::Reason::kDrop); ++i) {
    const auto& [css_class, name] = blocking_name(static_cast<BlockingCell::Reason>(i));
    blocking += legend_entry("background:var(--" + std::string(css_class) + ")",
                             "in the way: " + std::string(name));
  }
  const std::string terrain =
      legend_entry("background:linear-gradient(90deg,#fff,#000)", "0 to 0.3 m of unevenness") +
      legend_entry("background:#e2d6b5", "never looked at") +
      legend_entry("background:#b3a6cf", "in shadow") +
      legend_entry("background:#e8b184", "below a beam") +
      legend_entry("background:#86b5dc", "no return: perhaps water");
  const std::string space = legend_entry("background:linear-gradient(90deg,#fff,#787878)",
                                         "C-space, from even to rough") +
                            legend_entry("background:#5a5a5a", "too much that is not seen") +
                            legend_entry("background:#000", "not passable at this heading");
  const std::string ways =
      legend_entry("background:var(--way)", "the path, with the vehicle on it") +
      legend_entry("background:var(--goal)", "where it was to go");
  return html_details("What the colours mean",
                      element("ul", terrain + space + ways + blocking, "class=\"keys\""));
}

}  // namespace

std::string outcome_text(const RecordedScan& scan) {
  if (scan.plans.empty()) return "The log has no answer of the planner to this scan.";
  return plan_text(scan.plans.back());
}

std::vector<ScanMark> scan_marks(const MissionRecords& records, const MissionMap& map) {
  std::vector<ScanMark> marks;
  for (const RecordedScan& scan : records.scans.scans()) {
    const auto T_map_body = map.T_map_body_at(scan.utime);
    if (!T_map_body) continue;
    // Who goes on with the rear laser ahead travels backwards.
    const bool rear = scan.laser == LaserId::kRear;
    const Pose2 T_body_ahead{0.0, 0.0, rear ? std::numbers::pi : 0.0};
    marks.push_back({scan.number, *T_map_body * T_body_ahead, has_path(scan),
                     std::string("Scan ") + std::to_string(scan.number) + ", " +
                         clock_text(scan.utime) + ": " + outcome_text(scan)});
  }
  return marks;
}

std::string scan_cards(const MissionRecords& records, const MissionMap& map) {
  if (records.scans.scans().empty()) return "<p>The log has no 3D scan (channel CLOUD).</p>";
  std::string cards;
  for (const RecordedScan& scan : records.scans.scans()) cards += card(scan, map);
  return legend() + element("div", cards, "class=\"cards\"");
}

}  // namespace adit
