// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/driven_graph.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <unordered_map>
#include <utility>

#include "common/geometry/polyline.hpp"

namespace adit {
namespace {

// Tolerance of equal poses: half the distance of stored poses along the path, beside it the
// accuracy of driving.
constexpr double kSameAlongM = 0.15;
constexpr double kSameBesideM = 0.1;
constexpr double kSameRad = 0.1;
constexpr double kSameLevelM = 2.5;  // heights of the body on one level differ by less

constexpr double kLateralMaxM = 1.0;   // of both ends of a path beside its route
constexpr double kAsideMaxM = 4.0;     // of the path itself: to turn at a junction
constexpr double kDetourM = 2.0;       // of a path against its route
constexpr double kDetourShare = 0.35;  // the same as a share of the length along the route
constexpr double kDetourMaxM = 8.0;
constexpr double kJoinFactor = 1.05;
constexpr double kSearchM = 2.0;     // for the place on the route of the next node
constexpr double kGapM = 0.5;        // longer edges were torn by a correction of the map
constexpr double kBackwardM = 0.05;  // less is the noise of a turn on the spot

}  // namespace

bool is_same_level(double z_a_m, double z_b_m) { return std::abs(z_a_m - z_b_m) < kSameLevelM; }

bool is_same(const DrivenPose& a, const DrivenPose& b) {
  // Before the transformation, for speed.
  constexpr double kFarM = kSameAlongM + kSameBesideM;
  if (std::abs(a.x - b.x) > kFarM || std::abs(a.y - b.y) > kFarM) return false;
  const Pose2 T_a_b = between(a, b);
  return is_same_level(a.z_m, b.z_m) && std::abs(T_a_b.x) < kSameAlongM &&
         std::abs(T_a_b.y) < kSameBesideM && std::abs(T_a_b.theta) < kSameRad;
}

std::size_t DrivenGraph::add(const DrivenPose& pose, double driven_m) {
  const auto same =
      std::ranges::find_if(nodes_, [&](const Node& node) { return is_same(node.pose, pose); });
  const auto node = static_cast<std::size_t>(same - nodes_.begin());
  if (same == nodes_.end()) nodes_.emplace_back();
  update(node, pose, driven_m);
  return node;
}

void DrivenGraph::update(std::size_t node, const DrivenPose& pose, double driven_m) {
  nodes_[node].pose = pose;
  nodes_[node].driven_m = driven_m;
}

void DrivenGraph::connect(std::size_t a, std::size_t b) {
  auto& neighbours = nodes_[a].neighbours;
  if (a == b || std::ranges::find(neighbours, b) != neighbours.end()) return;
  neighbours.push_back(b);
  nodes_[b].neighbours.push_back(a);
}

void DrivenGraph::move(const Pose2& T_after_before, double z_after_before_m, double driven_max_m) {
  for (Node& node : nodes_) {
    if (node.driven_m > driven_max_m) continue;
    node.pose = {T_after_before * node.pose, z_after_before_m + node.pose.z_m};
  }
}

void DrivenGraph::prepend(const DrivenGraph& earlier) {
  for (Node& node : nodes_) {
    for (std::size_t& neighbour : node.neighbours) neighbour += earlier.size();
  }
  nodes_.insert(nodes_.begin(), earlier.nodes_.begin(), earlier.nodes_.end());
}

GraphPath DrivenGraph::along(std::size_t from, const std::vector<Eigen::Vector2d>& route,
                             const PathOptions& options) const {
  if (route.size() < 2) return {};
  const Polyline::Nearest start =
      Polyline(route).nearest(nodes_[from].pose.translation(), 0.0, kLateralMaxM + kDetourM);
  if (start.beside_m > kLateralMaxM) return {};
  return search({{from, start.at_m, 0.0}}, route, options);
}

GraphPath DrivenGraph::joining(const std::vector<Eigen::Vector2d>& route, double join_m,
                               double z_m) const {
  if (route.size() < 2) return {};
  const Polyline places(route);
  std::vector<Source> sources;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const DrivenPose& pose = nodes_[i].pose;
    const bool is_far = (pose.translation() - route.front()).norm() > join_m + kLateralMaxM;
    if (is_far || !is_same_level(pose.z_m, z_m)) continue;
    const Polyline::Nearest place = places.nearest(pose.translation(), 0.0, join_m);
    // A little more than the driven ground costs, so that the path begins as early as it can.
    if (place.beside_m <= kLateralMaxM && place.at_m < join_m)
      sources.push_back({i, place.at_m, kJoinFactor * place.at_m});
  }
  return search(sources, route, {});
}

/// Dijkstra's search by the length of the path. Each node has its place on the route, which is
/// sought near that of the node before. A path that pays for a longer part of the route may be
/// longer: where the robot went past a junction and entered it from there, it has to go there to
/// turn.
GraphPath DrivenGraph::search(const std::vector<Source>& sources,
                              const std::vector<Eigen::Vector2d>& route,
                              const PathOptions& options) const {
  struct Reached {
    double length_m = 0.0;
    double along_m = 0.0;
    double lateral_m = 0.0;
    std::size_t before = 0;
  };
  using Entry = std::pair<double, std::size_t>;  // length of the path, node
  const Polyline places(route);
  std::unordered_map<std::size_t, Reached> reached;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (const Source& source : sources) {
    reached[source.node] = {source.length_m, source.along_m, 0.0, source.node};
    open.emplace(source.length_m, source.node);
  }
  std::optional<std::size_t> farthest;
  while (!open.empty()) {
    const auto [length_m, at] = open.top();
    open.pop();
    const Reached here = reached.at(at);
    if (length_m > here.length_m) continue;  // a shorter path was found since
    const double detour_max_m = std::max(kDetourM, kDetourShare * here.along_m);
    if (here.lateral_m <= kLateralMaxM && length_m <= here.along_m + detour_max_m &&
        (!farthest || here.along_m > reached.at(*farthest).along_m))
      farthest = at;
    for (const std::size_t next : nodes_[at].neighbours) {
      const Pose2 step = between(nodes_[at].pose, nodes_[next].pose);
      const double step_m = step.translation().norm();
      if (step_m > kGapM || (!options.may_reverse && step.x < -kBackwardM)) continue;
      if (options.among && !options.among->contains(next)) continue;
      const Polyline::Nearest place =
          places.nearest(nodes_[next].pose.translation(), here.along_m - kSearchM,
                         here.along_m + step_m + kSearchM);
      const Reached there{length_m + step_m, place.at_m, place.beside_m, at};
      if (there.lateral_m > kAsideMaxM || there.length_m > there.along_m + kDetourMaxM) continue;
      const auto [known, is_new] = reached.emplace(next, there);
      if (!is_new && known->second.length_m <= there.length_m) continue;
      known->second = there;
      open.emplace(there.length_m, next);
    }
  }
  GraphPath path;
  if (!farthest) return path;
  path.shared_m = reached.at(*farthest).along_m;
  std::size_t at = *farthest;
  while (reached.at(at).before != at) {
    path.nodes.push_back(at);
    at = reached.at(at).before;
  }
  path.nodes.push_back(at);
  std::ranges::reverse(path.nodes);
  return path;
}

}  // namespace adit
