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

/// A 3D scan with a run of its lines, as it goes onto channel CLOUD; see cloud_pieces.hpp.
struct CloudFragment {
  static constexpr int kFragmentsMax = 1000;           ///< of a cloud
  static constexpr float kCoordinateMaxM = 10'000.0F;  ///< to either side, of points and origins

  Cloud part;  ///< complete but for its lines
  int n_fragments = 1;
  int fragment = 0;  ///< 0 to n_fragments − 1
};

/// Comes back with the same bits.
cloud_t to_message(const CloudFragment& fragment);

/// Refused: an implausible time, a negative id, a pose that is not finite, more pieces than
/// plausible or a piece that is not one of them, more bytes than a piece may have, lines after the
/// end of the sweep, origins and points that are not finite or farther than plausible, misses whose
/// direction is no unit vector.
Result<CloudFragment> from_message(const cloud_t& message);

/// Divides a cloud, always in the same way: each piece but the last takes as many lines as fit
/// kFragmentBytes; a line that is larger alone has a piece to itself.
std::vector<CloudFragment> split(const Cloud& cloud);

inline auto recency(const CloudFragment& fragment) {
  return std::pair(fragment.part.utime, fragment.part.id);
}
bool same_header(const CloudFragment& a, const CloudFragment& b);
std::size_t bytes_in_memory(const CloudFragment& fragment);
std::optional<Cloud> reassemble(const FragmentSet<CloudFragment>& fragments);

using CloudReassembler = LatestReassembler<CloudFragment>;

cloud_request_t to_message(const CloudRequest& request);

/// Refused: an implausible time, also of a scan, no name, more scans than plausible.
Result<CloudRequest> from_message(const cloud_request_t& message);

}  // namespace adit
