// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/local_map_t.hpp"

#include "common/local_map/local_map.hpp"
#include "common/messages/result.hpp"

namespace adit {

/// A local map with a run of its scans, as it goes onto channel LOCAL_MAP; see
/// local_map_pieces.hpp.
struct LocalMapPiece {
  static constexpr int kPiecesMax = 1000;  ///< of a local map

  LocalMap part;  ///< complete but for its scans
  int n_pieces = 1;
  int piece = 0;  ///< 0 to n_pieces − 1

  friend bool operator==(const LocalMapPiece&, const LocalMapPiece&) = default;
};

/// Comes back with the same bits.
local_map_t to_message(const LocalMapPiece& piece);

/// Refused: implausible times, an end before the beginning, a negative id or session, a pose that
/// is not finite, an information matrix that is none, more pieces than plausible or a piece that is
/// not one of them, more bytes than a piece may have, and scans that could not come from a laser or
/// are outside of the time of the local map. Ranges are passed on as they are.
Result<LocalMapPiece> from_message(const local_map_t& message);

}  // namespace adit
