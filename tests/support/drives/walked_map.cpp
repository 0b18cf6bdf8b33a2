// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/drives/walked_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

namespace adit::test {
namespace {

constexpr std::int64_t kStartUtime = 1'600'000'000'000'000;
constexpr std::int64_t kStepUs = 400'000;
constexpr std::int64_t kRearUs = 10'000;  // after the front laser
// Standard deviations of the constant errors of a walk: within what mapping expects of scan
// matching.
constexpr double kTurnPerStepSd = 2.5e-5;
constexpr double kLengthSd = 0.0005;

/// The poses along a path: steps, and turns on the spot.
std::vector<Pose2> poses_along(const std::vector<Eigen::Vector2d>& path,
                               const WalkOptions& options) {
  std::vector<Pose2> poses;
  double heading = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Eigen::Vector2d leg = path[i + 1] - path[i];
    if (leg.norm() < 1e-6) continue;
    const double towards = std::atan2(leg.y(), leg.x());
    if (poses.empty()) heading = towards;
    const double turn = angle_diff(towards, heading);
    const int turns = static_cast<int>(std::ceil(std::abs(turn) / options.turn_rad));
    for (int k = 1; k <= turns; ++k)
      poses.push_back({path[i].x(), path[i].y(), wrap_angle(heading + turn * k / turns)});
    heading = towards;
    const int steps = std::max(1, static_cast<int>(std::round(leg.norm() / options.step_m)));
    for (int k = poses.empty() ? 0 : 1; k <= steps; ++k) {
      const Eigen::Vector2d p = path[i] + leg * k / steps;
      poses.push_back({p.x(), p.y(), heading});
    }
  }
  return poses;
}

ScanMatch match_at(std::int64_t utime, const std::string& channel, const Pose2& T_odom_body) {
  ScanMatch match;
  match.utime = utime;
  match.odom_epoch_utime = kStartUtime;
  match.channel = channel;
  const bool first = utime < kStartUtime + kStepUs;
  match.status = first ? ScanMatch::Status::kFirstScan : ScanMatch::Status::kMatched;
  match.reference_utime = first ? 0 : utime - kStepUs;
  match.T_odom_body = T_odom_body;
  match.attitude = Attitude{};
  return match;
}

/// Walks the tunnels in depth first order.
class Tour {
 public:
  Tour(const TunnelGraph& tunnels, double length_m, std::size_t first_edge)
      : tunnels_(tunnels), left_m_(length_m), first_edge_(first_edge) {}

  std::vector<Eigen::Vector2d> from(int node) {
    path_.push_back(tunnels_.nodes[static_cast<std::size_t>(node)].p_world);
    visit(node);
    return path_;
  }

 private:
  void visit(int node) {
    for (std::size_t k = 0; k < tunnels_.edges.size(); ++k) {
      const std::size_t edge = (k + first_edge_) % tunnels_.edges.size();
      const TunnelEdge& e = tunnels_.edges[edge];
      if (e.from != node && e.to != node) continue;
      if (left_m_ < 2.0 * e.length_m || !walked_.insert(edge).second) continue;
      left_m_ -= 2.0 * e.length_m;
      std::vector<Eigen::Vector2d> points = e.points;
      if (e.to == node) std::ranges::reverse(points);
      path_.insert(path_.end(), points.begin(), points.end());
      visit(e.to == node ? e.from : e.to);
      path_.insert(path_.end(), points.rbegin(), points.rend());
    }
  }

  const TunnelGraph& tunnels_;
  double left_m_;
  std::size_t first_edge_;
  std::set<std::size_t> walked_;
  std::vector<Eigen::Vector2d> path_;
};

}  // namespace

Lasers lasers_at_ends(double from_middle_m) {
  Lasers lasers;
  lasers.front.T_body_laser = {from_middle_m, 0.0, 0.0};
  lasers.rear.T_body_laser = {-from_middle_m, 0.0, std::numbers::pi};
  return lasers;
}

WalkedMap walked_map(const WallWorld& world, const std::vector<Eigen::Vector2d>& path,
                     const WalkOptions& options) {
  MappingParams params;
  params.lasers = options.lasers;
  WalkedMap walked{std::make_unique<Mapping>(params), {}, options.lasers};
  std::mt19937_64 random(options.seed);
  std::normal_distribution<double> normal;
  const double turn_per_step = kTurnPerStepSd * normal(random);
  const double length_scale = 1.0 + kLengthSd * normal(random);
  LevelLaser front(world, 2 * options.seed);
  LevelLaser rear(world, 2 * options.seed + 1);
  Pose2 T_odom_body;
  std::int64_t utime = kStartUtime;
  const std::vector<Pose2> poses = poses_along(path, options);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i > 0) {
      const Pose2 moved = between(poses[i - 1], poses[i]);
      T_odom_body = T_odom_body * Pose2{length_scale * moved.x, length_scale * moved.y,
                                        moved.theta + turn_per_step};
    }
    const std::array<LevelLaser*, 2> lasers{&front, &rear};
    for (std::size_t k = 0; k < lasers.size(); ++k) {
      const LaserMount& mount = k == 0 ? options.lasers.front : options.lasers.rear;
      const std::string channel = k == 0 ? "LASER_FRONT" : "LASER_REAR";
      const std::int64_t at = utime + (k == 0 ? 0 : kRearUs);
      walked.truth[at] = poses[i];
      static_cast<void>(walked.map->add(channel,
                                        lasers[k]->measure(poses[i] * mount.T_body_laser, at),
                                        match_at(at, channel, T_odom_body)));
    }
    utime += kStepUs;
  }
  static_cast<void>(walked.map->finish());
  return walked;
}

std::vector<Eigen::Vector2d> tour(const TunnelGraph& tunnels, int from_node, double length_m,
                                  std::size_t first_edge) {
  return Tour(tunnels, length_m, first_edge).from(from_node);
}

}  // namespace adit::test
