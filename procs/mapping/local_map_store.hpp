// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "common/files/spool_file.hpp"
#include "common/types/local_map.hpp"

namespace adit {

/// Finished local maps, by their ids. Their scans, which are rarely needed again, may be in a
/// temporary file: memory then grows by less than a kilobyte per local map.
class LocalMapStore {
 public:
  /// The scans are in a file in `folder`; if it is empty, in memory.
  explicit LocalMapStore(const std::filesystem::path& folder = {});

  /// Throws FileError, as does `load`.
  void push_back(LocalMap map);
  void pop_back();

  [[nodiscard]] std::size_t size() const { return maps_.size(); }
  [[nodiscard]] bool empty() const { return maps_.empty(); }

  /// A local map of which at least the last scan is there, without its ranges.
  [[nodiscard]] const LocalMap& operator[](std::size_t i) const { return maps_[i]; }
  [[nodiscard]] const LocalMap& front() const { return maps_.front(); }
  [[nodiscard]] const LocalMap& back() const { return maps_.back(); }
  /// All of them, likewise.
  [[nodiscard]] const std::vector<LocalMap>& headers() const { return maps_; }

  /// The complete local map, bit for bit.
  [[nodiscard]] LocalMap load(std::size_t i) const;
  /// All of them, in memory.
  [[nodiscard]] std::vector<LocalMap> load_all() const;

 private:
  std::vector<LocalMap> maps_;
  std::optional<SpoolFile> scans_;      ///< empty: in the maps
  std::vector<std::uint64_t> offsets_;  ///< of each map in the file
};

}  // namespace adit
