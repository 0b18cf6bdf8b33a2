// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace adit {

/// The random parts of a simulation. Each has its own stream, so that no part changes what another
/// draws.
enum class RandomStream : std::uint64_t {
  kVehicle,
  kWheelOdometry,
  kImu,
  kFrontLaser,
  kRearLaser,
  kFrontScanLoss,
  kRearScanLoss,
  kPacketLoss,
};

/// The seed of a stream: one step of SplitMix64 from a state that depends on seed and stream.
/// Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014.
constexpr std::uint64_t stream_seed(std::uint64_t seed, RandomStream stream) {
  const auto mix = [](std::uint64_t z) {
    z += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  };
  return mix(mix(seed) + static_cast<std::uint64_t>(stream));
}

}  // namespace adit
