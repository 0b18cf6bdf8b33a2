// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plan/plan_facts.hpp"

#include <cstdio>

namespace adit {
namespace {

template <class... Values>
std::string text(const char* format, Values... values) {
  char line[256];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

std::string laser_of(const Cloud& cloud) {
  if (cloud.lines.empty()) return "";
  const Eigen::Vector3f& p = cloud.lines.front().origin;
  return text("; laser at %.2f, %.2f, %.2f m", p.x(), p.y(), p.z());
}

}  // namespace

std::vector<std::string> plan_facts(const Cloud& cloud, const ScanPlan& plan) {
  const auto& [seen, never_seen, shadow, below_ray, no_return] = plan.ground;
  const PlannedPath& path = plan.path;
  std::vector<std::string> facts{
      text("%zu points%s", cloud.points(), cloud.complete ? "" : ", cut short") + laser_of(cloud),
      text("%zu cells: %zu seen, %zu never looked at, %zu in shadow, %zu below a beam, %zu without "
           "return",
           plan.terrain.cells.size(), seen, never_seen, shadow, below_ray, no_return),
      std::string(name_of(path.outcome)) + ": " + path.reason};
  if (path.points.empty()) {
    facts.push_back(text("%zu cells are in the way", path.blocking.size()));
  } else {
    facts.push_back(text("%.1f m long, %.1f m towards the goal, %.2f m or more from what is lethal",
                         path_length_m(path), path.reached_m, least_clearance_m(path)));
  }
  return facts;
}

std::string plan_times(const ScanPlan::Times& times) {
  return text("terrain %.1f ms, C-space %.1f ms, search %.1f ms: scan to path %.1f ms",
              times.terrain_ms, times.c_space_ms, times.search_ms, times.scan_to_path_ms()) +
         text(" (kernels, once: %.1f ms)", times.kernels_ms);
}

}  // namespace adit
