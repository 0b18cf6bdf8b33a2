// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "procs/volume_map/volume_map.hpp"

namespace adit {

/// The record of a sub-volume after a scan, with its new points.
struct VolumeRecord {
  int id = 0;
  StoredVolume volume;
  std::size_t first_point = 0;  ///< number of points in earlier records
};

/// Compressed; deterministic on machines of the same byte order, and bit-exact when read.
std::vector<std::uint8_t> to_bytes(const VolumeRecord& record);

/// Empty for malformed bytes.
std::optional<VolumeRecord> volume_record_from(std::span<const std::uint8_t> bytes);

}  // namespace adit
