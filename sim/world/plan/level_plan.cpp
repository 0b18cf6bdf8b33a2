// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/plan/level_plan.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "common/text/message_text.hpp"
#include "sim/world/plan/plan_geometry.hpp"

namespace adit {
namespace {

// Of the overlap beyond half a width, so that the profile of a segment before it has no weight at
// the joint [m].
constexpr double kOverlapBeyondWidth = 3.0;
constexpr double kInLine = 1e-6;     // of directions
constexpr double kZoneMargin = 1.5;  // around an overlap: relief of the walls, and the grid [m]

const Eigen::Vector2d& end_of(const TunnelLine& line, bool at_end) {
  return at_end ? line.points.back() : line.points.front();
}

/// Unit, out of the tunnel at its end.
Eigen::Vector2d outwards(const TunnelLine& line, bool at_end) {
  const std::size_t n = line.points.size();
  return (at_end ? line.points[n - 1] - line.points[n - 2] : line.points[0] - line.points[1])
      .normalized();
}

[[noreturn]] void fail_joint(const TunnelLine& a, const TunnelLine& b, const std::string& why) {
  throw std::invalid_argument(
      fmt::format("tunnels {} of level {} and {} of level {} have a common end, but {}",
                  quote(a.name), a.level, quote(b.name), b.level, why));
}

/// Adds a point at a distance from an end, unless there is one.
void split_at(TunnelLine& line, bool at_end, double distance_m) {
  const Eigen::Vector2d p = end_of(line, at_end) - distance_m * outwards(line, at_end);
  line.points.insert(at_end ? line.points.end() - 1 : line.points.begin() + 1, p);
}

double end_length_m(const TunnelLine& line, bool at_end) {
  const std::size_t n = line.points.size();
  return at_end ? (line.points[n - 1] - line.points[n - 2]).norm()
                : (line.points[1] - line.points[0]).norm();
}

/// The segment at an end, as a line of its own with the same rise.
TunnelLine tail_of(const TunnelLine& line, bool at_end) {
  TunnelLine tail = line;
  const std::size_t n = line.points.size();
  if (at_end) {
    tail.points = {line.points[n - 2], line.points[n - 1]};
    const double cut_m = line.length_m() - tail.length_m();
    for (std::size_t i = 0; i < tail.rise_m.size(); i += 2) tail.rise_m[i] -= cut_m;
  } else {
    tail.points = {line.points[0], line.points[1]};
  }
  tail.name += "_joint";
  tail.entrance = false;
  return tail;
}

/// Position relative to a joint: along it, and across.
Eigen::Vector2d relative_to(const LevelJoint& joint, const Eigen::Vector2d& p_world) {
  const Eigen::Vector2d off = p_world - joint.p_world;
  return {joint.along.dot(off), cross(joint.along, off)};
}

bool is_in_zone(const LevelJoint& joint, const Eigen::Vector2d& relative) {
  return std::abs(relative.x()) <= joint.overlap_m + joint.half_width_m + kZoneMargin &&
         std::abs(relative.y()) <= joint.half_width_m + kZoneMargin;
}

}  // namespace

LevelPlan::LevelPlan(std::vector<TunnelLine> tunnels) : tunnels_(std::move(tunnels)) {
  std::set<int> levels;
  for (const TunnelLine& tunnel : tunnels_) levels.insert(tunnel.level);
  if (levels.empty()) levels.insert(0);
  levels_.assign(levels.begin(), levels.end());
  for (std::size_t a = 0; a < tunnels_.size(); ++a) {
    for (std::size_t b = 0; b < tunnels_.size(); ++b) {
      if (tunnels_[a].level >= tunnels_[b].level) continue;
      for (const bool a_at_end : {false, true}) {
        for (const bool b_at_end : {false, true}) {
          if (end_of(tunnels_[a], a_at_end) != end_of(tunnels_[b], b_at_end)) continue;
          add_joint(a, a_at_end, b, b_at_end);
        }
      }
    }
  }
  check_surroundings();
}

void LevelPlan::add_joint(std::size_t a, bool a_at_end, std::size_t b, bool b_at_end) {
  TunnelLine& low = tunnels_[a];
  TunnelLine& high = tunnels_[b];
  if (low.width_m != high.width_m) fail_joint(low, high, "have not the same width");
  const Eigen::Vector2d along = outwards(low, a_at_end);
  if ((along + outwards(high, b_at_end)).norm() > kInLine)
    fail_joint(low, high, "meet at an angle");
  const double half_width_m = low.width_m / 2.0;
  const double overlap_m = half_width_m + kOverlapBeyondWidth;
  for (const auto& [line, at_end] : {std::pair(&low, a_at_end), std::pair(&high, b_at_end)}) {
    if (end_length_m(*line, at_end) <= overlap_m) {
      fail_joint(low, high, fmt::format("are not straight for {:.1f} m there", overlap_m));
    }
    split_at(*line, at_end, overlap_m);
  }
  tails_.push_back({high.level, tail_of(low, a_at_end)});
  tails_.push_back({low.level, tail_of(high, b_at_end)});
  joints_.push_back({end_of(low, a_at_end), along, low.level, high.level, half_width_m, overlap_m});
}

void LevelPlan::check_surroundings() const {
  constexpr double kStep = 0.5;
  for (const LevelJoint& joint : joints_) {
    for (const TunnelLine& line : tunnels_) {
      if (line.level != joint.low && line.level != joint.high) continue;
      const double length_m = line.length_m();
      for (double s_m = 0.0; s_m <= length_m; s_m += kStep) {
        // The tunnels of the joint itself lie in its direction.
        const Eigen::Vector2d relative = relative_to(joint, line.at(s_m).p_world);
        const bool of_joint =
            std::abs(relative.y()) < kInLine &&
            (line.points.front() == joint.p_world || line.points.back() == joint.p_world);
        const double near_m = line.width_m / 2.0 + joint.half_width_m + kZoneMargin;
        const bool is_near =
            std::abs(relative.x()) < joint.overlap_m + near_m && std::abs(relative.y()) < near_m;
        if (of_joint || !is_near) continue;
        // The tunnel of the joint may bend beyond the overlap.
        const bool continues =
            (line.points.front() == joint.p_world && s_m > joint.overlap_m &&
             s_m < joint.overlap_m + 2.0 * near_m) ||
            (line.points.back() == joint.p_world && length_m - s_m > joint.overlap_m &&
             length_m - s_m < joint.overlap_m + 2.0 * near_m);
        if (continues) continue;
        throw std::invalid_argument(fmt::format(
            "tunnel {} is too close to the joint of levels {} and {} at x {:.1f}, y {:.1f}",
            quote(line.name), joint.low, joint.high, joint.p_world.x(), joint.p_world.y()));
      }
    }
  }
}

std::vector<TunnelLine> LevelPlan::lines_on(int level) const {
  std::vector<TunnelLine> lines;
  for (const TunnelLine& tunnel : tunnels_) {
    if (tunnel.level == level) lines.push_back(tunnel);
  }
  for (const Tail& tail : tails_) {
    if (tail.level == level) lines.push_back(tail.line);
  }
  return lines;
}

bool LevelPlan::owns(int level, const Eigen::Vector2d& p_world) const {
  return std::none_of(joints_.begin(), joints_.end(), [&](const LevelJoint& joint) {
    const Eigen::Vector2d relative = relative_to(joint, p_world);
    if (!is_in_zone(joint, relative)) return false;
    // Of points on the line itself, one level owns each.
    return (level == joint.low && relative.x() > 0.0) ||
           (level == joint.high && relative.x() <= 0.0);
  });
}

bool LevelPlan::is_at_joint(int level, const Eigen::Vector2d& p_world) const {
  return std::any_of(joints_.begin(), joints_.end(), [&](const LevelJoint& joint) {
    return (level == joint.low || level == joint.high) &&
           is_in_zone(joint, relative_to(joint, p_world));
  });
}

bool is_level_joint(const std::vector<TunnelLine>& tunnels, std::size_t tunnel,
                    const Eigen::Vector2d& end) {
  return std::any_of(tunnels.begin(), tunnels.end(), [&](const TunnelLine& other) {
    return other.level != tunnels[tunnel].level &&
           (other.points.front() == end || other.points.back() == end);
  });
}

}  // namespace adit
