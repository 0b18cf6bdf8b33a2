// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/cloud_pieces.hpp"

namespace adit {
namespace {

constexpr std::size_t kVectorBytes = 3 * sizeof(float);

Cloud head_of(const Cloud& cloud) {
  return {cloud.utime, cloud.id, cloud.T_odom_level, cloud.complete, {}};
}

/// On the wire: time, origin, both counts, points and misses.
std::size_t bytes_on_wire(const CloudLine& line) {
  constexpr std::size_t kFixed = 8 + kVectorBytes + 4 + 4;
  return kFixed + kVectorBytes * (line.points.size() + line.misses.size());
}

}  // namespace

std::vector<CloudPiece> divide(const Cloud& cloud) {
  const CloudPiece empty{head_of(cloud), 1, 0};
  const auto bytes_of_head = static_cast<std::size_t>(to_message(empty).getEncodedSize());
  std::vector<CloudPiece> pieces = {empty};
  std::size_t bytes = bytes_of_head;
  for (const CloudLine& line : cloud.lines) {
    if (bytes + bytes_on_wire(line) > kPieceBytes && !pieces.back().part.lines.empty()) {
      pieces.push_back(empty);
      bytes = bytes_of_head;
    }
    pieces.back().part.lines.push_back(line);
    bytes += bytes_on_wire(line);
  }
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    pieces[i].n_pieces = static_cast<int>(pieces.size());
    pieces[i].piece = static_cast<int>(i);
  }
  return pieces;
}

bool same_head(const CloudPiece& a, const CloudPiece& b) {
  return a.part.T_odom_level == b.part.T_odom_level && a.part.complete == b.part.complete;
}

std::size_t bytes_in_memory(const CloudPiece& piece) {
  std::size_t bytes = sizeof(CloudLine) * piece.part.lines.size();
  for (const CloudLine& line : piece.part.lines) {
    bytes += kVectorBytes * (line.points.size() + line.misses.size());
  }
  return bytes;
}

std::optional<Cloud> join(const PieceSet<CloudPiece>& pieces) {
  Cloud cloud = head_of(pieces.pieces().front()->part);
  for (const auto& piece : pieces.pieces()) {
    cloud.lines.insert(cloud.lines.end(), piece->part.lines.begin(), piece->part.lines.end());
  }
  return cloud;
}

}  // namespace adit
