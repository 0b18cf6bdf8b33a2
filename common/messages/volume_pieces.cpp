// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/volume_pieces.hpp"

#include <algorithm>

namespace adit {
namespace {

constexpr std::size_t kHeadBytes = 128;  // on the wire
constexpr std::size_t kBytesOfPiece = kPieceBytes - kHeadBytes;

Volume head_of(const Volume& volume) {
  return {
      volume.utime,        volume.id,     volume.revision, volume.graph_revision, volume.local_map,
      volume.T_map_volume, volume.cell_m, volume.occupied, volume.free,           {}};
}

}  // namespace

std::vector<VolumePiece> divide(const Volume& volume) {
  const std::size_t n = volume.octree.size();
  const std::size_t n_pieces = std::max<std::size_t>(1, (n + kBytesOfPiece - 1) / kBytesOfPiece);
  std::vector<VolumePiece> pieces;
  for (std::size_t i = 0; i < n_pieces; ++i) {
    VolumePiece piece{head_of(volume), static_cast<int>(n_pieces), static_cast<int>(i)};
    const auto first = static_cast<std::ptrdiff_t>(i * kBytesOfPiece);
    const auto end = static_cast<std::ptrdiff_t>(std::min(n, (i + 1) * kBytesOfPiece));
    piece.part.octree.assign(volume.octree.begin() + first, volume.octree.begin() + end);
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

VolumePiece pose_only(const Volume& volume) { return {head_of(volume), 0, 0}; }

bool same_head(const VolumePiece& a, const VolumePiece& b) {
  return a.part.graph_revision == b.part.graph_revision && a.part.local_map == b.part.local_map &&
         a.part.T_map_volume == b.part.T_map_volume && a.part.cell_m == b.part.cell_m &&
         a.part.occupied == b.part.occupied && a.part.free == b.part.free;
}

std::size_t bytes_in_memory(const VolumePiece& piece) { return piece.part.octree.size(); }

std::optional<Volume> join(const PieceSet<VolumePiece>& pieces) {
  Volume volume = head_of(pieces.pieces().front()->part);
  for (const auto& piece : pieces.pieces()) {
    const auto& bytes = piece->part.octree;
    volume.octree.insert(volume.octree.end(), bytes.begin(), bytes.end());
  }
  const OctreeCounts counts = count_cells(volume.octree);
  if (!counts.refusal.empty() || counts.occupied != volume.occupied || counts.free != volume.free) {
    return std::nullopt;
  }
  return volume;
}

}  // namespace adit
