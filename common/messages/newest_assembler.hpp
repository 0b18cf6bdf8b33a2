// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "common/messages/pieces.hpp"

namespace adit {

/// Joins the pieces of things of which only the newest counts, in whatever order they come: of the
/// latest time, and of these of the highest id or revision. What it holds is bounded: one thing, of
/// as many bytes as the limit says.
///
/// A piece has `n_pieces` and `piece`. Beside it there are
///   auto age(const Piece&);                                // what is newer is greater
///   bool same_head(const Piece&, const Piece&);            // but for the number of the piece
///   std::size_t bytes_in_memory(const Piece&);
///   std::optional<Whole> join(const PieceSet<Piece>&);      // nothing where they do not fit
template <class Piece, std::size_t kDefaultBytesMax = 64'000'000>
class NewestAssembler {
 public:
  using Whole = typename decltype(join(std::declval<const PieceSet<Piece>&>()))::value_type;

  static constexpr std::size_t kBytesMax = kDefaultBytesMax;

  /// Since the start. All but `joined` is lost, to this receiver.
  struct Counts {
    std::int64_t joined = 0;         ///< things given back
    std::int64_t duplicates = 0;     ///< pieces that were there already
    std::int64_t contradictory = 0;  ///< pieces that do not go with those before them
    std::int64_t outdated = 0;       ///< pieces of an older thing
    std::int64_t superseded = 0;     ///< incomplete things for which a newer one came
    std::int64_t given_up = 0;       ///< things that took too much room, or do not fit together

    friend bool operator==(const Counts&, const Counts&) = default;
  };

  explicit NewestAssembler(std::size_t bytes_max = kBytesMax) : bytes_max_(bytes_max) {}

  /// What this piece completes, or nothing.
  std::optional<Whole> add(const Piece& piece) {
    if (!make_place_for(piece)) return std::nullopt;
    if (!waiting_->pieces.add(piece.piece, piece)) {
      ++counts_.duplicates;
      return std::nullopt;
    }
    waiting_->bytes += bytes_in_memory(piece);
    if (waiting_->bytes > bytes_max_) {
      ++counts_.given_up;
      waiting_.reset();
      return std::nullopt;
    }
    return waiting_->pieces.complete() ? finish() : std::nullopt;
  }

  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  struct Waiting {
    Piece first;  // of those that came, for its head
    PieceSet<Piece> pieces;
    std::size_t bytes = 0;
  };

  /// Whether the piece belongs to what is now waited for.
  bool make_place_for(const Piece& piece) {
    if (waiting_ && age(piece) < age(waiting_->first)) {
      ++counts_.outdated;
      return false;
    }
    if (waiting_ && age(piece) == age(waiting_->first)) {
      const bool same =
          piece.n_pieces == waiting_->first.n_pieces && same_head(piece, waiting_->first);
      if (!same) ++counts_.contradictory;
      return same;
    }
    if (waiting_) ++counts_.superseded;
    waiting_.emplace(Waiting{piece, PieceSet<Piece>(piece.n_pieces)});
    return true;
  }

  std::optional<Whole> finish() {
    std::optional<Whole> whole = join(waiting_->pieces);
    whole ? ++counts_.joined : ++counts_.given_up;
    waiting_.reset();
    return whole;
  }

  std::size_t bytes_max_;
  Counts counts_;
  std::optional<Waiting> waiting_;
};

}  // namespace adit
