// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/lasers/vlp16_emulator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace adit {
namespace {

constexpr double kCycleUs = 55.296;
constexpr double kOneLaserUs = 2.304;
// Table 9-1: laser 0 to 15.
constexpr std::array<int, 16> kVerticalDeg{-15, 1, -13, 3,  -11, 5,  -9, 7,
                                           -7,  9, -5,  11, -3,  13, -1, 15};

void put16(std::vector<std::uint8_t>& bytes, unsigned value) {
  bytes.push_back(static_cast<std::uint8_t>(value & 0xFFU));
  bytes.push_back(static_cast<std::uint8_t>(value >> 8U & 0xFFU));
}

}  // namespace

void Vlp16Emulator::power_on(std::int64_t now_us) {
  on_us_ = now_us + std::llround(1e6 * model_.boot_s);
  fired_us_ = static_cast<double>(*on_us_);
  stamp_offset_us_ = 0.0;
  azimuth_origin_us_ = fired_us_;
  azimuth_origin_deg_ = kFirstAzimuthDeg;
}

void Vlp16Emulator::set_rpm(double rpm) {
  azimuth_origin_deg_ = azimuth_deg(fired_us_);
  azimuth_origin_us_ = fired_us_;
  model_.rpm = rpm;
}

double Vlp16Emulator::stamp_at(double us) const {
  const double since_us = (us - static_cast<double>(*on_us_)) * model_.clock_rate;
  return std::fmod(model_.first_stamp_us + since_us + stamp_offset_us_, 3.6e9);
}

double Vlp16Emulator::azimuth_deg(double us) const {
  return std::fmod(azimuth_origin_deg_ + (us - azimuth_origin_us_) * model_.rpm * 6e-6, 360.0);
}

/// Three bytes of each laser: distance in 2 mm, reflectivity.
std::array<std::uint8_t, 48> Vlp16Emulator::fire(double us) const {
  std::array<std::uint8_t, 48> bytes{};
  for (std::size_t laser = 0; laser < 16; ++laser) {
    const double fired_us = us + kOneLaserUs * static_cast<double>(laser);
    const double alpha = azimuth_deg(fired_us) * std::numbers::pi / 180.0;
    const double omega = kVerticalDeg[laser] * std::numbers::pi / 180.0;
    const double range_m = surrounding_(fired_us, std::cos(omega) * std::sin(alpha),
                                        std::cos(omega) * std::cos(alpha), std::sin(omega));
    const long units = range_m < 0.0 || range_m > 131.0 ? 0 : std::lround(range_m / 0.002);
    bytes[3 * laser] = static_cast<std::uint8_t>(units & 0xFF);
    bytes[3 * laser + 1] = static_cast<std::uint8_t>(units >> 8);
    bytes[3 * laser + 2] = 100;
  }
  return bytes;
}

Vlp16Emulator::Packet Vlp16Emulator::packet() {
  const bool dual = model_.return_mode == 0x39;
  Packet packet;
  const double stamp = stamp_at(fired_us_);
  for (int block = 0; block < 12; block += dual ? 2 : 1) {
    std::vector<std::uint8_t> bytes{0xFF, 0xEE};
    put16(bytes, static_cast<unsigned>(std::lround(100.0 * azimuth_deg(fired_us_))) % 36000U);
    for (int i = 0; i < 2; ++i) {
      const auto returns = fire(fired_us_);
      bytes.insert(bytes.end(), returns.begin(), returns.end());
      fired_us_ += kCycleUs;
    }
    packet.bytes.insert(packet.bytes.end(), bytes.begin(), bytes.end());
    if (!dual) continue;
    // The strongest return, here of dust at half the distance.
    for (std::size_t at = 4; at < bytes.size(); at += 3) {
      const unsigned units = (bytes[at] | bytes[at + 1] << 8U) / 2U;
      bytes[at] = static_cast<std::uint8_t>(units & 0xFFU);
      bytes[at + 1] = static_cast<std::uint8_t>(units >> 8U);
    }
    packet.bytes.insert(packet.bytes.end(), bytes.begin(), bytes.end());
  }
  const auto stamp_us = static_cast<std::uint32_t>(stamp);
  put16(packet.bytes, stamp_us & 0xFFFFU);
  put16(packet.bytes, stamp_us >> 16U);
  packet.bytes.push_back(model_.return_mode);
  packet.bytes.push_back(model_.product);
  packet.arrival_us = std::llround(fired_us_ + model_.latency_us);
  return packet;
}

std::vector<Vlp16Emulator::Packet> Vlp16Emulator::advance(std::int64_t now_us) {
  std::vector<Packet> packets;
  const double packet_us = kCycleUs * (model_.return_mode == 0x39 ? 12.0 : 24.0);
  while (on_us_ && fired_us_ + packet_us + model_.latency_us <= static_cast<double>(now_us)) {
    packets.push_back(packet());
  }
  return packets;
}

}  // namespace adit
