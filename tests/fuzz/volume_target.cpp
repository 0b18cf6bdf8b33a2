// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>
#include <iostream>
#include <sstream>

#include <octomap/OcTree.h>

#include "common/volume/octree_stream.hpp"
#include "procs/volume_map/occupancy_tree.hpp"
#include "tests/fuzz/target.hpp"

namespace adit::fuzz {
namespace {

/// Stretches of free and occupied cells, of all lengths.
Bytes sample_octree() {
  std::vector<CellRun> runs;
  VoxelCode begin = VoxelGrid::code_of({32768, 32700, 32760});
  for (unsigned i = 0; i < 40; ++i) {
    const VoxelCode end = begin + (VoxelCode{1} << (i % 11)) + i % 3;
    runs.push_back({begin, end, i % 4 == 0});
    begin = end + 5 * i;
  }
  OccupancyTree tree(0.1);
  tree.update(runs);
  return tree.stream();
}

/// What passes our check OctoMap must read to the end, and find in it as many leaves.
std::string_view take_octree(std::span<const std::uint8_t> bytes) {
  std::size_t leaves = 0;
  const auto reason = visit_leaves(bytes, [&leaves](const CellRun&) { ++leaves; });
  if (!reason.empty() || bytes.empty()) return reason;
  octomap::OcTree tree(0.1);
  std::istringstream in(std::string(bytes.begin(), bytes.end()));
  tree.readBinaryData(in);
  if (!in || in.peek() != std::istringstream::traits_type::eof() ||
      tree.getNumLeafNodes() != leaves) {
    std::cerr << "OctoMap reads another octree than we checked\n";
    std::abort();
  }
  return {};
}

}  // namespace

Target octree_target() { return {"octree", {sample_octree()}, take_octree}; }

}  // namespace adit::fuzz
