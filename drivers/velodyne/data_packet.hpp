// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/messages/result.hpp"

namespace adit::velodyne {

inline constexpr std::size_t kPacketBytes = 1206;
inline constexpr std::size_t kLasers = 16;
inline constexpr double kFiringUs = 55.296;  ///< from one firing of all lasers to the next
inline constexpr double kLaserUs = 2.304;    ///< from one laser to the next within a firing

/// One firing of all lasers.
struct Firing {
  double after_us = 0.0;     ///< after the time stamp of the packet
  double azimuth_deg = 0.0;  ///< at its first laser, clockwise, 0 to 360
  /// By the order of firing [2 mm]; 0 without return. Of two returns the last one.
  std::array<std::uint16_t, kLasers> ranges{};
};

/// A data packet of a VLP-16, Puck LITE or Puck Hi-Res.
struct DataPacket {
  std::uint32_t time_us = 0;  ///< of its first firing, after the hour
  std::uint8_t return_mode = 0;
  std::uint8_t product = 0;
  double degrees_per_us = 0.0;  ///< mean rate of its azimuths
  std::vector<Firing> firings;

  [[nodiscard]] double duration_us() const {
    return kFiringUs * static_cast<double>(firings.size());
  }
};

/// Elevation of each laser, in the order of firing [deg]. Empty for an unknown product.
std::span<const double> elevations_deg(std::uint8_t product);

/// Reads a data packet (VLP-16 User Manual 63-9243, chapter 9). Rejects another length, a block
/// without its flag, azimuths that do not advance like those of a lidar that turns at 240 to 1,260
/// rpm, a time beyond the hour, unknown return modes and products. Damaged distances are not
/// noticed.
Result<DataPacket> read_data_packet(std::span<const std::uint8_t> bytes);

}  // namespace adit::velodyne
