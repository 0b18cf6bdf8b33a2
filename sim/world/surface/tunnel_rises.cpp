// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/surface/tunnel_rises.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr double kRiseBucketSide = 4.0;
constexpr std::size_t kRoom = std::numeric_limits<std::size_t>::max();

}  // namespace

std::shared_ptr<const TunnelRises> TunnelRises::of(const std::vector<TunnelLine>& tunnels,
                                                   const std::vector<PlanPolygon>& rooms,
                                                   double reach_m) {
  const bool any = std::any_of(tunnels.begin(), tunnels.end(),
                               [](const TunnelLine& tunnel) { return !tunnel.rise_m.empty(); });
  if (!any) return nullptr;
  return std::shared_ptr<const TunnelRises>(new TunnelRises(parts_of(tunnels, rooms), reach_m));
}

TunnelRises::Parts TunnelRises::parts_of(const std::vector<TunnelLine>& tunnels,
                                         const std::vector<PlanPolygon>& rooms) {
  Parts parts;
  for (const TunnelLine& tunnel : tunnels) {
    double s_m = 0.0;
    for (std::size_t i = 1; i < tunnel.points.size(); ++i) {
      const Eigen::Vector2d along = tunnel.points[i] - tunnel.points[i - 1];
      const double length_m = along.norm();
      parts.shapes.emplace_back(TunnelSegment{tunnel.points[i - 1], along / length_m, length_m,
                                              tunnel.width_m / 2.0, false, false});
      parts.stretches.push_back({parts.lines.size(), s_m});
      s_m += length_m;
    }
    const auto grade = HeightProfile::grade_named(tunnel.rise_grade);
    const std::string what = fmt::format("tunnel {}: rise_m", quote(tunnel.name));
    parts.lines.push_back({HeightProfile(tunnel.rise_m, grade, what), s_m});
  }
  for (const PlanPolygon& room : rooms) {
    parts.shapes.emplace_back(room);
    parts.stretches.push_back({kRoom, 0.0});
  }
  return parts;
}

TunnelRises::TunnelRises(Parts parts, double reach_m)
    : reach_m_(reach_m),
      parts_(std::move(parts)),
      buckets_(parts_.shapes, kRiseBucketSide, reach_m) {}

double TunnelRises::rise_of(std::size_t shape, const Eigen::Vector2d& p_world) const {
  const Stretch& stretch = parts_.stretches[shape];
  if (stretch.line == kRoom) return 0.0;
  const Line& line = parts_.lines[stretch.line];
  const auto& segment = std::get<TunnelSegment>(parts_.shapes[shape]);
  // Beyond the ends of the segment, but not of the tunnel, the profile continues, so that a grade
  // goes through a bend.
  const double s_m = stretch.s_m + (p_world - segment.from).dot(segment.along);
  return line.rise.at(std::clamp(s_m, 0.0, line.length_m));
}

double TunnelRises::operator()(const Eigen::Vector2d& p_world) const {
  double sum = 0.0;
  double weights = 0.0;
  for (const std::uint32_t i : buckets_.at(p_world)) {
    const double within_m = depth_m(parts_.shapes[i], p_world) + reach_m_;
    if (within_m <= 0.0) continue;
    const double weight = within_m * within_m;
    sum += weight * rise_of(i, p_world);
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

}  // namespace adit
