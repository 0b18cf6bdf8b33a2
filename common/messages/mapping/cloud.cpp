// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mapping/cloud.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "common/messages/fields/mapping_fields.hpp"
#include "common/messages/fragments.hpp"
#include "common/messages/planar_geometry.hpp"

namespace adit {
namespace {

using Triples = std::vector<std::vector<float>>;  // as generated for float[n][3]

Triples triples(const std::vector<Eigen::Vector3f>& vectors) {
  Triples numbers;
  numbers.reserve(vectors.size());
  for (const Eigen::Vector3f& v : vectors) numbers.push_back({v.x(), v.y(), v.z()});
  return numbers;
}

std::vector<Eigen::Vector3f> vectors(const Triples& triples) {
  std::vector<Eigen::Vector3f> vectors;
  vectors.reserve(triples.size());
  for (const auto& numbers : triples) vectors.emplace_back(numbers[0], numbers[1], numbers[2]);
  return vectors;
}

cloud_line_t to_message(const CloudLine& line) {
  cloud_line_t message;
  message.utime = line.utime;
  std::copy_n(line.origin.data(), 3, message.origin);
  message.n_points = static_cast<std::int32_t>(line.points.size());
  message.points = triples(line.points);
  message.n_misses = static_cast<std::int32_t>(line.misses.size());
  message.misses = triples(line.misses);
  return message;
}

CloudLine line_from(const cloud_line_t& message) {
  return {message.utime, Eigen::Vector3f(message.origin), vectors(message.points),
          vectors(message.misses)};
}

bool is_direction(const Eigen::Vector3f& v) {
  constexpr float kTolerance = 1e-3F;
  return std::abs(v.norm() - 1.0F) < kTolerance;
}

std::string_view rejection_reason(const CloudLine& line, const Cloud& cloud) {
  if (line.utime > cloud.utime) return "line after the end of the sweep";
  if (!std::ranges::all_of(line.misses, is_direction)) return "miss direction is not a unit vector";
  return {};
}

std::string_view header_rejection_reason(const cloud_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return reason;
  return fragment_rejection_reason(message, CloudFragment::kFragmentsMax);
}

constexpr std::size_t kVectorBytes = 3 * sizeof(float);

Cloud header_of(const Cloud& cloud) {
  return {cloud.utime, cloud.id, cloud.T_odom_level, cloud.complete, {}, cloud.z_odom_m};
}

/// Encoded size: time, origin, both counts, points and misses.
std::size_t encoded_bytes(const CloudLine& line) {
  constexpr std::size_t kFixed = 8 + kVectorBytes + 4 + 4;
  return kFixed + kVectorBytes * (line.points.size() + line.misses.size());
}

}  // namespace

cloud_t to_message(const CloudFragment& fragment) {
  const Cloud& cloud = fragment.part;
  cloud_t message;
  message.utime = cloud.utime;
  message.id = cloud.id;
  set_pose(cloud.T_odom_level, message.T_odom_level);
  message.z_odom_m = cloud.z_odom_m;
  message.complete = static_cast<std::int8_t>(cloud.complete);
  message.n_fragments = fragment.n_fragments;
  message.fragment = fragment.fragment;
  message.n_lines = static_cast<std::int32_t>(cloud.lines.size());
  for (const CloudLine& line : cloud.lines) message.lines.push_back(to_message(line));
  return message;
}

Result<CloudFragment> from_message(const cloud_t& message) {
  if (const auto reason = header_rejection_reason(message); !reason.empty())
    return Rejected{reason};
  Cloud cloud{message.utime,         message.id, pose_from(message.T_odom_level),
              message.complete != 0, {},         message.z_odom_m};
  cloud.lines.reserve(message.lines.size());
  for (const cloud_line_t& line : message.lines) {
    cloud.lines.push_back(line_from(line));
    const auto reason = rejection_reason(cloud.lines.back(), cloud);
    if (!reason.empty()) return Rejected{reason};
  }
  return CloudFragment{std::move(cloud), message.n_fragments, message.fragment};
}

std::vector<CloudFragment> split(const Cloud& cloud) {
  const CloudFragment empty{header_of(cloud), 1, 0};
  const auto header_bytes = static_cast<std::size_t>(to_message(empty).getEncodedSize());
  std::vector<CloudFragment> fragments = {empty};
  std::size_t bytes = header_bytes;
  for (const CloudLine& line : cloud.lines) {
    if (bytes + encoded_bytes(line) > kFragmentBytes && !fragments.back().part.lines.empty()) {
      fragments.push_back(empty);
      bytes = header_bytes;
    }
    fragments.back().part.lines.push_back(line);
    bytes += encoded_bytes(line);
  }
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    fragments[i].n_fragments = static_cast<int>(fragments.size());
    fragments[i].fragment = static_cast<int>(i);
  }
  return fragments;
}

bool same_header(const CloudFragment& a, const CloudFragment& b) {
  return a.part.T_odom_level == b.part.T_odom_level && a.part.z_odom_m == b.part.z_odom_m &&
         a.part.complete == b.part.complete;
}

std::size_t bytes_in_memory(const CloudFragment& fragment) {
  std::size_t bytes = sizeof(CloudLine) * fragment.part.lines.size();
  for (const CloudLine& line : fragment.part.lines) {
    bytes += kVectorBytes * (line.points.size() + line.misses.size());
  }
  return bytes;
}

std::optional<Cloud> reassemble(const FragmentSet<CloudFragment>& fragments) {
  Cloud cloud = header_of(fragments.fragments().front()->part);
  for (const auto& fragment : fragments.fragments()) {
    cloud.lines.insert(cloud.lines.end(), fragment->part.lines.begin(), fragment->part.lines.end());
  }
  return cloud;
}

cloud_request_t to_message(const CloudRequest& request) {
  cloud_request_t message;
  message.utime = request.utime;
  message.after_utime = request.after_utime;
  message.n_received = static_cast<std::int32_t>(request.received_utime.size());
  message.received_utime = request.received_utime;
  return message;
}

Result<CloudRequest> from_message(const cloud_request_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  return CloudRequest{message.utime, message.after_utime, message.received_utime};
}

}  // namespace adit
