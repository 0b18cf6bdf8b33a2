// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/cloud_t.hpp"

#include "common/cloud/cloud.hpp"
#include "common/messages/result.hpp"

namespace adit {

/// A 3D scan with a run of its lines, as it goes onto channel CLOUD; see cloud_pieces.hpp.
struct CloudPiece {
  static constexpr int kPiecesMax = 1000;              ///< of a cloud
  static constexpr float kCoordinateMaxM = 10'000.0F;  ///< to either side, of points and origins

  Cloud part;  ///< complete but for its lines
  int n_pieces = 1;
  int piece = 0;  ///< 0 to n_pieces − 1
};

/// Comes back with the same bits.
cloud_t to_message(const CloudPiece& piece);

/// Refused: an implausible time, a negative id, a pose that is not finite, more pieces than
/// plausible or a piece that is not one of them, more bytes than a piece may have, lines after the
/// end of the sweep, origins and points that are not finite or farther than plausible, misses whose
/// direction is no unit vector.
Result<CloudPiece> from_message(const cloud_t& message);

}  // namespace adit
