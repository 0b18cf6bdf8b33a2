// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/drive_command_t.hpp"
#include "adit/driving_state_t.hpp"
#include "adit/exploration_t.hpp"
#include "adit/explore_request_t.hpp"
#include "adit/mission_order_t.hpp"
#include "adit/phase_t.hpp"
#include "adit/plan_goal_t.hpp"
#include "adit/planned_path_t.hpp"
#include "adit/stop_t.hpp"
#include "adit/vehicle_state_t.hpp"

#include "common/messages/fields/fields.hpp"

/// The fields of the messages from exploration to the wheels, see Fields.
namespace adit {

template <>
struct Fields<plan_goal_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("id", m.id, kId);
    field("kind", m.kind, code(plan_goal_t::KIND_REJOIN, "unknown kind"));
    field.pose("T_odom_goal", m.T_odom_goal);
    field("distance_max_m", m.distance_max_m,
          Quantity{1e-6, kDistance.max, "distance is not positive"});
    field("n_route", m.n_route, kCount.because("invalid route"));
    field("route_odom", m.route_odom, kPosition);
    field("n_traversed_path", m.n_traversed_path, kCount.because("invalid traversed path"));
    field.pose("traversed_path_odom", m.traversed_path_odom);
  }
};

template <>
struct Fields<path_point_t> {
  static void visit(auto& m, auto& field) {
    field.pose("T_odom_body", m.T_odom_body);
    field("curvature_1_m", m.curvature_1_m, kCurvature);
    field("reverse", m.reverse, kFlag);
    field("clearance_m", m.clearance_m,
          kSignedDistance.or_exactly(kInfinity).because("implausible clearance"));
    field("cost", m.cost, kCost);
  }
};

template <>
struct Fields<blocking_cell_t> {
  static void visit(auto& m, auto& field) {
    field("p_odom", m.p_odom, kPosition);
    field("reason", m.reason, code(blocking_cell_t::REASON_DROP, "unknown blocking reason"));
    field("height_m", m.height_m, kHeight.or_nan().or_exactly(kInfinity));
  }
};

template <>
struct Fields<planned_path_t> {
  static void visit(auto& m, auto& field) {
    constexpr const char* kFewer = "cell count below the number of blocking cells";
    field("utime", m.utime, kTime);
    field("id", m.id, kId);
    field("outcome", m.outcome, code(planned_path_t::OUTCOME_NARROW, "unknown outcome"));
    field("reason", m.reason, kSentence);
    field("reached_m", m.reached_m, kSignedDistance);
    field("n_points", m.n_points, kCount);
    field.parts(m.points);
    field("n_blocking_found", m.n_blocking_found, kCount.because(kFewer));
    field("n_blocking", m.n_blocking, kCount);
    field.parts(m.blocking);
  }
};

template <>
struct Fields<driving_state_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("path_id", m.path_id, kId);
    field("state", m.state, code(driving_state_t::STATE_FAILED, "unknown state"));
    field("reason", m.reason, kSentence);
    field("progress_m", m.progress_m, kDistance);
    field("remaining_m", m.remaining_m, kDistance);
    field("lateral_error_m", m.lateral_error_m,
          kSignedDistance.because("implausible lateral error"));
    field("heading_error_rad", m.heading_error_rad, kHeading.because("implausible heading error"));
  }
};

template <>
struct Fields<drive_command_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("speed_m_s", m.speed_m_s, kSpeed);
    field("curvature_1_m", m.curvature_1_m, kCurvature);
  }
};

template <>
struct Fields<stop_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("stopped", m.stopped, kAny);  // anything but 0 stops
    field("reason", m.reason, kSentence);
  }
};

template <>
struct Fields<vehicle_state_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("speed_m_s", m.speed_m_s, kSpeed);
    field("curvature_1_m", m.curvature_1_m, kCurvature);
    field("battery_share", m.battery_share, kShare);
    field("stopped", m.stopped, kFlag);
    field("expired", m.expired, kFlag);
  }
};

template <>
struct Fields<frontier_t> {
  static void visit(auto& m, auto& field) {
    constexpr const char* kNegative = "frontier with a negative id or local map";
    field("id", m.id, kId.because(kNegative));
    field("local_map", m.local_map, kId.because(kNegative));
    field("p_map", m.p_map, kPosition);
    field("direction_map", m.direction_map, kComponent);
    field("width_m", m.width_m, kDistance);
    field("state", m.state, code(frontier_t::STATE_UNCONFIRMED, "unknown frontier state"));
    field("utime", m.utime, kTime);
    field("evidence", m.evidence, kSentence);
  }
};

template <>
struct Fields<corridor_node_t> {
  static void visit(auto& m, auto& field) {
    field("p_map", m.p_map, kPosition);
    field("kind", m.kind, code(corridor_node_t::KIND_OPEN_END, "unknown node kind"));
  }
};

template <>
struct Fields<corridor_t> {
  static void visit(auto& m, auto& field) {
    field("from", m.from, kId.because("corridor without nodes"));
    field("to", m.to, kId.because("corridor without nodes"));
    field("length_m", m.length_m, kDistance);
    field("width_m", m.width_m, kDistance);
    field("n_points", m.n_points, kCount);
    field("points_map", m.points_map, kPosition);
  }
};

template <>
struct Fields<exploration_t> {
  static void visit(auto& m, auto& field) {
    constexpr const char* kFrontiers = "frontier count below the number of frontiers";
    constexpr const char* kCorridors = "corridor count below the number of corridors";
    field("utime", m.utime, kTime);
    field("revision", m.revision, kRevision);
    field("request", m.request, kId);
    field("kind", m.kind, code(exploration_t::KIND_DONE, "unknown decision"));
    field.pose("T_map_goal", m.T_map_goal);
    field.pose("T_odom_goal", m.T_odom_goal);
    field("n_route", m.n_route, kCount);
    field("route_odom", m.route_odom, kPosition);
    field("distance_m", m.distance_m, kSignedDistance);
    field("frontier", m.frontier, kOptionalId.because("negative frontier id"));
    field("complete", m.complete, kFlag);
    field("reason", m.reason, kSentence);
    field("remaining_m", m.remaining_m, kSignedDistance);
    field("explored_m", m.explored_m, kSignedDistance);
    field("n_frontiers_found", m.n_frontiers_found, kCount.because(kFrontiers));
    field("n_frontiers", m.n_frontiers, kCount);
    field.parts(m.frontiers);
    field("n_nodes", m.n_nodes, kCount);
    field.parts(m.nodes);
    field("n_corridors_found", m.n_corridors_found, kCount.because(kCorridors));
    field("n_corridors", m.n_corridors, kCount);
    field.parts(m.corridors);
  }
};

template <>
struct Fields<explore_request_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("id", m.id, Quantity{1.0, kInt32Max, "id is not positive"});
    field("remaining_m", m.remaining_m, kDistance);
    field("returning_home", m.returning_home, kFlag);
    field("blocked", m.blocked, kFlag);
    field("blocked_utime", m.blocked_utime, kTime);
    field("blocked_frontier", m.blocked_frontier, kOptionalId.because("negative frontier id"));
    field("reached_m", m.reached_m, kDistance);
    field("evidence", m.evidence, kSentence);
    field("unconfirmed", m.unconfirmed, kFlag);
  }
};

template <>
struct Fields<phase_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("sequence", m.sequence, kCount);
    field("phase", m.phase, code(phase_t::PHASE_ENDED, "unknown phase"));
    field("reason", m.reason, kSentence);
    field("returning_home", m.returning_home, kFlag);
    field("return_home_reason", m.return_home_reason, kSentence);
    field("laser", m.laser, kName);
    field("goal_id", m.goal_id, kCount);
    field("frontier", m.frontier, kOptionalId.because("negative frontier id"));
    field("scans", m.scans, kCount);
    field("distance_travelled_m", m.distance_travelled_m, kDistance);
    field("remaining_m", m.remaining_m, kDistance);
    field("outcome", m.outcome, code(phase_t::OUTCOME_HOME_UNCERTAIN, "unknown outcome"));
    field("home_within_m", m.home_within_m, kDistance.or_exactly(-1.0));
    field("complete", m.complete, kFlag);
  }
};

template <>
struct Fields<mission_order_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("kind", m.kind, code(mission_order_t::KIND_STOP, "unknown order"));
  }
};

}  // namespace adit
