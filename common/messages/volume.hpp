// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/volume_t.hpp"

#include "common/messages/result.hpp"
#include "common/volume/volume.hpp"

namespace adit {

/// A sub-volume with a part of its octree, as it goes onto channel VOLUME; see volume_pieces.hpp.
struct VolumePiece {
  static constexpr int kPiecesMax = 100;  ///< of a sub-volume
  static constexpr double kCellMaxM = 10.0;

  Volume part;       ///< complete but for its octree, of which it has a part
  int n_pieces = 1;  ///< 0: only the pose is news, and there is no octree
  int piece = 0;     ///< 0 to n_pieces − 1
};

volume_t to_message(const VolumePiece& piece);

/// Refused: an implausible time, a negative id or count, a revision without clouds, a pose that is
/// not finite, cells of no plausible size, more pieces than plausible or one that is not among
/// them, more bytes than a piece may have, an octree in a message of a pose only. Whether the
/// octree is one shows when its pieces are joined.
Result<VolumePiece> from_message(const volume_t& message);

}  // namespace adit
