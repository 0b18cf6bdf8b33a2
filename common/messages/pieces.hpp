// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace adit {

/// What a piece may take on the wire: then a message is one datagram, and nothing of it is lost for
/// the loss of another.
inline constexpr std::size_t kPieceBytes = 60'000;

/// What a piece may take that comes from outside: one item that is larger than a piece has one to
/// itself, and no plausible item is larger than this.
inline constexpr int kPieceBytesMax = 1'000'000;

/// The pieces of one thing, whatever the order in which they come.
template <class Piece>
class PieceSet {
 public:
  explicit PieceSet(int n_pieces) : pieces_(static_cast<std::size_t>(n_pieces)) {}

  /// False where it is there already.
  bool add(int number, Piece piece) {
    auto& place = pieces_.at(static_cast<std::size_t>(number));
    if (place) return false;
    place = std::move(piece);
    ++present_;
    return true;
  }

  [[nodiscard]] bool complete() const { return present_ == pieces_.size(); }
  [[nodiscard]] std::size_t size() const { return pieces_.size(); }

  /// In order; all are there once it is complete.
  [[nodiscard]] const std::vector<std::optional<Piece>>& pieces() const { return pieces_; }

 private:
  std::vector<std::optional<Piece>> pieces_;
  std::size_t present_ = 0;
};

}  // namespace adit
