// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/files/spool_file.hpp"
#include "common/types/cloud.hpp"

namespace adit {

/// The 3D scans of a mission, whose points are in a temporary file: those of 3 km of tunnels fill
/// 600 MB. Several threads may read.
class CloudStore {
 public:
  /// The file is in `folder`.
  explicit CloudStore(const std::filesystem::path& folder = std::filesystem::temp_directory_path())
      : lines_(folder) {}

  /// Beams without return are left out. Throws FileError, as does `lines`.
  void push_back(Cloud cloud);

  [[nodiscard]] std::size_t size() const { return clouds_.size(); }
  [[nodiscard]] bool empty() const { return clouds_.empty(); }
  /// A 3D scan with its first line only, and that without points.
  [[nodiscard]] const Cloud& operator[](std::size_t i) const { return clouds_[i]; }
  /// Number of its points.
  [[nodiscard]] std::size_t points(std::size_t i) const { return points_[i]; }
  /// Its lines, bit for bit.
  [[nodiscard]] std::vector<CloudLine> lines(std::size_t i) const;

 private:
  std::vector<Cloud> clouds_;
  std::vector<std::size_t> points_;
  std::vector<std::uint64_t> offsets_;  // of the lines of each in the file
  SpoolFile lines_;
};

}  // namespace adit
