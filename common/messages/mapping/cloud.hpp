// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "adit/cloud_request_t.hpp"
#include "adit/cloud_t.hpp"

#include "common/messages/fragments.hpp"
#include "common/messages/result.hpp"
#include "common/types/cloud.hpp"

namespace adit {

/// A contiguous part of the lines of a 3D scan, on channels CLOUD and CLOUD_RESEND.
struct CloudFragment {
  static constexpr int kFragmentsMax = 1000;  ///< fragments of a cloud

  Cloud part;  ///< the complete header, and the lines of this fragment
  int n_fragments = 1;
  int fragment = 0;  ///< 0 to n_fragments − 1
};

/// Lossless: from_message restores the same bits.
cloud_t to_message(const CloudFragment& fragment);

/// Rejects an implausible time, a negative id, a pose or height that is not finite, an implausible
/// number of fragments or an index out of range, a fragment that is too large, lines after the end
/// of the sweep, origins and points that are not finite or implausibly far, miss directions that
/// are not unit vectors.
Result<CloudFragment> from_message(const cloud_t& message);

/// Splits a cloud deterministically: each fragment but the last holds as many lines as fit
/// kFragmentBytes; a line larger than that gets a fragment of its own.
std::vector<CloudFragment> split(const Cloud& cloud);

inline int reassembly_id(const CloudFragment& /*fragment*/) { return 0; }
inline auto recency(const CloudFragment& fragment) {
  return std::pair(fragment.part.utime, fragment.part.id);
}
bool same_header(const CloudFragment& a, const CloudFragment& b);
std::size_t bytes_in_memory(const CloudFragment& fragment);
std::optional<Cloud> reassemble(const FragmentSet<CloudFragment>& fragments);

/// Holds the newest cloud only.
using CloudReassembler = Reassembler<CloudFragment>;

cloud_request_t to_message(const CloudRequest& request);

/// Rejects an implausible time of the request or of a scan, and an implausible number of scans.
Result<CloudRequest> from_message(const cloud_request_t& message);

}  // namespace adit
