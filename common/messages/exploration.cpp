// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/exploration.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include "common/messages/fields/navigation_fields.hpp"
#include "common/messages/fragments.hpp"
#include "common/messages/planar_geometry.hpp"

namespace adit {
namespace {

using Kind = ExplorationDecision::Kind;
using NodeKind = CorridorNode::Kind;

static_assert(static_cast<int>(Kind::kStay) == exploration_t::KIND_STAY);
static_assert(static_cast<int>(Kind::kGoTo) == exploration_t::KIND_GO_TO);
static_assert(static_cast<int>(Kind::kAlong) == exploration_t::KIND_ALONG);
static_assert(static_cast<int>(Kind::kHome) == exploration_t::KIND_HOME);
static_assert(static_cast<int>(Kind::kDone) == exploration_t::KIND_DONE);
static_assert(static_cast<int>(FrontierState::kOpen) == frontier_t::STATE_OPEN);
static_assert(static_cast<int>(FrontierState::kExplored) == frontier_t::STATE_EXPLORED);
static_assert(static_cast<int>(FrontierState::kBlocked) == frontier_t::STATE_BLOCKED);
static_assert(static_cast<int>(FrontierState::kTooNarrow) == frontier_t::STATE_TOO_NARROW);
static_assert(static_cast<int>(FrontierState::kBeyondBudget) == frontier_t::STATE_BEYOND_BUDGET);
static_assert(static_cast<int>(FrontierState::kUnobservable) == frontier_t::STATE_UNOBSERVABLE);
static_assert(static_cast<int>(FrontierState::kOutsideMine) == frontier_t::STATE_OUTSIDE_MINE);
static_assert(static_cast<int>(FrontierState::kUnconfirmed) == frontier_t::STATE_UNCONFIRMED);
static_assert(static_cast<int>(NodeKind::kJunction) == corridor_node_t::KIND_JUNCTION);
static_assert(static_cast<int>(NodeKind::kDeadEnd) == corridor_node_t::KIND_DEAD_END);
static_assert(static_cast<int>(NodeKind::kOpenEnd) == corridor_node_t::KIND_OPEN_END);

// Limit for frontiers, which leaves room for corridors.
constexpr std::size_t kFrontierBytes = kFragmentBytes / 2;
constexpr std::size_t kNodesMax = 800;
constexpr std::size_t kRouteMax = 200;

void set_vector(const Eigen::Vector2d& vector, double (&numbers)[2]) {
  numbers[0] = vector.x();
  numbers[1] = vector.y();
}

frontier_t to_message(const Frontier& frontier) {
  frontier_t message;
  message.id = frontier.id;
  message.local_map = frontier.local_map;
  set_vector(frontier.p_map, message.p_map);
  set_vector(frontier.direction_map, message.direction_map);
  message.width_m = frontier.width_m;
  message.state = static_cast<std::int8_t>(frontier.state);
  message.utime = frontier.utime;
  message.evidence = frontier.evidence.substr(0, kSentenceMax);
  return message;
}

Frontier frontier_from(const frontier_t& message) {
  return {message.id,
          message.local_map,
          {message.p_map[0], message.p_map[1]},
          {message.direction_map[0], message.direction_map[1]},
          message.width_m,
          FrontierState(message.state),
          message.utime,
          message.evidence};
}

corridor_t to_message(const Corridor& corridor) {
  corridor_t message;
  message.from = corridor.from;
  message.to = corridor.to;
  message.length_m = corridor.length_m;
  message.width_m = corridor.width_m;
  message.n_points = static_cast<std::int32_t>(corridor.points.size());
  for (const Eigen::Vector2d& p : corridor.points) {
    message.points_map.push_back({static_cast<float>(p.x()), static_cast<float>(p.y())});
  }
  return message;
}

bool is_node(int index, const exploration_t& message) {
  return index >= 0 && index < message.n_nodes;
}

std::string_view rejection_reason(const corridor_t& corridor, const exploration_t& message) {
  if (!is_node(corridor.from, message) || !is_node(corridor.to, message)) {
    return "corridor without nodes";
  }
  return corridor.points_map.size() < 2 ? "corridor with fewer than two points"
                                        : std::string_view{};
}

Corridor corridor_from(const corridor_t& message) {
  Corridor corridor{message.from, message.to, message.length_m, message.width_m, {}};
  for (const std::vector<float>& p : message.points_map) corridor.points.emplace_back(p[0], p[1]);
  return corridor;
}

std::string_view rejection_reason(const exploration_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return reason;
  if (message.n_frontiers_found < message.n_frontiers)
    return "frontier count below the number of frontiers";
  if (message.n_corridors_found < message.n_corridors)
    return "corridor count below the number of corridors";
  for (const corridor_t& corridor : message.corridors) {
    if (const auto reason = rejection_reason(corridor, message); !reason.empty()) return reason;
  }
  return {};
}

void set_decision(const ExplorationReport& report, exploration_t& message) {
  message.kind = static_cast<std::int8_t>(report.decision.kind);
  set_pose(report.decision.T_map_goal, message.T_map_goal);
  set_pose(report.T_odom_goal, message.T_odom_goal);
  for (const Eigen::Vector2d& p : report.route_odom) {
    if (message.route_odom.size() == kRouteMax) break;
    message.route_odom.push_back({static_cast<float>(p.x()), static_cast<float>(p.y())});
  }
  message.n_route = static_cast<std::int32_t>(message.route_odom.size());
  message.distance_m = report.decision.distance_m;
  message.frontier = report.decision.frontier;
  message.complete = static_cast<std::int8_t>(report.decision.complete);
  message.reason = report.decision.reason.substr(0, kSentenceMax);
}

void add_frontiers(std::vector<Frontier> frontiers, exploration_t& message) {
  std::stable_sort(frontiers.begin(), frontiers.end(), [](const Frontier& a, const Frontier& b) {
    return is_closed(a.state) < is_closed(b.state);
  });
  std::size_t bytes = 0;
  for (const Frontier& frontier : frontiers) {
    frontier_t part = to_message(frontier);
    bytes += static_cast<std::size_t>(part.getEncodedSize());
    if (bytes > kFrontierBytes) break;
    message.frontiers.push_back(std::move(part));
  }
  message.n_frontiers = static_cast<std::int32_t>(message.frontiers.size());
  message.n_frontiers_found = static_cast<std::int32_t>(frontiers.size());
}

void add_nodes(const std::vector<CorridorNode>& nodes, exploration_t& message) {
  for (const CorridorNode& node : nodes) {
    if (message.nodes.size() == kNodesMax) break;
    corridor_node_t part;
    set_vector(node.p_map, part.p_map);
    part.kind = static_cast<std::int8_t>(node.kind);
    message.nodes.push_back(part);
  }
  message.n_nodes = static_cast<std::int32_t>(message.nodes.size());
}

/// Must be called last: fills the remaining bytes.
void add_corridors(const std::vector<Corridor>& corridors, exploration_t& message) {
  message.n_corridors = 0;
  message.n_corridors_found = static_cast<std::int32_t>(corridors.size());
  auto bytes = static_cast<std::size_t>(message.getEncodedSize());
  for (const Corridor& corridor : corridors) {
    if (!is_node(corridor.from, message) || !is_node(corridor.to, message)) continue;
    corridor_t part = to_message(corridor);
    bytes += static_cast<std::size_t>(part.getEncodedSize());
    if (bytes > kFragmentBytes) break;
    message.corridors.push_back(std::move(part));
  }
  message.n_corridors = static_cast<std::int32_t>(message.corridors.size());
}

}  // namespace

exploration_t to_message(const ExplorationReport& report) {
  exploration_t message;
  message.utime = report.utime;
  message.revision = report.revision;
  message.request = report.request;
  set_decision(report, message);
  message.remaining_m = report.budget.remaining_m;
  message.explored_m = report.budget.explored_m;
  add_frontiers(report.frontiers, message);
  add_nodes(report.corridors.nodes, message);
  add_corridors(report.corridors.corridors, message);
  return message;
}

Result<ExplorationReport> from_message(const exploration_t& message) {
  if (const auto reason = rejection_reason(message); !reason.empty()) return Rejected{reason};
  ExplorationReport report;
  report.utime = message.utime;
  report.revision = message.revision;
  report.request = message.request;
  report.decision = {Kind(message.kind), pose_from(message.T_map_goal), message.distance_m,
                     message.frontier,   message.complete != 0,         message.reason};
  report.T_odom_goal = pose_from(message.T_odom_goal);
  for (const auto& p : message.route_odom) report.route_odom.emplace_back(p[0], p[1]);
  report.budget = {message.remaining_m, message.explored_m};
  for (const frontier_t& frontier : message.frontiers)
    report.frontiers.push_back(frontier_from(frontier));
  std::stable_sort(report.frontiers.begin(), report.frontiers.end(),
                   [](const Frontier& a, const Frontier& b) { return a.id < b.id; });
  for (const corridor_node_t& node : message.nodes) {
    report.corridors.nodes.push_back({{node.p_map[0], node.p_map[1]}, NodeKind(node.kind)});
  }
  for (const corridor_t& corridor : message.corridors) {
    report.corridors.corridors.push_back(corridor_from(corridor));
  }
  return report;
}

explore_request_t to_message(const ExploreRequest& request) {
  explore_request_t message;
  const BlockedVerdict verdict = request.blocked.value_or(BlockedVerdict{});
  message.utime = request.utime;
  message.id = request.id;
  message.remaining_m = request.remaining_m;
  message.returning_home = static_cast<std::int8_t>(request.returning_home);
  message.blocked = static_cast<std::int8_t>(request.blocked.has_value());
  message.blocked_utime = verdict.utime;
  message.blocked_frontier = verdict.frontier;
  message.reached_m = verdict.reached_m;
  message.evidence = verdict.evidence;
  message.unconfirmed = static_cast<std::int8_t>(verdict.unconfirmed);
  return message;
}

Result<ExploreRequest> from_message(const explore_request_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  ExploreRequest request{
      message.utime, message.id, message.remaining_m, message.returning_home != 0, {}};
  if (message.blocked != 0) {
    request.blocked = {message.blocked_utime, message.blocked_frontier, message.reached_m,
                       message.evidence, message.unconfirmed != 0};
  }
  return request;
}

}  // namespace adit
