// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mapping/local_map.hpp"

#include <string_view>
#include <utility>

#include "common/messages/fields/mapping_fields.hpp"
#include "common/messages/fragments.hpp"
#include "common/messages/planar_geometry.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

std::string_view header_rejection_reason(const local_map_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return reason;
  if (message.end_utime < message.utime) return "end time before start time";
  return fragment_rejection_reason(message, LocalMapFragment::kFragmentsMax);
}

local_scan_t to_message(const LocalScan& local) {
  local_scan_t message;
  message.utime = local.scan.utime;
  message.channel = local.channel;
  set_pose(local.T_local_body, message.T_local_body);
  message.z_m = local.z_m;
  set_attitude(local.attitude, local.attitude_from_ground, message);
  message.angle_min_rad = local.scan.angle_min_rad;
  message.angle_step_rad = local.scan.angle_step_rad;
  message.nranges = static_cast<std::int32_t>(local.scan.ranges_m.size());
  message.ranges = local.scan.ranges_m;
  message.n_unconfirmed_beams = static_cast<std::int32_t>(local.unconfirmed_beams.size());
  message.unconfirmed_beams.assign(local.unconfirmed_beams.begin(), local.unconfirmed_beams.end());
  return message;
}

LocalScan scan_from(const local_scan_t& message) {
  return {message.channel,
          {message.utime, message.ranges, message.angle_min_rad, message.angle_step_rad},
          pose_from(message.T_local_body),
          message.z_m,
          attitude_from(message),
          {message.unconfirmed_beams.begin(), message.unconfirmed_beams.end()},
          message.has_attitude == 0 && attitude_from(message).has_value()};
}

std::string_view rejection_reason(const LocalScan& local, const LocalMap& map) {
  if (const auto reason = rejection_reason(local.scan); !reason.empty()) return reason;
  if (local.scan.utime < map.utime || local.scan.utime > map.end_utime) {
    return "scan outside the time range of its local map";
  }
  return {};
}

LocalMap header_of(const LocalMap& map) {
  LocalMap header;
  header.id = map.id;
  header.session = map.session;
  header.utime = map.utime;
  header.end_utime = map.end_utime;
  header.T_odom_local = map.T_odom_local;
  header.T_previous_local = map.T_previous_local;
  header.information = map.information;
  header.climb_m = map.climb_m;
  header.forward_m = map.forward_m;
  header.z_odom_m = map.z_odom_m;
  return header;
}

/// Encoded size: length of the channel and its NUL, time, pose, height and attitude, bearings,
/// counts, ranges, beams.
std::size_t encoded_bytes(const LocalScan& local) {
  constexpr std::size_t kFixed = 4 + 1 + 8 + 24 + 25 + 16 + 4 + 4;
  return kFixed + local.channel.size() + sizeof(float) * local.scan.ranges_m.size() +
         sizeof(std::int16_t) * local.unconfirmed_beams.size();
}

}  // namespace

local_map_t to_message(const LocalMapFragment& fragment) {
  const LocalMap& map = fragment.part;
  local_map_t message;
  message.utime = map.utime;
  message.end_utime = map.end_utime;
  message.id = map.id;
  message.session = map.session;
  set_pose(map.T_odom_local, message.T_odom_local);
  set_pose(map.T_previous_local, message.T_previous_local);
  set_matrix(map.information, message.information);
  message.climb_m = map.climb_m;
  message.forward_m = map.forward_m;
  message.z_odom_m = map.z_odom_m;
  message.n_fragments = fragment.n_fragments;
  message.fragment = fragment.fragment;
  message.n_scans = static_cast<std::int32_t>(map.scans.size());
  for (const LocalScan& local : map.scans) message.scans.push_back(to_message(local));
  return message;
}

Result<LocalMapFragment> from_message(const local_map_t& message) {
  if (const auto reason = header_rejection_reason(message); !reason.empty())
    return Rejected{reason};
  LocalMap map;
  map.id = message.id;
  map.session = message.session;
  map.utime = message.utime;
  map.end_utime = message.end_utime;
  map.T_odom_local = pose_from(message.T_odom_local);
  map.T_previous_local = pose_from(message.T_previous_local);
  map.information = matrix_from(message.information);
  map.climb_m = message.climb_m;
  map.forward_m = message.forward_m;
  map.z_odom_m = message.z_odom_m;
  map.scans.reserve(message.scans.size());
  for (const local_scan_t& scan : message.scans) {
    map.scans.push_back(scan_from(scan));
    const auto reason = rejection_reason(map.scans.back(), map);
    if (!reason.empty()) return Rejected{reason};
  }
  return LocalMapFragment{std::move(map), message.n_fragments, message.fragment};
}

std::vector<LocalMapFragment> split(const LocalMap& map) {
  const LocalMapFragment empty{header_of(map), 1, 0};
  const auto header_bytes = static_cast<std::size_t>(to_message(empty).getEncodedSize());
  std::vector<LocalMapFragment> fragments = {empty};
  std::size_t bytes = header_bytes;
  for (const LocalScan& local : map.scans) {
    if (bytes + encoded_bytes(local) > kFragmentBytes && !fragments.back().part.scans.empty()) {
      fragments.push_back(empty);
      bytes = header_bytes;
    }
    fragments.back().part.scans.push_back(local);
    bytes += encoded_bytes(local);
  }
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    fragments[i].n_fragments = static_cast<int>(fragments.size());
    fragments[i].fragment = static_cast<int>(i);
  }
  return fragments;
}

bool same_header(const LocalMapFragment& a, const LocalMapFragment& b) {
  return header_of(a.part) == header_of(b.part);
}

std::size_t bytes_in_memory(const LocalMapFragment& fragment) {
  std::size_t bytes = sizeof(LocalScan) * fragment.part.scans.size();
  for (const LocalScan& local : fragment.part.scans) {
    bytes += local.channel.size() + sizeof(float) * local.scan.ranges_m.size();
  }
  return bytes;
}

std::optional<LocalMap> reassemble(const FragmentSet<LocalMapFragment>& fragments) {
  LocalMap map = header_of(fragments.fragments().front()->part);
  for (const auto& fragment : fragments.fragments()) {
    map.scans.insert(map.scans.end(), fragment->part.scans.begin(), fragment->part.scans.end());
  }
  return map;
}

}  // namespace adit
