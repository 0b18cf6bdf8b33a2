// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mapping/pose_graph.hpp"

#include <algorithm>
#include <string_view>

#include "common/messages/fields/mapping_fields.hpp"
#include "common/messages/fragments.hpp"
#include "common/messages/planar_geometry.hpp"

namespace adit {
namespace {

using Kind = MapConstraint::Kind;

static_assert(static_cast<int>(Kind::kSequential) == pose_constraint_t::KIND_SEQUENTIAL);
static_assert(static_cast<int>(Kind::kLoopClosure) == pose_constraint_t::KIND_LOOP_CLOSURE);

pose_constraint_t to_message(const MapConstraint& constraint) {
  pose_constraint_t message;
  message.from = constraint.measured.from;
  message.to = constraint.measured.to;
  message.kind = static_cast<std::int8_t>(constraint.kind);
  set_pose(constraint.measured.T_from_to, message.T_from_to);
  set_matrix(constraint.measured.information, message.information);
  return message;
}

MapConstraint constraint_from(const pose_constraint_t& message) {
  return {
      {message.from, message.to, pose_from(message.T_from_to), matrix_from(message.information)},
      Kind(message.kind)};
}

std::string_view header_rejection_reason(const pose_graph_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return reason;
  if (message.n_nodes > PoseGraphFragment::kNodesMax) return "implausible number of nodes";
  const auto reason = fragment_rejection_reason(message, PoseGraphFragment::kFragmentsMax);
  if (!reason.empty()) return reason;
  if (message.first_node > message.n_nodes - message.n_poses) {
    return "poses of nodes outside the graph";
  }
  return {};
}

std::string_view rejection_reason(const pose_constraint_t& message, std::int32_t n_nodes) {
  const auto is_node = [&](std::int32_t node) { return node >= 0 && node < n_nodes; };
  if (!is_node(message.from) || !is_node(message.to))
    return "constraint of a node outside the graph";
  if (message.from == message.to) return "constraint of a node with itself";
  return {};
}

}  // namespace

pose_graph_t to_message(const PoseGraphFragment& fragment) {
  pose_graph_t message;
  message.utime = fragment.utime;
  message.revision = fragment.revision;
  message.n_nodes = fragment.n_nodes;
  message.n_fragments = fragment.n_fragments;
  message.fragment = fragment.fragment;
  message.first_node = fragment.first_node;
  message.n_poses = static_cast<std::int32_t>(fragment.poses.size());
  for (const Pose2& pose : fragment.poses) message.poses.push_back({pose.x, pose.y, pose.theta});
  message.z_m = fragment.z_m;
  message.z_variance = fragment.z_variance;
  message.n_constraints = static_cast<std::int32_t>(fragment.constraints.size());
  for (const MapConstraint& constraint : fragment.constraints) {
    message.constraints.push_back(to_message(constraint));
  }
  return message;
}

Result<PoseGraphFragment> from_message(const pose_graph_t& message) {
  if (const auto reason = header_rejection_reason(message); !reason.empty())
    return Rejected{reason};
  PoseGraphFragment fragment{message.utime,
                             message.revision,
                             message.n_nodes,
                             message.n_fragments,
                             message.fragment,
                             message.first_node,
                             {},
                             message.z_m,
                             message.z_variance,
                             {}};
  for (const auto& numbers : message.poses) {
    fragment.poses.push_back({numbers[0], numbers[1], numbers[2]});
  }
  for (const pose_constraint_t& constraint : message.constraints) {
    const auto reason = rejection_reason(constraint, message.n_nodes);
    if (!reason.empty()) return Rejected{reason};
    fragment.constraints.push_back(constraint_from(constraint));
  }
  return fragment;
}

namespace {

// Encoded sizes.
constexpr std::size_t kHeaderBytes = 64;
constexpr std::size_t kPoseBytes = 5 * sizeof(double);
constexpr std::size_t kConstraintBytes = 2 * sizeof(int) + 1 + 12 * sizeof(double);

}  // namespace

std::vector<PoseGraphFragment> split(const MapGraph& graph) {
  PoseGraphFragment empty;
  empty.utime = graph.utime;
  empty.revision = graph.revision;
  empty.n_nodes = static_cast<int>(graph.poses.size());
  std::vector<PoseGraphFragment> fragments = {empty};
  std::size_t bytes = kHeaderBytes;
  const auto fragment_with_room = [&](std::size_t more,
                                      std::size_t first_node) -> PoseGraphFragment& {
    if (bytes + more > kFragmentBytes) {
      fragments.push_back(empty);
      fragments.back().first_node = static_cast<int>(first_node);
      bytes = kHeaderBytes;
    }
    bytes += more;
    return fragments.back();
  };
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    PoseGraphFragment& fragment = fragment_with_room(kPoseBytes, i);
    fragment.poses.push_back(graph.poses[i]);
    fragment.z_m.push_back(i < graph.z_m.size() ? graph.z_m[i] : 0.0);
    fragment.z_variance.push_back(i < graph.z_variance.size() ? graph.z_variance[i] : 0.0);
  }
  for (const MapConstraint& constraint : graph.constraints) {
    fragment_with_room(kConstraintBytes, graph.poses.size()).constraints.push_back(constraint);
  }
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    fragments[i].n_fragments = static_cast<int>(fragments.size());
    fragments[i].fragment = static_cast<int>(i);
  }
  return fragments;
}

bool same_header(const PoseGraphFragment& a, const PoseGraphFragment& b) {
  return a.n_nodes == b.n_nodes;
}

std::size_t bytes_in_memory(const PoseGraphFragment& fragment) {
  return (sizeof(Pose2) + 2 * sizeof(double)) * fragment.poses.size() +
         sizeof(MapConstraint) * fragment.constraints.size();
}

std::optional<MapGraph> reassemble(const FragmentSet<PoseGraphFragment>& fragments) {
  const PoseGraphFragment& header = *fragments.fragments().front();
  MapGraph graph{header.utime, header.revision, {}, {}};
  for (const auto& part : fragments.fragments()) {
    if (!part->poses.empty() && part->first_node != static_cast<int>(graph.poses.size())) return {};
    graph.poses.insert(graph.poses.end(), part->poses.begin(), part->poses.end());
    graph.z_m.insert(graph.z_m.end(), part->z_m.begin(), part->z_m.end());
    graph.z_variance.insert(graph.z_variance.end(), part->z_variance.begin(),
                            part->z_variance.end());
    graph.constraints.insert(graph.constraints.end(), part->constraints.begin(),
                             part->constraints.end());
  }
  if (graph.poses.size() != static_cast<std::size_t>(header.n_nodes)) return std::nullopt;
  return graph;
}

map_correction_t to_message(const MapCorrection& correction) {
  map_correction_t message;
  message.utime = correction.utime;
  message.revision = correction.revision;
  message.session = correction.session;
  message.local_map = correction.local_map;
  set_pose(correction.T_map_odom, message.T_map_odom);
  message.z_map_odom_m = correction.z_map_odom_m;
  message.z_variance = correction.z_variance;
  set_matrix(correction.body_covariance, message.body_covariance);
  message.has_covariance = static_cast<std::int8_t>(correction.covariance.has_value());
  set_matrix(correction.covariance.value_or(Eigen::Matrix3d::Zero()), message.covariance);
  return message;
}

Result<MapCorrection> from_message(const map_correction_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  MapCorrection correction{message.utime,
                           message.revision,
                           message.session,
                           message.local_map,
                           pose_from(message.T_map_odom),
                           {},
                           message.z_map_odom_m,
                           message.z_variance,
                           matrix_from(message.body_covariance)};
  if (message.has_covariance == 0) return correction;
  correction.covariance = matrix_from(message.covariance);
  return correction;
}

map_request_t to_message(const MapRequest& request) {
  map_request_t message;
  message.utime = request.utime;
  message.requested_by = request.requested_by;
  return message;
}

Result<MapRequest> from_message(const map_request_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  return MapRequest{message.utime, message.requested_by};
}

}  // namespace adit
