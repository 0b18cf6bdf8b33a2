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

/// Occupancy octree with log-odds: octomap::OcTree with its default sensor model (Hornung et al.
/// 2013, OctoMap). The only class that uses OctoMap.
class OccupancyTree {
 public:
  explicit OccupancyTree(double cell_m);
  OccupancyTree(OccupancyTree&&) noexcept;
  OccupancyTree& operator=(OccupancyTree&&) noexcept;
  ~OccupancyTree();

  /// Updates each cell of the runs, which must be in order, with one measurement (Hornung et al.
  /// 2013, eq. 2). The result equals octomap::OcTree::updateNode for each cell, in any order.
  void update(std::span<const CellRun> runs);

  /// Number of nodes, inner ones included.
  [[nodiscard]] std::size_t nodes() const;

  /// The most likely state of each cell as an OctoMap binary stream, without the header of a file;
  /// see common/volume/volume.hpp. Empty if nothing is known.
  [[nodiscard]] std::vector<std::uint8_t> stream() const;

  /// Write files for octovis and other tools: all log-odds (.ot), or the most likely states (.bt).
  /// Throw std::runtime_error if the file cannot be written.
  void write_ot(const std::filesystem::path& path) const;
  void write_bt(const std::filesystem::path& path) const;

 private:
  class Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace adit
