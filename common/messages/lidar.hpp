// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "adit/spinning_lidar_t.hpp"

#include "common/messages/fragments.hpp"
#include "common/messages/result.hpp"
#include "common/sensing/spinning_lidar.hpp"

namespace adit {

/// Unit of the ranges that are sent [m]: 16 bits reach 131 m.
inline constexpr float kLidarRangeUnitM = 0.004F;

/// Some of the columns of a revolution, on channel LIDAR.
struct LidarFragment {
  static constexpr int kFragmentsMax = 16;  ///< of a revolution
  static constexpr std::size_t kRingsMax = 256;
  static constexpr std::size_t kColumnsMax = 8192;

  LidarRevolution part;  ///< time and rings of the revolution, columns and ranges of this fragment
  int n_fragments = 1;
  int fragment = 0;  ///< 0 to n_fragments − 1
};

/// Ranges are rounded to kLidarRangeUnitM, those too long are sent as no return; all else is
/// restored exactly.
spinning_lidar_t to_message(const LidarFragment& fragment);

/// Rejects an implausible time, no rings or too many, elevations that do not increase, times that
/// do not increase or exceed ten seconds, implausible angles and unit, an implausible number of
/// fragments or an index out of range.
Result<LidarFragment> from_message(const spinning_lidar_t& message);

/// Each fragment but the last has as many columns as fit kFragmentBytes.
std::vector<LidarFragment> split(const LidarRevolution& revolution);

inline int reassembly_id(const LidarFragment& /*fragment*/) { return 0; }
inline std::int64_t recency(const LidarFragment& fragment) { return fragment.part.utime; }
bool same_header(const LidarFragment& a, const LidarFragment& b);
std::size_t bytes_in_memory(const LidarFragment& fragment);
std::optional<LidarRevolution> reassemble(const FragmentSet<LidarFragment>& fragments);

/// Holds the newest revolution only.
using LidarReassembler = Reassembler<LidarFragment>;

}  // namespace adit
