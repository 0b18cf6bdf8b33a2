// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/live/drivers/emulated_velodyne.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace adit {
namespace {

constexpr double kPeriodUs = 50'000.0;
constexpr double kBehindDeg = 180.0;  // azimuth at which the revolutions of the simulator begin
constexpr double kNoReturn = -1.0;
// Ranges of two columns that differ by more than this share, and this, are of two surfaces.
constexpr double kSurfaceShare = 0.05;
constexpr double kSurfaceM = 0.05;

/// Between two columns of a ring, at a share of the distance from the first to the second.
double range_between(double first_m, double second_m, double share) {
  const double nearest_m = share < 0.5 ? first_m : second_m;
  const bool is_one_surface =
      std::abs(first_m - second_m) <= kSurfaceM + kSurfaceShare * std::min(first_m, second_m);
  if (is_one_surface) return std::lerp(first_m, second_m, share);
  return std::isfinite(nearest_m) ? nearest_m : kNoReturn;
}

std::size_t nearest_ring(const LidarRevolution& revolution, double elevation_rad) {
  const auto off = [elevation_rad](const LidarRing& ring) {
    return std::abs(ring.elevation_rad - elevation_rad);
  };
  const auto nearest = std::ranges::min_element(revolution.rings, {}, off);
  return static_cast<std::size_t>(nearest - revolution.rings.begin());
}

}  // namespace

EmulatedVelodyne::EmulatedVelodyne(const SimulatedRobot& robot)
    : robot_(robot),
      lidar_({}, [this](double us, double x, double y, double z) { return range_m(us, x, y, z); }) {
}

void EmulatedVelodyne::power_on(std::int64_t now) {
  const double to_behind_us = kPeriodUs * (kBehindDeg - Vlp16Emulator::kFirstAzimuthDeg) / 360.0;
  const double first_us = 1e6 * Vlp16Emulator::Model{}.boot_s + to_behind_us;
  lidar_.power_on(power_on_in_phase(now, robot_.revolution(now)->utime, first_us, kPeriodUs));
}

void EmulatedVelodyne::step(std::int64_t now) {
  for (const auto& packet : lidar_.advance(now)) sender_.send(packet.bytes);
}

/// The frame of the manual has y ahead and x to the right; the columns of the simulator turn
/// clockwise from behind.
double EmulatedVelodyne::range_m(double us, double x, double y, double z) {
  const LidarRevolution& revolution = *robot_.revolution(static_cast<std::int64_t>(us));
  if (revolution.utime != revolution_utime_) {
    revolution_utime_ = revolution.utime;
    const auto turns = std::floor((us - static_cast<double>(revolution.utime)) / kPeriodUs);
    count(static_cast<std::int64_t>(static_cast<double>(revolution.utime) + kPeriodUs * turns),
          revolution.utime);
  }
  const std::size_t ring = nearest_ring(revolution, std::asin(std::clamp(z, -1.0, 1.0)));
  const auto columns = static_cast<double>(revolution.columns.size());
  const double turned = 0.5 + std::atan2(x, y) / (2.0 * std::numbers::pi);
  const double at = std::clamp(turned * columns - 0.5, 0.0, columns - 1.0);
  const auto first = static_cast<std::size_t>(std::min(at, columns - 2.0));
  return range_between(revolution.range_m(first, ring), revolution.range_m(first + 1, ring),
                       at - static_cast<double>(first));
}

}  // namespace adit
