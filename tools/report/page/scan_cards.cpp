// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/page/scan_cards.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/sensing/seconds.hpp"
#include "tools/report/text_format.hpp"
#include "viewer/scene/json_text.hpp"

namespace adit {
namespace {

using Json = nlohmann::ordered_json;

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

/// Result of the last plan on a scan, one sentence.
std::string outcome_text(const RecordedScan& scan) {
  if (scan.plans.empty()) return "The log has no plan on this scan.";
  return plan_text(scan.plans.back());
}

const char* laser_name(const RecordedScan& scan) {
  if (!scan.laser) return "an unknown laser";
  return scan.laser == LaserId::kRear ? "the rear laser" : "the front laser";
}

Json plan_json(const RecordedPlan& plan) {
  const bool found = is_path_found(plan);
  return {{"outcome", found ? "path" : name_of(plan.outcome)},
          {"reason", plan_text(plan)},
          {"reached_m", plan.reached_m},
          {"length_m", found ? Json(plan.length_m) : Json()},
          {"clearance_m",
           std::isfinite(plan.least_clearance_m) ? Json(plan.least_clearance_m) : Json()}};
}

Json pictures_json(const ScanPictures& pictures) {
  Json json = Json::object();
  if (!pictures.terrain.empty()) json["terrain"] = pictures.terrain;
  if (!pictures.c_space.empty()) json["c_space"] = pictures.c_space;
  if (!pictures.view.empty()) json["view"] = pictures.view;
  return json;
}

}  // namespace

std::string scan_message(const RecordedScan& scan, const MissionMap& map) {
  Json json{{"number", scan.number},         {"id", scan.id},
            {"time_s", seconds(scan.utime)}, {"laser", laser_name(scan)},
            {"points", scan.points},         {"complete", scan.complete},
            {"plans", Json::array()},        {"pictures", pictures_json(scan.pictures)}};
  if (const auto T_map_body = map.T_map_body_at(scan.utime)) {
    json["x"] = T_map_body->x;
    json["y"] = T_map_body->y;
    json["heading_rad"] = T_map_body->theta;
  }
  for (const RecordedPlan& plan : scan.plans) json["plans"].push_back(plan_json(plan));
  return json_text(json);
}

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

}  // namespace adit
