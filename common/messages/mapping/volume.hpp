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

/// A sub-volume with a part of its octree, as it goes onto channel VOLUME; see volume_pieces.hpp.
struct VolumeFragment {
  static constexpr int kFragmentsMax = 100;  ///< of a sub-volume
  static constexpr double kCellMaxM = 10.0;

  Volume part;          ///< complete but for its octree, of which it has a part
  int n_fragments = 1;  ///< 0: only the pose is news, and there is no octree
  int fragment = 0;     ///< 0 to n_fragments − 1
};

volume_t to_message(const VolumeFragment& fragment);

/// Refused: an implausible time, a negative id or count, a revision without clouds, a pose that is
/// not finite, cells of no plausible size, more pieces than plausible or one that is not among
/// them, more bytes than a piece may have, an octree in a message of a pose only. Whether the
/// octree is one shows when its pieces are joined.
Result<VolumeFragment> from_message(const volume_t& message);

/// Divides a sub-volume, always in the same way, into pieces of up to kFragmentBytes.
std::vector<VolumeFragment> split(const Volume& volume);

/// What is sent where only its pose changed.
VolumeFragment pose_only(const Volume& volume);
inline bool is_pose_only(const VolumeFragment& fragment) { return fragment.n_fragments == 0; }

inline auto recency(const VolumeFragment& fragment) {
  return std::tuple(fragment.part.utime, fragment.part.id, fragment.part.revision);
}
bool same_header(const VolumeFragment& a, const VolumeFragment& b);
std::size_t bytes_in_memory(const VolumeFragment& fragment);
/// Nothing where the bytes are no octree, or not of as many cells as was said.
std::optional<Volume> reassemble(const FragmentSet<VolumeFragment>& fragments);

/// For all pieces but those of a pose only.
using VolumeReassembler = LatestReassembler<VolumeFragment, kOctreeBytesMax>;

}  // namespace adit
