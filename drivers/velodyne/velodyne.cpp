// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/velodyne/velodyne.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace adit {
namespace {

using velodyne::DataPacket;
using velodyne::Firing;
using velodyne::kFiringUs;
using velodyne::kLasers;
using velodyne::kLaserUs;

constexpr std::int64_t kHourUs = 3'600'000'000;
constexpr double kRangeUnitM = 0.002;
constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr double kTurnDeg = 360.0;
constexpr double kSeamDeg = 180.0;         // straight behind
constexpr double kTransmissionUs = 100.0;  // of a packet at 100 Mbit/s
constexpr double kColumnsMin = 0.8;        // share of a turn, of a revolution that counts
constexpr double kRateDiffers = 0.05;
// The lasers of all products by elevation: they fire alternately from below and from the middle.
constexpr std::array<std::size_t, kLasers> kByElevation{0, 2, 4, 6, 8, 10, 12, 14,
                                                        1, 3, 5, 7, 9, 11, 13, 15};
constexpr std::int64_t kStreamsUs = 400'000;

}  // namespace

Velodyne::Velodyne(const VelodyneParams& params, LaserId laser)
    : params_(params), level_view_(params.lasers) {
  if (laser == LaserId::kRear) {
    throw std::invalid_argument("a spinning lidar takes the place of the front laser: use front");
  }
  if (!params.lasers.lidar.present) {
    throw std::invalid_argument(
        "the configuration has no spinning lidar: set lasers.lidar.present and pitch_rad");
  }
}

void Velodyne::start(std::int64_t now_us) {
  now_us_ = now_us;
  clock_.reset();
  device_us_.reset();
  revolution_.reset();
}

/// Maps the stamp, which begins again each hour, and counts packets that are missing before it. A
/// damaged stamp must not make those behind it too old; if all are implausible the clock of the
/// lidar was set, as by GPS, or it was switched on again.
bool Velodyne::accept_stamp(const DataPacket& packet, std::int64_t arrival_us) {
  constexpr std::int64_t kOffMaxUs = 100'000;
  constexpr int kImplausibleMax = 3;
  const auto time_us = static_cast<std::int64_t>(packet.time_us);
  if (!device_us_) {
    device_us_ = time_us;
    return true;
  }
  std::int64_t since_us = (time_us - *device_us_ % kHourUs + kHourUs) % kHourUs;
  if (since_us > kHourUs / 2) since_us -= kHourUs;
  const std::int64_t off_us = since_us - (arrival_us - *packet_us_);
  if (since_us > 0 && std::abs(off_us) <= kOffMaxUs) {
    const double packets = static_cast<double>(since_us) / packet_duration_us_;
    const auto missing = static_cast<std::int64_t>(std::lround(packets)) - 1;
    counts_.messages += std::max<std::int64_t>(0, missing);
    counts_.corrupt += std::max<std::int64_t>(0, missing);
    *device_us_ += since_us;
    implausible_ = 0;
    return true;
  }
  if (++implausible_ <= kImplausibleMax) return false;
  implausible_ = 0;
  clock_.reset();
  revolution_.reset();
  device_us_ = time_us;
  return true;
}

std::vector<LaserScan> Velodyne::receive(std::span<const std::uint8_t> bytes, std::int64_t now_us) {
  now_us_ = now_us;
  ++counts_.messages;
  const auto packet = velodyne::read_data_packet(bytes);
  rejection_ = packet ? "" : std::string(packet.rejection());
  if (!packet || !accept_stamp(*packet, now_us)) {
    ++counts_.corrupt;
    return {};
  }
  packet_us_ = now_us;
  packet_duration_us_ = packet->duration_us();
  product_ = packet->product;
  degrees_per_us_ = packet->degrees_per_us;
  clock_.add_arrival(*device_us_, now_us);
  for (const Firing& firing : packet->firings) {
    add_firing(firing, *device_us_ + std::lround(firing.after_us));
  }
  return std::exchange(scans_, {});
}

/// The rings of this product by elevation, at the present rate.
std::vector<LidarRing> Velodyne::rings() const {
  std::vector<LidarRing> rings;
  const auto elevations = velodyne::elevations_deg(product_);
  for (const std::size_t i : kByElevation) {
    const double after_us = kLaserUs * static_cast<double>(i);
    rings.push_back({static_cast<float>(elevations[i] * kRadPerDeg),
                     static_cast<float>(-degrees_per_us_ * after_us * kRadPerDeg),
                     static_cast<float>(after_us)});
  }
  return rings;
}

void Velodyne::begin_revolution(std::int64_t device_us) {
  begin_us_ = device_us;
  revolution_.emplace();
  revolution_->rings = rings();
}

void Velodyne::add_firing(const Firing& firing, std::int64_t device_us) {
  const double turned_deg = std::fmod(firing.azimuth_deg + kTurnDeg - kSeamDeg, kTurnDeg);
  const double turn_us = kTurnDeg / degrees_per_us_;
  const bool crosses = turned_deg < turned_deg_;
  const bool is_late = revolution_ && static_cast<double>(device_us - begin_us_) > 1.5 * turn_us;
  turned_deg_ = turned_deg;
  if (revolution_ && (crosses || is_late)) finish_revolution();
  // After a gap the begin of this turn may be missing.
  if (crosses && turned_deg < 0.1 * kTurnDeg) begin_revolution(device_us);
  if (!revolution_) return;
  revolution_->columns.push_back({static_cast<std::int32_t>(device_us - begin_us_),
                                  static_cast<float>(-firing.azimuth_deg * kRadPerDeg)});
  for (const std::size_t laser : kByElevation) {
    const std::uint16_t range = firing.ranges[laser];
    revolution_->ranges_m.push_back(range == 0 ? std::numeric_limits<float>::infinity()
                                               : static_cast<float>(kRangeUnitM * range));
  }
}

void Velodyne::finish_revolution() {
  LidarRevolution revolution = std::move(*revolution_);
  revolution_.reset();
  const double columns = kTurnDeg / (degrees_per_us_ * kFiringUs);
  if (static_cast<double>(revolution.columns.size()) < kColumnsMin * columns) return;
  revolution.utime = clock_.utime(begin_us_, packet_duration_us_ + kTransmissionUs);
  scans_.push_back(level_view_.scan(revolution));
  if (number_++ % params_.decimation == 0) revolutions_.push_back(std::move(revolution));
}

std::vector<LidarRevolution> Velodyne::take_revolutions() {
  return std::exchange(revolutions_, {});
}

bool Velodyne::is_streaming() const { return packet_us_ && now_us_ - *packet_us_ < kStreamsUs; }

std::string Velodyne::problem() const {
  if (!is_streaming()) return rejection_.empty() ? "no data packets arrive" : rejection_;
  const double hz = 1e6 * degrees_per_us_ / kTurnDeg;
  const double expected_hz = params_.lasers.front.timing.mirror_hz;
  if (std::abs(hz - expected_hz) > kRateDiffers * expected_hz) {
    return fmt::format(
        "the lidar turns at {:.0f} rpm, but lasers.front.timing.mirror_hz = {} is {:.0f}: set it "
        "on its web page",
        60.0 * hz, expected_hz, 60.0 * expected_hz);
  }
  return {};
}

}  // namespace adit
