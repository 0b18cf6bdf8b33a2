// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view/section_line.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/view/rock_distance.hpp"

namespace adit {
namespace {

constexpr float kAheadMax = 100.0F;  // [m]
constexpr double kIntoRock = 0.5;    // that the line goes on behind a wall [m]

DriftLine line_of(const DriftEdge& edge) { return {edge.drift, edge.points, edge.width_m, false}; }

const DriftEdge& nearest_edge(const DriftGraph& drifts, const Eigen::Vector2d& p_world) {
  return *std::min_element(drifts.edges.begin(), drifts.edges.end(),
                           [&](const DriftEdge& a, const DriftEdge& b) {
                             return line_of(a).distance_m(p_world) < line_of(b).distance_m(p_world);
                           });
}

/// The edges of one drift that follow each other, joined.
DriftLine whole_drift(const DriftGraph& drifts, const std::string& name) {
  DriftLine line{"along " + name, {}, 0.0, false};
  for (const DriftEdge& edge : drifts.edges) {
    if (edge.drift != name) continue;
    const bool goes_on = !line.points.empty() && line.points.back() == edge.points.front();
    if (!line.points.empty() && !goes_on) continue;
    line.points.insert(line.points.end(), edge.points.begin() + (goes_on ? 1 : 0),
                       edge.points.end());
  }
  return line;
}

/// How far the line goes from a place, to behind the next wall [m].
double room(const Site& site, const Pose2& from) {
  const double floor_m = site.world().truth.floor_at(from.translation()).value_or(0.0);
  const Eigen::Vector3d eye(from.x, from.y, floor_m + 1.0);
  const Eigen::Vector3d ahead(std::cos(from.theta), std::sin(from.theta), 0.0);
  const Ray ray{eye.cast<float>(), ahead.cast<float>()};
  return distance_to_rock(site.scene(), ray, kAheadMax) + kIntoRock;
}

DriftLine straight_ahead(const Site& site) {
  const Pose2& start = site.world().T_world_start;
  const Pose2 behind{-room(site, start * Pose2{0.0, 0.0, std::numbers::pi}), 0.0, 0.0};
  const Pose2 ahead{room(site, start), 0.0, 0.0};
  return {"straight ahead",
          {(start * behind).translation(), (start * ahead).translation()},
          0.0,
          false};
}

}  // namespace

DriftLine section_line(const Site& site, const ViewOptions& options) {
  if (options.section.size() >= 2) return {"along the given line", options.section, 0.0, false};
  const DriftGraph& drifts = site.world().truth.drifts;
  if (drifts.edges.empty()) return straight_ahead(site);
  const Eigen::Vector2d start = site.world().T_world_start.translation();
  return whole_drift(drifts, nearest_edge(drifts, start).drift);
}

}  // namespace adit
