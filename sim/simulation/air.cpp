// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/air.hpp"

#include <algorithm>
#include <cmath>

namespace adit {

GasReading air_at(const World& world, const Eigen::Vector2d& p_world, std::int64_t utime) {
  GasReading reading;
  reading.utime = utime;
  for (const GasPocket& pocket : world.gas) {
    const double distances = (p_world - pocket.p_world).norm() / pocket.radius_m;
    reading.methane_share += pocket.methane_share * std::exp(-0.5 * distances * distances);
  }
  reading.methane_share = std::min(reading.methane_share, 1.0);
  reading.oxygen_share *= 1.0 - reading.methane_share;
  return reading;
}

}  // namespace adit
