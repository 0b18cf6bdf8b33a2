// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/velodyne/data_packet.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

namespace adit::velodyne {
namespace {

constexpr std::size_t kBlocks = 12;
constexpr std::size_t kBlockBytes = 100;
constexpr std::size_t kFiringsPerBlock = 2;
constexpr std::size_t kReturnBytes = 3;  // distance and reflectivity
constexpr std::uint8_t kStrongest = 0x37;
constexpr std::uint8_t kLast = 0x38;
constexpr std::uint8_t kDual = 0x39;
constexpr std::uint32_t kHourUs = 3'600'000'000U;
constexpr int kTurn = 36'000;  // azimuths are in 0.01°

// Of an azimuth to the next, two firings later, at the least and the greatest speed.
constexpr double kStepMin = 240.0 / 60.0 * kTurn * 2.0 * kFiringUs * 1e-6;
constexpr double kStepMax = 1260.0 / 60.0 * kTurn * 2.0 * kFiringUs * 1e-6;
constexpr double kRounding = 2.0;   // of two azimuths
constexpr double kUnsteady = 0.05;  // of the speed within a packet

constexpr std::array<double, kLasers> kVlp16Deg{-15, 1, -13, 3,  -11, 5,  -9, 7,
                                                -7,  9, -5,  11, -3,  13, -1, 15};
constexpr std::array<double, kLasers> kHiResDeg{-10.0, 0.67, -8.67, 2.0,  -7.33, 3.33, -6.0,  4.67,
                                                -4.67, 6.0,  -3.33, 7.33, -2.0,  8.67, -0.67, 10.0};

std::uint16_t word(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8);
}

std::array<std::uint16_t, kLasers> ranges_of(std::span<const std::uint8_t> block,
                                             std::size_t firing) {
  std::array<std::uint16_t, kLasers> ranges{};
  for (std::size_t laser = 0; laser < kLasers; ++laser) {
    ranges[laser] = word(block, 4 + kReturnBytes * (firing * kLasers + laser));
  }
  return ranges;
}

/// Mean of the steps from one azimuth to the next; nothing if one of them is not that of a lidar
/// that turns steadily: it is damaged.
std::optional<double> step_of(const std::vector<int>& azimuths) {
  std::vector<int> steps;
  for (std::size_t i = 1; i < azimuths.size(); ++i) {
    steps.push_back((azimuths[i] - azimuths[i - 1] + kTurn) % kTurn);
  }
  std::vector<int> sorted = steps;
  std::ranges::sort(sorted);
  const int median = sorted[sorted.size() / 2];
  if (median < kStepMin - kRounding || median > kStepMax + kRounding) return std::nullopt;
  double turned = 0.0;
  for (const int step : steps) {
    if (std::abs(step - median) > kRounding + kUnsteady * median) return std::nullopt;
    turned += step;
  }
  return turned / static_cast<double>(steps.size());
}

}  // namespace

std::span<const double> elevations_deg(std::uint8_t product) {
  if (product == 0x22) return kVlp16Deg;
  if (product == 0x24) return kHiResDeg;
  return {};
}

Result<DataPacket> read_data_packet(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != kPacketBytes) return Rejected{"not a data packet of 1206 bytes"};
  DataPacket packet;
  packet.return_mode = bytes[1204];
  packet.product = bytes[1205];
  packet.time_us = word(bytes, 1200) | static_cast<std::uint32_t>(word(bytes, 1202)) << 16U;
  if (elevations_deg(packet.product).empty()) {
    return Rejected{"packets of another product than VLP-16, Puck LITE or Puck Hi-Res"};
  }
  if (packet.return_mode != kStrongest && packet.return_mode != kLast &&
      packet.return_mode != kDual) {
    return Rejected{"unknown return mode"};
  }
  if (packet.time_us >= kHourUs) return Rejected{"time stamp beyond the hour"};

  // With two returns, two blocks have one azimuth: the last return, then the strongest one or, if
  // both are one, the second strongest.
  const std::size_t stride = packet.return_mode == kDual ? 2 : 1;
  std::vector<int> azimuths;
  for (std::size_t i = 0; i < kBlocks; ++i) {
    const auto block = bytes.subspan(i * kBlockBytes, kBlockBytes);
    if (block[0] != 0xFF || block[1] != 0xEE) return Rejected{"block without its flag"};
    const int azimuth = word(block, 2);
    if (azimuth >= kTurn) return Rejected{"azimuth of more than a turn"};
    if (i % stride != 0) {
      if (azimuth != azimuths.back()) return Rejected{"two returns of different azimuths"};
      continue;
    }
    azimuths.push_back(azimuth);
  }
  const auto mean_step = step_of(azimuths);
  if (!mean_step) return Rejected{"azimuths do not advance"};
  const double step = *mean_step;
  packet.degrees_per_us = 0.01 * step / (2.0 * kFiringUs);
  for (std::size_t i = 0; i < azimuths.size(); ++i) {
    const auto block = bytes.subspan(i * stride * kBlockBytes, kBlockBytes);
    const double next =
        i + 1 < azimuths.size() ? (azimuths[i + 1] - azimuths[i] + kTurn) % kTurn : step;
    for (std::size_t j = 0; j < kFiringsPerBlock; ++j) {
      const double azimuth = azimuths[i] + next * static_cast<double>(j) / kFiringsPerBlock;
      const auto number = static_cast<double>(packet.firings.size());
      packet.firings.push_back(
          {number * kFiringUs, 0.01 * std::fmod(azimuth, kTurn), ranges_of(block, j)});
    }
  }
  return packet;
}

}  // namespace adit::velodyne
