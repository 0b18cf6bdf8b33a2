// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mapping/local_map.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "common/messages/fragments.hpp"
#include "common/messages/planar_geometry.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

std::string_view header_rejection_reason(const local_map_t& message) {
  if (!is_plausible_utime(message.utime)) return kImplausibleTime;
  if (!is_plausible_utime(message.end_utime)) return kImplausibleTime;
  if (message.end_utime < message.utime) return "ends before it begins";
  if (message.id < 0 || message.session < 0) return "negative id or session";
  if (!all_finite(message.T_odom_local)) return kPoseNotFinite;
  if (!all_finite(message.T_previous_local)) return kPoseNotFinite;
  if (!is_information_matrix(message.information)) return kInvalidInformation;
  return {};
}

std::string_view fragment_rejection_reason(const local_map_t& message) {
  if (message.n_fragments < 1) return "no pieces";
  if (message.n_fragments > LocalMapFragment::kFragmentsMax) return "more pieces than plausible";
  if (message.fragment < 0 || message.fragment >= message.n_fragments)
    return "piece of a higher number";
  if (message.getEncodedSize() > kFragmentBytesMax) return "larger than a piece may be";
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

std::string_view rejection_reason(const LocalScan& local, const LocalMap& map) {
  if (const auto reason = rejection_reason(local.scan); !reason.empty()) return reason;
  if (!local.T_local_body.vector().allFinite()) return kPoseNotFinite;
  if (local.scan.utime < map.utime || local.scan.utime > map.end_utime) {
    return "scan outside of the time of its local map";
  }
  return {};
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
  message.n_fragments = fragment.n_fragments;
  message.fragment = fragment.fragment;
  message.n_scans = static_cast<std::int32_t>(map.scans.size());
  for (const LocalScan& local : map.scans) message.scans.push_back(to_message(local));
  return message;
}

Result<LocalMapFragment> from_message(const local_map_t& message) {
  if (const auto reason = header_rejection_reason(message); !reason.empty())
    return Rejected{reason};
  if (const auto reason = fragment_rejection_reason(message); !reason.empty())
    return Rejected{reason};
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
    const auto reason = rejection_reason(map.scans.back(), map);
    if (!reason.empty()) return Rejected{reason};
  }
  return LocalMapFragment{std::move(map), message.n_fragments, message.fragment};
}

namespace {

LocalMap header_of(const LocalMap& map) {
  LocalMap header;
  header.id = map.id;
  header.session = map.session;
  header.utime = map.utime;
  header.end_utime = map.end_utime;
  header.T_odom_local = map.T_odom_local;
  header.T_previous_local = map.T_previous_local;
  header.information = map.information;
  return header;
}

/// On the wire: the length of the channel and its NUL, time, pose, bearings, count, ranges.
std::size_t encoded_bytes(const LocalScan& local) {
  constexpr std::size_t kFixed = 4 + 1 + 8 + 24 + 16 + 4;
  return kFixed + local.channel.size() + sizeof(float) * local.scan.ranges_m.size();
}

std::size_t bytes_in_memory(const std::vector<LocalScan>& scans) {
  std::size_t bytes = sizeof(LocalScan) * scans.size();
  for (const LocalScan& local : scans) {
    bytes += local.channel.size() + sizeof(float) * local.scan.ranges_m.size();
  }
  return bytes;
}

}  // namespace

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

std::optional<LocalMap> LocalMapReassembler::add(const LocalMapFragment& fragment) {
  ++fragments_received_;
  Incomplete* const entry = find_or_start(fragment);
  if (entry == nullptr) return std::nullopt;
  if (!entry->scans.add(fragment.fragment, fragment.part.scans)) {
    ++counts_.duplicates;
    return std::nullopt;
  }
  const std::size_t bytes = bytes_in_memory(fragment.part.scans);
  entry->bytes += bytes;
  bytes_ += bytes;
  entry->last_received = fragments_received_;
  if (entry->scans.complete()) return take(fragment.part.id);
  enforce_limits();
  return std::nullopt;
}

/// Where the piece belongs; null where it belongs nowhere.
LocalMapReassembler::Incomplete* LocalMapReassembler::find_or_start(
    const LocalMapFragment& fragment) {
  LocalMap header = header_of(fragment.part);
  const auto known = incomplete_.find(header.id);
  if (known != incomplete_.end()) {
    Incomplete& entry = known->second;
    if (header.end_utime < entry.header.end_utime) {
      ++counts_.outdated;
      return nullptr;
    }
    if (header.end_utime == entry.header.end_utime) {
      const bool same =
          header == entry.header && entry.scans.size() == std::size_t(fragment.n_fragments);
      if (!same) ++counts_.contradictory;
      return same ? &entry : nullptr;
    }
    ++counts_.superseded;
    erase(known);
  }
  const int id = header.id;
  Incomplete fresh{std::move(header), FragmentSet<std::vector<LocalScan>>(fragment.n_fragments)};
  return &incomplete_.emplace(id, std::move(fresh)).first->second;
}

LocalMap LocalMapReassembler::take(int id) {
  const auto entry = incomplete_.find(id);
  LocalMap map = entry->second.header;
  for (const auto& scans : entry->second.scans.fragments()) {
    map.scans.insert(map.scans.end(), scans->begin(), scans->end());
  }
  erase(entry);
  ++counts_.reassembled;
  return map;
}

void LocalMapReassembler::enforce_limits() {
  while (incomplete_.size() > limits_.incomplete || bytes_ > limits_.bytes) {
    const auto oldest =
        std::min_element(incomplete_.begin(), incomplete_.end(), [](const auto& a, const auto& b) {
          return a.second.last_received < b.second.last_received;
        });
    if (oldest == incomplete_.end()) return;
    ++counts_.abandoned;
    erase(oldest);
  }
}

void LocalMapReassembler::erase(std::map<int, Incomplete>::iterator entry) {
  bytes_ -= entry->second.bytes;
  incomplete_.erase(entry);
}

}  // namespace adit
