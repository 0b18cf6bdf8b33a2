// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/local_map.hpp"

#include <string_view>

#include "common/messages/laser_scan.hpp"
#include "common/messages/pieces.hpp"
#include "common/messages/planar.hpp"

namespace adit {
namespace {

std::string_view reason_to_refuse_head(const local_map_t& message) {
  if (!is_plausible_utime(message.utime)) return kImplausibleTime;
  if (!is_plausible_utime(message.end_utime)) return kImplausibleTime;
  if (message.end_utime < message.utime) return "ends before it begins";
  if (message.id < 0 || message.session < 0) return "negative id or session";
  if (!all_finite(message.T_odom_local)) return kPoseNotFinite;
  if (!all_finite(message.T_previous_local)) return kPoseNotFinite;
  if (!is_information(message.information)) return kNoInformation;
  return {};
}

std::string_view reason_to_refuse_place(const local_map_t& message) {
  if (message.n_pieces < 1) return "no pieces";
  if (message.n_pieces > LocalMapPiece::kPiecesMax) return "more pieces than plausible";
  if (message.piece < 0 || message.piece >= message.n_pieces) return "piece of a higher number";
  if (message.getEncodedSize() > kPieceBytesMax) return "larger than a piece may be";
  return {};
}

local_scan_t to_message(const LocalScan& local) {
  local_scan_t message;
  message.utime = local.scan.utime;
  message.channel = local.channel;
  set_pose(local.T_local_body, message.T_local_body);
  message.angle_min_rad = local.scan.angle_min_rad;
  message.angle_step_rad = local.scan.angle_step_rad;
  message.nranges = static_cast<std::int32_t>(local.scan.ranges_m.size());
  message.ranges = local.scan.ranges_m;
  return message;
}

LocalScan scan_from(const local_scan_t& message) {
  return {message.channel,
          {message.utime, message.ranges, message.angle_min_rad, message.angle_step_rad},
          pose_from(message.T_local_body)};
}

std::string_view reason_to_refuse(const LocalScan& local, const LocalMap& map) {
  if (const auto reason = reason_to_refuse(local.scan); !reason.empty()) return reason;
  if (!local.T_local_body.vector().allFinite()) return kPoseNotFinite;
  if (local.scan.utime < map.utime || local.scan.utime > map.end_utime) {
    return "scan outside of the time of its local map";
  }
  return {};
}

}  // namespace

local_map_t to_message(const LocalMapPiece& piece) {
  const LocalMap& map = piece.part;
  local_map_t message;
  message.utime = map.utime;
  message.end_utime = map.end_utime;
  message.id = map.id;
  message.session = map.session;
  set_pose(map.T_odom_local, message.T_odom_local);
  set_pose(map.T_previous_local, message.T_previous_local);
  set_matrix(map.information, message.information);
  message.n_pieces = piece.n_pieces;
  message.piece = piece.piece;
  message.n_scans = static_cast<std::int32_t>(map.scans.size());
  for (const LocalScan& local : map.scans) message.scans.push_back(to_message(local));
  return message;
}

Result<LocalMapPiece> from_message(const local_map_t& message) {
  if (const auto reason = reason_to_refuse_head(message); !reason.empty()) return Refused{reason};
  if (const auto reason = reason_to_refuse_place(message); !reason.empty()) return Refused{reason};
  LocalMap map;
  map.id = message.id;
  map.session = message.session;
  map.utime = message.utime;
  map.end_utime = message.end_utime;
  map.T_odom_local = pose_from(message.T_odom_local);
  map.T_previous_local = pose_from(message.T_previous_local);
  map.information = matrix_from(message.information);
  map.scans.reserve(message.scans.size());
  for (const local_scan_t& scan : message.scans) {
    map.scans.push_back(scan_from(scan));
    const auto reason = reason_to_refuse(map.scans.back(), map);
    if (!reason.empty()) return Refused{reason};
  }
  return LocalMapPiece{std::move(map), message.n_pieces, message.piece};
}

}  // namespace adit
