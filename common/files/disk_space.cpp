// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/disk_space.hpp"

#include <utility>

#include <fmt/format.h>
#include <sys/statvfs.h>

namespace adit {

std::optional<std::uint64_t> free_bytes(const std::filesystem::path& path) {
  struct statvfs status {};
  if (statvfs(path.c_str(), &status) != 0) return std::nullopt;
  return std::uint64_t{status.f_bavail} * status.f_frsize;
}

DiskSpace::DiskSpace(std::filesystem::path path, double min_mb)
    : path_(std::move(path)), min_mb_(min_mb) {}

std::string DiskSpace::shortage() const {
  constexpr double kBytesPerMb = 1e6;
  const auto bytes = free_bytes(path_);
  if (!bytes) return {};
  const double free_mb = static_cast<double>(*bytes) / kBytesPerMb;
  if (free_mb >= min_mb_) return {};
  return fmt::format("{:.0f} MB free on the disk of {}, {:.0f} MB are required", free_mb,
                     path_.string(), min_mb_);
}

}  // namespace adit
