// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <tuple>
#include <vector>

#include "adit/volume_t.hpp"

#include "common/messages/fragments.hpp"
#include "common/messages/result.hpp"
#include "common/volume/volume.hpp"

namespace adit {

/// A part of the octree of a sub-volume, on channel VOLUME.
struct VolumeFragment {
  static constexpr int kFragmentsMax = 100;  ///< fragments of a sub-volume

  Volume part;          ///< the complete header, and a part of the octree
  int n_fragments = 1;  ///< 0: pose update without an octree
  int fragment = 0;     ///< 0 to n_fragments − 1
};

volume_t to_message(const VolumeFragment& fragment);

/// Rejects an implausible time, a negative id or count, a revision without clouds, a pose or height
/// that is not finite, an implausible cell size, an implausible number of fragments or an index out
/// of range, a fragment that is too large, an octree in a pose-only message. The octree itself is
/// validated when its fragments are reassembled.
Result<VolumeFragment> from_message(const volume_t& message);

/// Splits a sub-volume deterministically into fragments of up to kFragmentBytes.
std::vector<VolumeFragment> split(const Volume& volume);

/// The message for a sub-volume whose pose alone changed.
VolumeFragment pose_only(const Volume& volume);
inline bool is_pose_only(const VolumeFragment& fragment) { return fragment.n_fragments == 0; }

inline int reassembly_id(const VolumeFragment& /*fragment*/) { return 0; }
inline auto recency(const VolumeFragment& fragment) {
  return std::tuple(fragment.part.utime, fragment.part.id, fragment.part.revision);
}
bool same_header(const VolumeFragment& a, const VolumeFragment& b);
std::size_t bytes_in_memory(const VolumeFragment& fragment);
/// Nothing if the bytes are not an octree or its cell counts differ from the header.
std::optional<Volume> reassemble(const FragmentSet<VolumeFragment>& fragments);

/// Holds the newest sub-volume only. Must not be given pose-only fragments.
using VolumeReassembler = Reassembler<VolumeFragment, ReassemblyLimits{.bytes = kOctreeBytesMax}>;

}  // namespace adit
