// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "common/cloud/cloud.hpp"
#include "common/messages/cloud.hpp"
#include "common/messages/newest_assembler.hpp"

namespace adit {

/// Divides a cloud, always in the same way: each piece but the last takes as many lines as fit
/// kPieceBytes; a line that is larger alone has a piece to itself.
std::vector<CloudPiece> divide(const Cloud& cloud);

inline auto age(const CloudPiece& piece) { return std::pair(piece.part.utime, piece.part.id); }
bool same_head(const CloudPiece& a, const CloudPiece& b);
std::size_t bytes_in_memory(const CloudPiece& piece);
std::optional<Cloud> join(const PieceSet<CloudPiece>& pieces);

using CloudAssembler = NewestAssembler<CloudPiece>;

}  // namespace adit
