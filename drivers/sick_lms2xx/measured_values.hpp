// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "common/messages/result.hpp"

namespace adit {

/// The readings of one scan, response B0h: number and unit in 16 bits, then 16 bits for each beam,
/// 13 of them the distance (measuring modes 0 to 2, to 8 or 80 m), all low byte first.
struct LmsMeasuredValues {
  double unit_m = 0.01;            ///< 0.01 or 0.001
  std::vector<std::uint16_t> raw;  ///< distance in units, or one of the codes from kCodesFrom

  /// Values from here are no distances: nothing returned, or the laser could not measure.
  static constexpr std::uint16_t kCodesFrom = 0x1FF7;
  static constexpr std::uint16_t kDazzled = 0x1FFE;
  static constexpr std::uint16_t kReadError = 0x1FFA;

  /// Ranges [m]: the largest reading, 8191 units, where nothing returned, as the simulator reports
  /// it; NaN where the laser was dazzled or failed, which is not known to be free.
  [[nodiscard]] std::vector<float> ranges_m() const;
};

/// Reads the data of a response B0h, with its status byte. Rejects an unknown unit, a partial scan,
/// and a number of readings that does not agree with the length.
Result<LmsMeasuredValues> read_measured_values(std::span<const std::uint8_t> data);

}  // namespace adit
