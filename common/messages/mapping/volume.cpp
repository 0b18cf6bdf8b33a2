// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mapping/volume.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "common/messages/fields/mapping_fields.hpp"
#include "common/messages/fragments.hpp"
#include "common/messages/planar_geometry.hpp"

namespace adit {
namespace {

std::string_view rejection_reason(const volume_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return reason;
  if (message.n_fragments > 0) {
    return fragment_rejection_reason(message, VolumeFragment::kFragmentsMax);
  }
  if (message.fragment != 0 || message.n_bytes != 0) return "octree in a pose-only message";
  return {};
}

}  // namespace

volume_t to_message(const VolumeFragment& fragment) {
  const Volume& volume = fragment.part;
  volume_t message;
  message.utime = volume.utime;
  message.id = volume.id;
  message.revision = volume.revision;
  message.graph_revision = volume.graph_revision;
  message.local_map = volume.local_map;
  set_pose(volume.T_map_volume, message.T_map_volume);
  message.z_map_m = volume.z_map_m;
  message.cell_m = volume.cell_m;
  message.occupied = volume.occupied;
  message.free = volume.free;
  message.n_fragments = fragment.n_fragments;
  message.fragment = fragment.fragment;
  message.n_bytes = static_cast<std::int32_t>(volume.octree.size());
  message.octree = volume.octree;
  return message;
}

Result<VolumeFragment> from_message(const volume_t& message) {
  if (const auto reason = rejection_reason(message); !reason.empty()) return Rejected{reason};
  Volume volume{message.utime,          message.id,        message.revision,
                message.graph_revision, message.local_map, pose_from(message.T_map_volume),
                message.cell_m,         message.occupied,  message.free,
                message.octree,         message.z_map_m};
  return VolumeFragment{std::move(volume), message.n_fragments, message.fragment};
}

namespace {

constexpr std::size_t kVolumeHeaderBytes = 128;  // encoded size
constexpr std::size_t kBytesPerFragment = kFragmentBytes - kVolumeHeaderBytes;

Volume header_of(const Volume& volume) {
  return {
      volume.utime,        volume.id,     volume.revision, volume.graph_revision, volume.local_map,
      volume.T_map_volume, volume.cell_m, volume.occupied, volume.free,           {},
      volume.z_map_m};
}

}  // namespace

std::vector<VolumeFragment> split(const Volume& volume) {
  const std::size_t n = volume.octree.size();
  const std::size_t n_fragments =
      std::max<std::size_t>(1, (n + kBytesPerFragment - 1) / kBytesPerFragment);
  std::vector<VolumeFragment> fragments;
  for (std::size_t i = 0; i < n_fragments; ++i) {
    VolumeFragment fragment{header_of(volume), static_cast<int>(n_fragments), static_cast<int>(i)};
    const auto first = static_cast<std::ptrdiff_t>(i * kBytesPerFragment);
    const auto end = static_cast<std::ptrdiff_t>(std::min(n, (i + 1) * kBytesPerFragment));
    fragment.part.octree.assign(volume.octree.begin() + first, volume.octree.begin() + end);
    fragments.push_back(std::move(fragment));
  }
  return fragments;
}

VolumeFragment pose_only(const Volume& volume) { return {header_of(volume), 0, 0}; }

bool same_header(const VolumeFragment& a, const VolumeFragment& b) {
  return a.part.graph_revision == b.part.graph_revision && a.part.local_map == b.part.local_map &&
         a.part.T_map_volume == b.part.T_map_volume && a.part.z_map_m == b.part.z_map_m &&
         a.part.cell_m == b.part.cell_m && a.part.occupied == b.part.occupied &&
         a.part.free == b.part.free;
}

std::size_t bytes_in_memory(const VolumeFragment& fragment) { return fragment.part.octree.size(); }

std::optional<Volume> reassemble(const FragmentSet<VolumeFragment>& fragments) {
  Volume volume = header_of(fragments.fragments().front()->part);
  for (const auto& fragment : fragments.fragments()) {
    const auto& bytes = fragment->part.octree;
    volume.octree.insert(volume.octree.end(), bytes.begin(), bytes.end());
  }
  const OctreeCounts counts = count_cells(volume.octree);
  if (!counts.rejection.empty() || counts.occupied != volume.occupied ||
      counts.free != volume.free) {
    return std::nullopt;
  }
  return volume;
}

}  // namespace adit
