// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "tools/report/html/markup.hpp"
#include "tools/report/html/mission_page.hpp"
#include "tools/report/html/text_format.hpp"
#include "tools/report/svg/terrain_svg.hpp"

namespace adit {
namespace {

bool is_path_found(const RecordedPlan& plan) { return plan.outcome == PlanOutcome::kFound; }

bool has_path(const RecordedScan& scan) {
  return scan.plans.empty() || std::any_of(scan.plans.begin(), scan.plans.end(), is_path_found);
}

std::string plan_text(const RecordedPlan& plan) {
  if (!is_path_found(plan)) {
    std::string text = sentence(plan.reason.empty() ? "no path found" : plan.reason);
    if (plan.blocking > 0) text += fmt::format(" {} blocked.", count_text(plan.blocking, "cell"));
    return text;
  }
  std::string text = fmt::format("Path of {}", metres(plan.length_m));
  if (std::isfinite(plan.least_clearance_m)) {
    text +=
        fmt::format(", minimum clearance {} to lethal cells", metres(plan.least_clearance_m, 2));
  }
  return text + ".";
}

std::string pose_text(const std::optional<Pose2>& T_map_body) {
  if (!T_map_body) return "unknown";
  return fmt::format("{}, {}, heading {}°", metres(T_map_body->x), metres(T_map_body->y),
                     fixed(rad_to_deg(T_map_body->theta), 0));
}

std::string picture(const std::string& html, const std::string& caption_text) {
  if (html.empty()) return "";
  return element("figure", html + element("figcaption", escaped(caption_text)));
}

std::string scan_properties(const RecordedScan& scan, const std::optional<Pose2>& T_map_body) {
  const char* laser = !scan.laser ? "unknown" : *scan.laser == LaserId::kFront ? "front" : "rear";
  return html_metrics(
      {{"Time", clock_text(scan.utime)},
       {"Laser", laser},
       {"Pose in the map", pose_text(T_map_body)},
       {"Points", fmt::format("{}{}", scan.points, scan.complete ? "" : " (incomplete sweep)")}});
}

/// All plans on a scan if there is more than one.
std::string plans_html(const RecordedScan& scan) {
  if (scan.plans.size() < 2) return "";
  std::string items;
  for (const RecordedPlan& plan : scan.plans) {
    items += element("li", fmt::format("{}: {}", clock_text(plan.utime), escaped(plan_text(plan))));
  }
  return html_details(count_text(scan.plans.size(), "plan"), element("ol", items));
}

/// Result of the last plan on a scan, one sentence.
std::string outcome_text(const RecordedScan& scan) {
  if (scan.plans.empty()) return "The log has no plan on this scan.";
  return plan_text(scan.plans.back());
}

std::string card(const RecordedScan& scan, const MissionMap& map) {
  const ScanPictures& scan_pictures = scan.pictures;
  const std::string pictures =
      picture(scan_pictures.terrain, "Terrain with the planned path") +
      picture(scan_pictures.c_space,
              fmt::format("C-space at a heading of {}° relative to the robot",
                          fixed(scan_pictures.heading_deg, 0))) +
      picture(scan_pictures.view, "Points, seen in the direction of the laser");
  return fmt::format(R"(<article class="card{}" id="scan-{}">
<h3>Scan {}</h3>
<p class="verdict">{}</p>
<div class="pictures">{}</div>
{}{}<p class="up"><a href="#map">to the map</a></p>
</article>
)",
                     has_path(scan) ? "" : " no-path", scan.number, scan.number,
                     escaped(outcome_text(scan)), pictures,
                     scan_properties(scan, map.T_map_body_at(scan.utime)), plans_html(scan));
}

std::string legend_entry(const std::string& style, const std::string& text) {
  return fmt::format(R"(<li><i style="background: {}"></i>{}</li>)", style, escaped(text));
}

std::string legend() {
  std::string blocking;
  for (int i = 0; i <= static_cast<int>(BlockingCell::Reason::kDrop); ++i) {
    const auto& [css_class, name] = blocking_name(static_cast<BlockingCell::Reason>(i));
    blocking += legend_entry(fmt::format("var(--{})", css_class), fmt::format("blocked: {}", name));
  }
  const std::string terrain =
      legend_entry("linear-gradient(90deg, #fff, #000)", "terrain: 0 to 0.3 m of roughness") +
      legend_entry("#e2d6b5", "not scanned") + legend_entry("#b3a6cf", "in shadow") +
      legend_entry("#e8b184", "below a beam") +
      legend_entry("#86b5dc", "no return: possible water");
  const std::string c_space =
      legend_entry("linear-gradient(90deg, #fff, #787878)", "C-space: even to rough") +
      legend_entry("#5a5a5a", "too many unknown cells") +
      legend_entry("#000", "not passable at this heading");
  const std::string path =
      legend_entry("var(--planned-path)", "planned path and vehicle outlines") +
      legend_entry("var(--goal)", "goal");
  return html_details("Legend",
                      element("ul", terrain + c_space + path + blocking, "class=\"keys\""));
}

}  // namespace

std::vector<ScanMark> scan_marks(const MissionRecords& records, const MissionMap& map) {
  std::vector<ScanMark> marks;
  for (const RecordedScan& scan : records.scans.scans()) {
    const auto T_map_body = map.T_map_body_at(scan.utime);
    if (!T_map_body) continue;
    const bool rear = scan.laser == LaserId::kRear;
    const Pose2 T_body_ahead{0.0, 0.0, rear ? std::numbers::pi : 0.0};
    marks.push_back(
        {scan.number, *T_map_body * T_body_ahead, has_path(scan),
         fmt::format("Scan {}, {}: {}", scan.number, clock_text(scan.utime), outcome_text(scan))});
  }
  return marks;
}

std::string scan_cards_html(const MissionRecords& records, const MissionMap& map) {
  if (records.scans.scans().empty()) return "<p>The log has no 3D scans (channel CLOUD).</p>";
  std::string cards;
  for (const RecordedScan& scan : records.scans.scans()) cards += card(scan, map);
  return legend() + element("div", cards, "class=\"cards\"");
}

}  // namespace adit
