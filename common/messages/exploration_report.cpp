// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/exploration_report.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "common/messages/pieces.hpp"
#include "common/messages/planar.hpp"

namespace adit {
namespace {

using Kind = ExplorationDecision::Kind;
using NodeKind = CorridorNode::Kind;

static_assert(static_cast<int>(Kind::kStay) == exploration_t::KIND_STAY);
static_assert(static_cast<int>(Kind::kGoTo) == exploration_t::KIND_GO_TO);
static_assert(static_cast<int>(Kind::kAlong) == exploration_t::KIND_ALONG);
static_assert(static_cast<int>(Kind::kHome) == exploration_t::KIND_HOME);
static_assert(static_cast<int>(Kind::kDone) == exploration_t::KIND_DONE);
static_assert(static_cast<int>(StubState::kOpen) == exploration_stub_t::STATE_OPEN);
static_assert(static_cast<int>(StubState::kExplored) == exploration_stub_t::STATE_EXPLORED);
static_assert(static_cast<int>(StubState::kBlocked) == exploration_stub_t::STATE_BLOCKED);
static_assert(static_cast<int>(StubState::kTooNarrow) == exploration_stub_t::STATE_TOO_NARROW);
static_assert(static_cast<int>(StubState::kBeyondBudget) ==
              exploration_stub_t::STATE_BEYOND_BUDGET);
static_assert(static_cast<int>(StubState::kUnseeable) == exploration_stub_t::STATE_UNSEEABLE);
static_assert(static_cast<int>(StubState::kWayOut) == exploration_stub_t::STATE_WAY_OUT);
static_assert(static_cast<int>(StubState::kDoubtful) == exploration_stub_t::STATE_DOUBTFUL);
static_assert(static_cast<int>(NodeKind::kJunction) == corridor_node_t::KIND_JUNCTION);
static_assert(static_cast<int>(NodeKind::kDeadEnd) == corridor_node_t::KIND_DEAD_END);
static_assert(static_cast<int>(NodeKind::kOpenEnd) == corridor_node_t::KIND_OPEN_END);

// So that the stubs leave room for corridors.
constexpr std::size_t kStubBytes = kPieceBytes / 2;
constexpr std::size_t kNodesMax = 800;
constexpr std::size_t kRouteMax = 200;

void set_vector(const Eigen::Vector2d& vector, double (&numbers)[2]) {
  numbers[0] = vector.x();
  numbers[1] = vector.y();
}

exploration_stub_t to_message(const Stub& stub) {
  exploration_stub_t message;
  message.id = stub.id;
  message.local_map = stub.local_map;
  set_vector(stub.p_map, message.p_map);
  set_vector(stub.direction_map, message.direction_map);
  message.width_m = stub.width_m;
  message.state = static_cast<std::int8_t>(stub.state);
  message.utime = stub.utime;
  message.evidence = stub.evidence.substr(0, kSentenceMax);
  return message;
}

std::string_view reason_to_refuse(const exploration_stub_t& message) {
  const auto state = StubState(message.state);
  if (!is_plausible_utime(message.utime)) return kImplausibleTime;
  if (message.id < 0 || message.local_map < 0) return "stub with a negative id or local map";
  if (state < StubState::kOpen || state > StubState::kDoubtful) return "stub of an unknown state";
  if (!all_finite(message.p_map) || !all_finite(message.direction_map) ||
      !std::isfinite(message.width_m)) {
    return "stub that is not finite";
  }
  return {};
}

Stub stub_from(const exploration_stub_t& message) {
  return {message.id,
          message.local_map,
          {message.p_map[0], message.p_map[1]},
          {message.direction_map[0], message.direction_map[1]},
          message.width_m,
          StubState(message.state),
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

std::string_view reason_to_refuse(const corridor_t& corridor, const exploration_t& message) {
  if (!is_node(corridor.from, message) || !is_node(corridor.to, message)) {
    return "corridor without its nodes";
  }
  if (!std::isfinite(corridor.length_m) || !std::isfinite(corridor.width_m)) {
    return "corridor that is not finite";
  }
  if (corridor.points_map.size() < 2) return "corridor without two ends";
  const auto& points = corridor.points_map;
  const bool sound = std::all_of(points.begin(), points.end(), [](const std::vector<float>& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]);
  });
  return sound ? std::string_view{} : "corridor that is not finite";
}

Corridor corridor_from(const corridor_t& message) {
  Corridor corridor{message.from, message.to, message.length_m, message.width_m, {}};
  for (const std::vector<float>& p : message.points_map) corridor.points.emplace_back(p[0], p[1]);
  return corridor;
}

std::string_view reason_to_refuse(const exploration_t& message) {
  const auto kind = Kind(message.kind);
  if (!is_plausible_utime(message.utime)) return kImplausibleTime;
  if (message.revision < 0) return "negative revision";
  if (message.request < 0) return "negative id";
  if (kind < Kind::kStay || kind > Kind::kDone) return "unknown kind of decision";
  if (message.stub < ExplorationDecision::kNoStub) return "target with a negative id";
  if (!all_finite(message.T_map_goal) || !all_finite(message.T_odom_goal)) return kPoseNotFinite;
  if (!std::isfinite(message.distance_m) || !std::isfinite(message.remaining_m) ||
      !std::isfinite(message.home_m) || !std::isfinite(message.explored_m)) {
    return "distance is not finite";
  }
  const auto& route = message.route_odom;
  const bool sound = std::all_of(route.begin(), route.end(),
                                 [](const std::vector<float>& p) { return all_finite(p); });
  if (!sound) return "route that is not finite";
  if (message.n_stubs_found < message.n_stubs) return "fewer stubs than are there";
  if (message.n_corridors_found < message.n_corridors) return "fewer corridors than are there";
  return {};
}

std::string_view reason_to_refuse(const corridor_node_t& message) {
  const auto kind = NodeKind(message.kind);
  if (kind < NodeKind::kJunction || kind > NodeKind::kOpenEnd) return "node of an unknown kind";
  return all_finite(message.p_map) ? std::string_view{} : "node that is not finite";
}

template <class Part>
std::string_view first_refusal(const std::vector<Part>& parts) {
  for (const Part& part : parts) {
    if (const auto reason = reason_to_refuse(part); !reason.empty()) return reason;
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
  message.stub = report.decision.stub;
  message.complete = static_cast<std::int8_t>(report.decision.complete);
  message.reason = report.decision.reason.substr(0, kSentenceMax);
}

void add_stubs(std::vector<Stub> stubs, exploration_t& message) {
  std::stable_sort(stubs.begin(), stubs.end(), [](const Stub& a, const Stub& b) {
    return is_closed(a.state) < is_closed(b.state);
  });
  std::size_t bytes = 0;
  for (const Stub& stub : stubs) {
    exploration_stub_t part = to_message(stub);
    bytes += static_cast<std::size_t>(part.getEncodedSize());
    if (bytes > kStubBytes) break;
    message.stubs.push_back(std::move(part));
  }
  message.n_stubs = static_cast<std::int32_t>(message.stubs.size());
  message.n_stubs_found = static_cast<std::int32_t>(stubs.size());
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

/// After everything else.
void add_corridors(const std::vector<Corridor>& corridors, exploration_t& message) {
  message.n_corridors = 0;
  message.n_corridors_found = static_cast<std::int32_t>(corridors.size());
  auto bytes = static_cast<std::size_t>(message.getEncodedSize());
  for (const Corridor& corridor : corridors) {
    if (!is_node(corridor.from, message) || !is_node(corridor.to, message)) continue;
    corridor_t part = to_message(corridor);
    bytes += static_cast<std::size_t>(part.getEncodedSize());
    if (bytes > kPieceBytes) break;
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
  message.home_m = report.budget.home_m;
  message.explored_m = report.budget.explored_m;
  add_stubs(report.stubs, message);
  add_nodes(report.corridors.nodes, message);
  add_corridors(report.corridors.corridors, message);
  return message;
}

Result<ExplorationReport> from_message(const exploration_t& message) {
  if (const auto reason = reason_to_refuse(message); !reason.empty()) return Refused{reason};
  if (const auto reason = first_refusal(message.stubs); !reason.empty()) return Refused{reason};
  if (const auto reason = first_refusal(message.nodes); !reason.empty()) return Refused{reason};
  ExplorationReport report;
  report.utime = message.utime;
  report.revision = message.revision;
  report.request = message.request;
  report.decision = {Kind(message.kind), pose_from(message.T_map_goal), message.distance_m,
                     message.stub,       message.complete != 0,         message.reason};
  report.T_odom_goal = pose_from(message.T_odom_goal);
  for (const auto& p : message.route_odom) report.route_odom.emplace_back(p[0], p[1]);
  report.budget = {message.remaining_m, message.home_m, message.explored_m};
  for (const exploration_stub_t& stub : message.stubs) report.stubs.push_back(stub_from(stub));
  std::stable_sort(report.stubs.begin(), report.stubs.end(),
                   [](const Stub& a, const Stub& b) { return a.id < b.id; });
  for (const corridor_node_t& node : message.nodes) {
    report.corridors.nodes.push_back({{node.p_map[0], node.p_map[1]}, NodeKind(node.kind)});
  }
  for (const corridor_t& corridor : message.corridors) {
    const auto reason = reason_to_refuse(corridor, message);
    if (!reason.empty()) return Refused{reason};
    report.corridors.corridors.push_back(corridor_from(corridor));
  }
  return report;
}

}  // namespace adit
