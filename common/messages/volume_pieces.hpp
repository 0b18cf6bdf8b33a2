// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <tuple>
#include <vector>

#include "common/messages/newest_assembler.hpp"
#include "common/messages/volume.hpp"
#include "common/volume/octree_stream.hpp"

namespace adit {

/// Divides a sub-volume, always in the same way, into pieces of up to kPieceBytes.
std::vector<VolumePiece> divide(const Volume& volume);

/// What is sent where only its pose changed.
VolumePiece pose_only(const Volume& volume);
inline bool is_pose_only(const VolumePiece& piece) { return piece.n_pieces == 0; }

inline auto age(const VolumePiece& piece) {
  return std::tuple(piece.part.utime, piece.part.id, piece.part.revision);
}
bool same_head(const VolumePiece& a, const VolumePiece& b);
std::size_t bytes_in_memory(const VolumePiece& piece);
/// Nothing where the bytes are no octree, or not of as many cells as was said.
std::optional<Volume> join(const PieceSet<VolumePiece>& pieces);

/// For all pieces but those of a pose only.
using VolumeAssembler = NewestAssembler<VolumePiece, kOctreeBytesMax>;

}  // namespace adit
