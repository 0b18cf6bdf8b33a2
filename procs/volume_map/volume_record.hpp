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

/// A sub-volume as it goes to the disk when a scan came into it, with the points that are new.
struct VolumeRecord {
  int id = 0;
  StoredVolume volume;
  std::size_t first_point = 0;  ///< how many the sub-volume had before
};

/// Compressed, and always the same bytes on machines of one byte order; comes back with the same
/// bits.
std::vector<std::uint8_t> to_bytes(const VolumeRecord& record);

/// Nothing where these are no such bytes.
std::optional<VolumeRecord> volume_record_from(std::span<const std::uint8_t> bytes);

}  // namespace adit
