// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "common/volume/volume.hpp"

namespace adit {

/// What is free and what is occupied, with log-odds: octomap::OcTree with its default model of a
/// sensor, and the one place that knows OctoMap.
class OccupancyTree {
 public:
  explicit OccupancyTree(double cell_m);
  OccupancyTree(OccupancyTree&&) noexcept;
  OccupancyTree& operator=(OccupancyTree&&) noexcept;
  ~OccupancyTree();

  /// One measurement of each cell of the runs, which are in order. The tree is then what
  /// octomap::OcTree::updateNode makes of the cells one by one, in whatever order.
  void update(std::span<const CellRun> runs);

  /// Of the tree, inner ones too.
  [[nodiscard]] std::size_t nodes() const;

  /// The most likely state of each cell as OctoMap's binary stream, without the head of a file;
  /// see common/volume/octree_stream.hpp. Empty where nothing is known.
  [[nodiscard]] std::vector<std::uint8_t> stream() const;

  /// Files for octovis and others: all log-odds (.ot), or the most likely states (.bt). Throw
  /// std::runtime_error where the file cannot be written.
  void write_ot(const std::filesystem::path& path) const;
  void write_bt(const std::filesystem::path& path) const;

 private:
  class Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace adit
