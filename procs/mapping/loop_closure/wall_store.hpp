// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <list>
#include <memory>
#include <optional>
#include <vector>

#include "common/files/spool_file.hpp"
#include "procs/mapping/loop_closure/local_walls.hpp"

namespace adit {

/// The walls of all local maps, by their ids. They may be in a temporary file: memory then has
/// those that were used last, and the traversed paths of all.
class WallStore {
 public:
  static constexpr std::size_t kBytesInMemory = std::size_t{48} << 20U;

  /// The walls are in a file in `folder`, and about `bytes_in_memory` of them in memory; if it is
  /// empty, all are in memory.
  explicit WallStore(const std::filesystem::path& folder = {},
                     std::size_t bytes_in_memory = kBytesInMemory);

  /// Throws FileError, as does reading.
  void push_back(LocalWalls walls);
  void pop_back();
  [[nodiscard]] std::size_t size() const { return entries_.size(); }

  /// One object per local map while somebody holds it.
  [[nodiscard]] std::shared_ptr<const LocalWalls> operator[](std::size_t i) const;
  [[nodiscard]] std::shared_ptr<const LocalWalls> back() const { return (*this)[size() - 1]; }
  /// LocalWalls::path; valid until the map is removed.
  [[nodiscard]] const std::vector<TraversedPoint>& path(std::size_t i) const {
    return *entries_[i].path;
  }

 private:
  using Walls = std::shared_ptr<const LocalWalls>;

  struct Entry {
    std::shared_ptr<const std::vector<TraversedPoint>> path;
    std::uint64_t offset = 0;  ///< in the file
    mutable std::weak_ptr<const LocalWalls> held;
    mutable std::optional<std::list<std::size_t>::iterator> used;  ///< place in `used_`
    mutable Walls kept;
  };

  [[nodiscard]] Walls read(std::size_t i) const;
  void keep(std::size_t i, Walls walls) const;
  void drop(std::size_t i) const;

  std::vector<Entry> entries_;
  std::optional<SpoolFile> file_;  ///< empty: all are kept
  std::size_t bytes_in_memory_;
  mutable std::size_t bytes_kept_ = 0;
  mutable std::list<std::size_t> used_;  ///< those kept, the last used first
};

}  // namespace adit
