// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/volume/volume.hpp"

namespace adit {
namespace {

constexpr unsigned kFree = 1;
constexpr unsigned kMixed = 3;

class LeafReader {
 public:
  LeafReader(std::span<const std::uint8_t> bytes, const std::function<void(const CellRun&)>& visit)
      : bytes_(bytes), visit_(visit) {}

  std::string_view read() {
    const std::string_view reason = read_node(0, 0);
    if (reason.empty() && !bytes_.empty()) return "octree with trailing bytes";
    return reason;
  }

 private:
  std::string_view read_node(int depth, VoxelCode begin) {
    if (depth >= kVoxelDepth) return "octree deeper than the limit";
    if (bytes_.size() < 2) return "octree truncated";
    const unsigned states = bytes_[0] + 256U * bytes_[1];
    bytes_ = bytes_.subspan(2);
    if (states == 0) return "octree with an empty branch";
    const VoxelCode cells = cells_of_node(depth + 1);
    for (unsigned i = 0; i < 8; ++i) {
      const unsigned state = (states >> (2 * i)) % 4U;
      const VoxelCode first = begin + i * cells;
      if (state == kMixed) {
        const std::string_view reason = read_node(depth + 1, first);
        if (!reason.empty()) return reason;
      } else if (state != 0) {
        visit_({first, first + cells, state != kFree});
      }
    }
    return {};
  }

  std::span<const std::uint8_t> bytes_;  // not yet read
  const std::function<void(const CellRun&)>& visit_;
};

}  // namespace

std::string_view visit_leaves(std::span<const std::uint8_t> octree,
                              const std::function<void(const CellRun&)>& visit) {
  if (octree.empty()) return {};
  if (octree.size() > kOctreeBytesMax) return "octree larger than plausible";
  return LeafReader(octree, visit).read();
}

OctreeCounts count_cells(std::span<const std::uint8_t> octree) {
  OctreeCounts counts;
  counts.rejection = visit_leaves(octree, [&counts](const CellRun& leaf) {
    (leaf.occupied ? counts.occupied : counts.free) +=
        static_cast<std::int64_t>(leaf.end - leaf.first);
  });
  return counts;
}

}  // namespace adit
