// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/occupancy_tree.hpp"

#include <fstream>
#include <string>

#include <octomap/OcTree.h>

#include "common/files/file_error.hpp"

namespace adit {
namespace {

FileError cannot_write(const std::filesystem::path& path) {
  return FileError("cannot write " + path.string());
}

std::ofstream open(const std::filesystem::path& path) {
  std::ofstream file(path, std::ios::binary);
  if (!file) throw cannot_write(path);
  return file;
}

void finish(std::ofstream& file, const std::filesystem::path& path) {
  if (!file.flush()) throw cannot_write(path);
}

}  // namespace

/// OctoMap's tree with two further traversals: one updates many cells with one visit per node, the
/// other writes the binary stream.
class OccupancyTree::Tree : public octomap::OcTree {
 public:
  using octomap::OcTree::OcTree;
  using Node = octomap::OcTreeNode;

  void update_runs(std::span<const CellRun> runs) {
    if (runs.empty()) return;
    const bool is_new = root == nullptr;
    if (is_new) {
      root = new Node();  // deleted by OctoMap
      ++tree_size;
      size_changed = true;
    }
    const CellRun* run = runs.data();
    update_node(*root, is_new, 0, 0, run, runs.data() + runs.size());
  }

  std::vector<std::uint8_t> stream() const {
    std::vector<std::uint8_t> bytes;
    if (root != nullptr) append(*root, bytes);
    return bytes;
  }

 private:
  enum State : std::uint8_t { kUnknown = 0, kFree = 1, kOccupied = 2, kMixed = 3 };

  /// Updates the part of the runs within the node, whose first cell is `begin`. `run` is the first
  /// of these runs, and on return the first that extends beyond the node.
  void update_node(Node& node, bool is_new, int depth, VoxelCode begin, const CellRun*& run,
                   const CellRun* end) {
    const bool leaf = !nodeHasChildren(&node);
    const VoxelCode node_end = begin + cells_of_node(depth);
    if (leaf && run->first <= begin && run->end >= node_end) {
      updateNodeLogOdds(&node, run->occupied ? prob_hit_log : prob_miss_log);
      if (run->end == node_end) ++run;
      return;
    }
    if (leaf && !is_new) expandNode(&node);
    const VoxelCode cells = cells_of_node(depth + 1);
    for (unsigned i = 0; i < 8 && run != end; ++i) {
      const VoxelCode child_begin = begin + i * cells;
      if (run->first >= child_begin + cells) continue;
      const bool is_new_child = !nodeChildExists(&node, i);
      if (is_new_child) createNodeChild(&node, i);
      update_node(*getNodeChild(&node, i), is_new_child, depth + 1, child_begin, run, end);
    }
    if (!pruneNode(&node)) node.updateOccupancyChildren();
  }

  /// Writes the node and its children, and removes them again if all turn out to have the same
  /// state.
  State append(const Node& node, std::vector<std::uint8_t>& bytes) const {
    if (!nodeHasChildren(&node)) return isNodeOccupied(node) ? kOccupied : kFree;
    const std::size_t begin = bytes.size();
    bytes.resize(begin + 2);
    unsigned states = 0;
    for (unsigned i = 0; i < 8; ++i) {
      if (!nodeChildExists(&node, i)) continue;
      states |= static_cast<unsigned>(append(*getNodeChild(&node, i), bytes)) << (2 * i);
    }
    if (begin != 0 && (states == 0x5555U || states == 0xAAAAU)) {
      bytes.resize(begin);
      return states == 0x5555U ? kFree : kOccupied;
    }
    bytes[begin] = static_cast<std::uint8_t>(states);
    bytes[begin + 1] = static_cast<std::uint8_t>(states >> 8U);
    return kMixed;
  }
};

OccupancyTree::OccupancyTree(double cell_m) : tree_(std::make_unique<Tree>(cell_m)) {}
OccupancyTree::OccupancyTree(OccupancyTree&&) noexcept = default;
OccupancyTree& OccupancyTree::operator=(OccupancyTree&&) noexcept = default;
OccupancyTree::~OccupancyTree() = default;

void OccupancyTree::update(std::span<const CellRun> runs) { tree_->update_runs(runs); }

std::size_t OccupancyTree::nodes() const { return tree_->size(); }

std::vector<std::uint8_t> OccupancyTree::stream() const { return tree_->stream(); }

void OccupancyTree::write_ot(const std::filesystem::path& path) const {
  std::ofstream file = open(path);
  tree_->write(file);
  finish(file, path);
}

/// Writes the header of OctoMap itself, as OctoMap's writer prints to standard error.
void OccupancyTree::write_bt(const std::filesystem::path& path) const {
  std::ofstream file = open(path);
  Tree most_likely(*tree_);
  most_likely.toMaxLikelihood();
  most_likely.prune();
  file << "# Octomap OcTree binary file\nid OcTree\nsize " << most_likely.size() << "\nres "
       << most_likely.getResolution() << "\ndata\n";
  most_likely.writeBinaryData(file);
  finish(file, path);
}

}  // namespace adit
