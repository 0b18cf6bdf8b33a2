// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace adit {

/// Space that a process without privileges may still fill on the file system of an existing file or
/// folder [bytes]; nothing if the system does not tell.
std::optional<std::uint64_t> free_bytes(const std::filesystem::path& path);

/// Watches the free space of one file system.
class DiskSpace {
 public:
  /// `path` must exist when `shortage` is called. A minimum of 0 MB never is a shortage.
  DiskSpace(std::filesystem::path path, double min_mb);

  /// Why the space does not suffice, e.g. "120 MB free on the disk of /x, 200 MB are required";
  /// empty if it does, or if the system does not tell.
  [[nodiscard]] std::string shortage() const;

 private:
  std::filesystem::path path_;
  double min_mb_;
};

}  // namespace adit
