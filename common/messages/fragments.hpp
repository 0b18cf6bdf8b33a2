// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace adit {

/// Size limit for the fragments that `split` makes: one datagram, so that the loss of another
/// datagram does not affect a fragment.
inline constexpr std::size_t kFragmentBytes = 60'000;

/// Size limit for received fragments. A single item larger than kFragmentBytes gets a fragment of
/// its own; no plausible item exceeds this.
inline constexpr int kFragmentBytesMax = 1'000'000;

/// Why the fields n_fragments and fragment or the size of a message are invalid, or nothing.
template <class Msg>
std::string_view fragment_rejection_reason(const Msg& message, int fragments_max) {
  if (message.n_fragments < 1) return "no fragments";
  if (message.n_fragments > fragments_max) return "implausible number of fragments";
  if (message.fragment < 0 || message.fragment >= message.n_fragments) {
    return "fragment index out of range";
  }
  if (message.getEncodedSize() > kFragmentBytesMax) return "fragment too large";
  return {};
}

/// The fragments of one object, added in any order.
template <class Fragment>
class FragmentSet {
 public:
  explicit FragmentSet(int n_fragments) : fragments_(static_cast<std::size_t>(n_fragments)) {}

  /// Returns false for a duplicate.
  bool add(int index, Fragment fragment) {
    auto& place = fragments_.at(static_cast<std::size_t>(index));
    if (place) return false;
    place = std::move(fragment);
    ++present_;
    return true;
  }

  [[nodiscard]] bool complete() const { return present_ == fragments_.size(); }

  /// In order; every entry has a value once the set is complete.
  [[nodiscard]] const std::vector<std::optional<Fragment>>& fragments() const { return fragments_; }

 private:
  std::vector<std::optional<Fragment>> fragments_;
  std::size_t present_ = 0;
};

/// Bounds on the incomplete objects that a reassembler holds.
struct ReassemblyLimits {
  std::size_t incomplete = 1;      ///< number of objects
  std::size_t bytes = 64'000'000;  ///< of all their fragments in memory
};

/// Counts since the start. All but `reassembled` are losses to the receiver.
struct ReassemblyCounts {
  std::int64_t reassembled = 0;    ///< objects returned
  std::int64_t duplicates = 0;     ///< fragments received twice
  std::int64_t contradictory = 0;  ///< fragments whose header differs from that of the first
  std::int64_t outdated = 0;       ///< fragments of an older revision
  std::int64_t superseded = 0;     ///< incomplete objects replaced by a newer revision
  std::int64_t abandoned = 0;      ///< objects that exceed the limits or are inconsistent

  friend bool operator==(const ReassemblyCounts&, const ReassemblyCounts&) = default;
};

/// Reassembles objects from fragments that arrive in any order. Of each id it holds the newest
/// revision only. Memory is bounded: beyond the limits, the object whose last fragment arrived
/// longest ago is abandoned.
///
/// A fragment has `n_fragments` and `fragment`, its index. Functions for each type of fragment:
/// - `int reassembly_id(const Fragment&)`: constant where only the newest object counts;
/// - `auto recency(const Fragment&)`: greater for a newer revision of the id;
/// - `bool same_header(const Fragment&, const Fragment&)`: but for the index;
/// - `std::size_t bytes_in_memory(const Fragment&)`;
/// - `std::optional<Object> reassemble(const FragmentSet<Fragment>&)`: nothing if inconsistent.
template <class Fragment, ReassemblyLimits kDefaultLimits = ReassemblyLimits{}>
class Reassembler {
 public:
  using Object =
      typename decltype(reassemble(std::declval<const FragmentSet<Fragment>&>()))::value_type;
  using Counts = ReassemblyCounts;

  explicit Reassembler(const ReassemblyLimits& limits = kDefaultLimits) : limits_(limits) {}

  /// The object that this fragment completes, or nothing.
  std::optional<Object> add(const Fragment& fragment) {
    ++fragments_received_;
    const auto found = find_or_start(fragment);
    if (found == incomplete_.end()) return std::nullopt;
    Incomplete& object = found->second;
    if (!object.fragments.add(fragment.fragment, fragment)) {
      ++counts_.duplicates;
      return std::nullopt;
    }
    const std::size_t bytes = bytes_in_memory(fragment);
    object.bytes += bytes;
    bytes_ += bytes;
    object.last_received = fragments_received_;
    if (object.fragments.complete() && object.bytes <= limits_.bytes) return finish(found);
    enforce_limits();
    return std::nullopt;
  }

  [[nodiscard]] const Counts& counts() const { return counts_; }
  /// Number of objects with missing fragments.
  [[nodiscard]] std::size_t incomplete() const { return incomplete_.size(); }

 private:
  struct Incomplete {
    Fragment first;  // received first; the header for comparison
    FragmentSet<Fragment> fragments;
    std::size_t bytes = 0;
    std::int64_t last_received = 0;  // sequence number of the last fragment
  };
  using Objects = std::map<int, Incomplete>;  // by id

  /// The object to which the fragment belongs; end() if the fragment is rejected.
  typename Objects::iterator find_or_start(const Fragment& fragment) {
    const int id = reassembly_id(fragment);
    const auto found = incomplete_.find(id);
    if (found != incomplete_.end()) {
      const Fragment& first = found->second.first;
      if (recency(fragment) < recency(first)) {
        ++counts_.outdated;
        return incomplete_.end();
      }
      if (recency(fragment) == recency(first)) {
        const bool same = fragment.n_fragments == first.n_fragments && same_header(fragment, first);
        if (!same) ++counts_.contradictory;
        return same ? found : incomplete_.end();
      }
      ++counts_.superseded;
      erase(found);
    }
    Incomplete object{fragment, FragmentSet<Fragment>(fragment.n_fragments)};
    return incomplete_.emplace(id, std::move(object)).first;
  }

  std::optional<Object> finish(typename Objects::iterator found) {
    std::optional<Object> object = reassemble(found->second.fragments);
    object ? ++counts_.reassembled : ++counts_.abandoned;
    erase(found);
    return object;
  }

  void enforce_limits() {
    while (incomplete_.size() > limits_.incomplete || bytes_ > limits_.bytes) {
      const auto oldest = std::min_element(incomplete_.begin(), incomplete_.end(),
                                           [](const auto& a, const auto& b) {
                                             return a.second.last_received < b.second.last_received;
                                           });
      if (oldest == incomplete_.end()) return;
      ++counts_.abandoned;
      erase(oldest);
    }
  }

  void erase(typename Objects::iterator found) {
    bytes_ -= found->second.bytes;
    incomplete_.erase(found);
  }

  ReassemblyLimits limits_;
  Counts counts_;
  Objects incomplete_;
  std::size_t bytes_ = 0;
  std::int64_t fragments_received_ = 0;
};

}  // namespace adit
