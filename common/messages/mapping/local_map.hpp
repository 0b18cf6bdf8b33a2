// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "adit/local_map_t.hpp"

#include "common/messages/fragments.hpp"
#include "common/messages/result.hpp"
#include "common/types/local_map.hpp"

namespace adit {

/// A contiguous part of the scans of a local map, on channel LOCAL_MAP.
struct LocalMapFragment {
  static constexpr int kFragmentsMax = 1000;  ///< fragments of a local map

  LocalMap part;  ///< the complete header, and the scans of this fragment
  int n_fragments = 1;
  int fragment = 0;  ///< 0 to n_fragments − 1

  friend bool operator==(const LocalMapFragment&, const LocalMapFragment&) = default;
};

/// Lossless: from_message restores the same bits.
local_map_t to_message(const LocalMapFragment& fragment);

/// Rejects implausible times, an end before the start, a negative id or session, a pose that is not
/// finite, an invalid information matrix, an implausible number of fragments or an index out of
/// range, a fragment that is too large, and scans that are invalid or outside the time range of the
/// local map. Ranges are not checked.
Result<LocalMapFragment> from_message(const local_map_t& message);

/// Splits a local map deterministically: each fragment but the last holds as many scans as fit
/// kFragmentBytes; a scan larger than that gets a fragment of its own.
std::vector<LocalMapFragment> split(const LocalMap& map);

inline int reassembly_id(const LocalMapFragment& fragment) { return fragment.part.id; }
/// The revision of an id with the latest end is the newest.
inline auto recency(const LocalMapFragment& fragment) { return fragment.part.end_utime; }
bool same_header(const LocalMapFragment& a, const LocalMapFragment& b);
std::size_t bytes_in_memory(const LocalMapFragment& fragment);
std::optional<LocalMap> reassemble(const FragmentSet<LocalMapFragment>& fragments);

using LocalMapReassembler =
    Reassembler<LocalMapFragment, ReassemblyLimits{.incomplete = 8, .bytes = 64'000'000}>;

}  // namespace adit
