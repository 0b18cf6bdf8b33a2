// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/cloud.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "common/messages/pieces.hpp"
#include "common/messages/planar.hpp"

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

/// NaN is not.
bool is_plausible(const Eigen::Vector3f& p_level) {
  return p_level.allFinite() && p_level.cwiseAbs().maxCoeff() <= CloudPiece::kCoordinateMaxM;
}

bool is_direction(const Eigen::Vector3f& v) {
  constexpr float kTolerance = 1e-3F;
  return std::abs(v.norm() - 1.0F) < kTolerance;
}

std::string_view reason_to_refuse(const CloudLine& line, const Cloud& cloud) {
  if (!is_plausible_utime(line.utime)) return kImplausibleTime;
  if (line.utime > cloud.utime) return "line after the end of the sweep";
  if (!is_plausible(line.origin)) return "origin that cannot be";
  if (!std::ranges::all_of(line.points, is_plausible)) return "point that cannot be";
  if (!std::ranges::all_of(line.misses, is_direction)) return "miss without a direction";
  return {};
}

std::string_view reason_to_refuse_head(const cloud_t& message) {
  if (!is_plausible_utime(message.utime)) return kImplausibleTime;
  if (message.id < 0) return "negative id";
  if (!all_finite(message.T_odom_level)) return kPoseNotFinite;
  if (message.n_pieces < 1) return "no pieces";
  if (message.n_pieces > CloudPiece::kPiecesMax) return "more pieces than plausible";
  if (message.piece < 0 || message.piece >= message.n_pieces) return "piece of a higher number";
  if (message.getEncodedSize() > kPieceBytesMax) return "larger than a piece may be";
  return {};
}

}  // namespace

cloud_t to_message(const CloudPiece& piece) {
  const Cloud& cloud = piece.part;
  cloud_t message;
  message.utime = cloud.utime;
  message.id = cloud.id;
  set_pose(cloud.T_odom_level, message.T_odom_level);
  message.complete = static_cast<std::int8_t>(cloud.complete);
  message.n_pieces = piece.n_pieces;
  message.piece = piece.piece;
  message.n_lines = static_cast<std::int32_t>(cloud.lines.size());
  for (const CloudLine& line : cloud.lines) message.lines.push_back(to_message(line));
  return message;
}

Result<CloudPiece> from_message(const cloud_t& message) {
  if (const auto reason = reason_to_refuse_head(message); !reason.empty()) return Refused{reason};
  Cloud cloud{
      message.utime, message.id, pose_from(message.T_odom_level), message.complete != 0, {}};
  cloud.lines.reserve(message.lines.size());
  for (const cloud_line_t& line : message.lines) {
    cloud.lines.push_back(line_from(line));
    const auto reason = reason_to_refuse(cloud.lines.back(), cloud);
    if (!reason.empty()) return Refused{reason};
  }
  return CloudPiece{std::move(cloud), message.n_pieces, message.piece};
}

}  // namespace adit
