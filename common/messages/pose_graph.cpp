// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/pose_graph.hpp"

#include <algorithm>
#include <string_view>

#include "common/messages/pieces.hpp"
#include "common/messages/planar.hpp"

namespace adit {
namespace {

using Kind = MapConstraint::Kind;

static_assert(static_cast<int>(Kind::kSequential) == pose_constraint_t::KIND_SEQUENTIAL);
static_assert(static_cast<int>(Kind::kClosure) == pose_constraint_t::KIND_CLOSURE);

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

std::string_view reason_to_refuse_place(const pose_graph_t& message) {
  if (!is_plausible_utime(message.utime)) return kImplausibleTime;
  if (message.revision < 0) return "negative revision";
  if (message.n_nodes < 0) return "negative number of nodes";
  if (message.n_nodes > PoseGraphPiece::kNodesMax) return "more nodes than plausible";
  if (message.n_pieces < 1) return "no pieces";
  if (message.n_pieces > PoseGraphPiece::kPiecesMax) return "more pieces than plausible";
  if (message.piece < 0 || message.piece >= message.n_pieces) return "piece of a higher number";
  if (message.getEncodedSize() > kPieceBytesMax) return "larger than a piece may be";
  if (message.first_node < 0 || message.first_node > message.n_nodes - message.n_poses) {
    return "poses of nodes that are not in the graph";
  }
  return {};
}

std::string_view reason_to_refuse(const pose_constraint_t& message, std::int32_t n_nodes) {
  const auto is_node = [&](std::int32_t node) { return node >= 0 && node < n_nodes; };
  if (!is_node(message.from) || !is_node(message.to))
    return "constraint of a node that is not there";
  if (message.from == message.to) return "constraint of a node with itself";
  const auto kind = Kind(message.kind);
  if (kind != Kind::kSequential && kind != Kind::kClosure) return "constraint of an unknown kind";
  if (!all_finite(message.T_from_to)) return kPoseNotFinite;
  if (!is_information(message.information)) return kNoInformation;
  return {};
}

}  // namespace

pose_graph_t to_message(const PoseGraphPiece& piece) {
  pose_graph_t message;
  message.utime = piece.utime;
  message.revision = piece.revision;
  message.n_nodes = piece.n_nodes;
  message.n_pieces = piece.n_pieces;
  message.piece = piece.piece;
  message.first_node = piece.first_node;
  message.n_poses = static_cast<std::int32_t>(piece.poses.size());
  for (const Pose2& pose : piece.poses) message.poses.push_back({pose.x, pose.y, pose.theta});
  message.n_constraints = static_cast<std::int32_t>(piece.constraints.size());
  for (const MapConstraint& constraint : piece.constraints) {
    message.constraints.push_back(to_message(constraint));
  }
  return message;
}

Result<PoseGraphPiece> from_message(const pose_graph_t& message) {
  if (const auto reason = reason_to_refuse_place(message); !reason.empty()) return Refused{reason};
  PoseGraphPiece piece{message.utime,
                       message.revision,
                       message.n_nodes,
                       message.n_pieces,
                       message.piece,
                       message.first_node,
                       {},
                       {}};
  for (const auto& numbers : message.poses) {
    if (!all_finite(numbers)) return Refused{kPoseNotFinite};
    piece.poses.push_back({numbers[0], numbers[1], numbers[2]});
  }
  for (const pose_constraint_t& constraint : message.constraints) {
    const auto reason = reason_to_refuse(constraint, message.n_nodes);
    if (!reason.empty()) return Refused{reason};
    piece.constraints.push_back(constraint_from(constraint));
  }
  return piece;
}

}  // namespace adit
