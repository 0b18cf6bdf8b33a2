// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace adit {

/// What the air is made of, at the vehicle.
struct GasReading {
  std::int64_t utime = 0;              ///< [µs since the epoch]
  double methane_share = 0.0;          ///< of the volume, 0 to 1
  double oxygen_share = 0.209;         ///< of the volume, 0 to 1
  double carbon_monoxide_share = 0.0;  ///< of the volume, 0 to 1

  friend bool operator==(const GasReading&, const GasReading&) = default;
};

/// How deep the wheels are in the ground.
struct SinkageReading {
  std::int64_t utime = 0;           ///< [µs since the epoch]
  std::array<double, 4> depth_m{};  ///< front left, front right, rear left, rear right

  friend bool operator==(const SinkageReading&, const SinkageReading&) = default;
};

}  // namespace adit
