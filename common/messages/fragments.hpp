// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace adit {

/// What a piece may take on the wire: then a message is one datagram, and nothing of it is lost for
/// the loss of another.
inline constexpr std::size_t kFragmentBytes = 60'000;

/// What a piece may take that comes from outside: one item that is larger than a piece has one to
/// itself, and no plausible item is larger than this.
inline constexpr int kFragmentBytesMax = 1'000'000;

/// The pieces of one thing, whatever the order in which they come.
template <class Fragment>
class FragmentSet {
 public:
  explicit FragmentSet(int n_fragments) : fragments_(static_cast<std::size_t>(n_fragments)) {}

  /// False where it is there already.
  bool add(int number, Fragment fragment) {
    auto& place = fragments_.at(static_cast<std::size_t>(number));
    if (place) return false;
    place = std::move(fragment);
    ++present_;
    return true;
  }

  [[nodiscard]] bool complete() const { return present_ == fragments_.size(); }
  [[nodiscard]] std::size_t size() const { return fragments_.size(); }

  /// In order; all are there once it is complete.
  [[nodiscard]] const std::vector<std::optional<Fragment>>& fragments() const { return fragments_; }

 private:
  std::vector<std::optional<Fragment>> fragments_;
  std::size_t present_ = 0;
};

/// Joins the pieces of things of which only the newest counts, in whatever order they come: of the
/// latest time, and of these of the highest id or revision. What it holds is bounded: one thing, of
/// as many bytes as the limit says.
///
/// A piece has `n_fragments` and `piece`. Beside it there are
///   auto age(const Piece&);                                // what is newer is greater
///   bool same_header(const Piece&, const Piece&);            // but for the number of the piece
///   std::size_t bytes_in_memory(const Piece&);
///   std::optional<Whole> join(const FragmentSet<Piece>&);      // nothing where they do not fit
template <class Fragment, std::size_t kDefaultBytesMax = 64'000'000>
class LatestReassembler {
 public:
  using Complete =
      typename decltype(reassemble(std::declval<const FragmentSet<Fragment>&>()))::value_type;

  static constexpr std::size_t kBytesMax = kDefaultBytesMax;

  /// Since the start. All but `joined` is lost, to this receiver.
  struct Counts {
    std::int64_t reassembled = 0;    ///< things given back
    std::int64_t duplicates = 0;     ///< pieces that were there already
    std::int64_t contradictory = 0;  ///< pieces that do not go with those before them
    std::int64_t outdated = 0;       ///< pieces of an older thing
    std::int64_t superseded = 0;     ///< incomplete things for which a newer one came
    std::int64_t abandoned = 0;      ///< things that took too much room, or do not fit together

    friend bool operator==(const Counts&, const Counts&) = default;
  };

  explicit LatestReassembler(std::size_t bytes_max = kBytesMax) : bytes_max_(bytes_max) {}

  /// What this piece completes, or nothing.
  std::optional<Complete> add(const Fragment& fragment) {
    if (!accepts(fragment)) return std::nullopt;
    if (!incomplete_->fragments.add(fragment.fragment, fragment)) {
      ++counts_.duplicates;
      return std::nullopt;
    }
    incomplete_->bytes += bytes_in_memory(fragment);
    if (incomplete_->bytes > bytes_max_) {
      ++counts_.abandoned;
      incomplete_.reset();
      return std::nullopt;
    }
    return incomplete_->fragments.complete() ? finish() : std::nullopt;
  }

  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  struct Incomplete {
    Fragment first;  // of those that came, for its head
    FragmentSet<Fragment> fragments;
    std::size_t bytes = 0;
  };

  /// Whether the piece belongs to what is now waited for.
  bool accepts(const Fragment& fragment) {
    if (incomplete_ && recency(fragment) < recency(incomplete_->first)) {
      ++counts_.outdated;
      return false;
    }
    if (incomplete_ && recency(fragment) == recency(incomplete_->first)) {
      const bool same = fragment.n_fragments == incomplete_->first.n_fragments &&
                        same_header(fragment, incomplete_->first);
      if (!same) ++counts_.contradictory;
      return same;
    }
    if (incomplete_) ++counts_.superseded;
    incomplete_.emplace(Incomplete{fragment, FragmentSet<Fragment>(fragment.n_fragments)});
    return true;
  }

  std::optional<Complete> finish() {
    std::optional<Complete> complete_value = reassemble(incomplete_->fragments);
    complete_value ? ++counts_.reassembled : ++counts_.abandoned;
    incomplete_.reset();
    return complete_value;
  }

  std::size_t bytes_max_;
  Counts counts_;
  std::optional<Incomplete> incomplete_;
};

}  // namespace adit
