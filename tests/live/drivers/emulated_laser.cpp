// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/live/drivers/emulated_laser.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <utility>

namespace adit {
namespace {

constexpr std::int64_t kScanOffMaxUs = 100;
constexpr double kHokuyoPeriodUs = 25'000.0;
constexpr double kSickPeriodUs = 2e6 / 75.0;  // two turns

}  // namespace

std::int64_t EmulatedLaser::in_phase(std::int64_t now, std::int64_t first_scan_us,
                                     double period_us) const {
  const auto off_us = static_cast<double>(robot_.scan(id_, now)->utime - now - first_scan_us);
  return now + std::llround(off_us - period_us * std::floor(off_us / period_us));
}

float EmulatedLaser::range_m(std::int64_t scan_start, std::size_t beam) {
  if (beam == 0) {
    seen_ = robot_.scan(id_, scan_start);
    ++scans_;
    if (std::abs(seen_->utime - scan_start) > kScanOffMaxUs) ++missing_;
  }
  return seen_->ranges_m.at(beam);
}

EmulatedHokuyo::EmulatedHokuyo(const SimulatedRobot& robot, LaserId id,
                               std::filesystem::path address_file)
    : EmulatedLaser(robot, id),
      laser_({.has_baud = false},
             [this](int scan, int step) {
               return static_cast<std::uint32_t>(std::lround(
                   1e3F * range_m(laser_.scan_start(scan), static_cast<std::size_t>(step))));
             }),
      line_(laser_),
      address_file_(std::move(address_file)) {}

void EmulatedHokuyo::power_on(std::int64_t now) {
  laser_.power_on(in_phase(now, ScipEmulator::kFirstScanUs, kHokuyoPeriodUs));
  std::ofstream(address_file_) << line_.address() << "\n";
}

EmulatedSick::EmulatedSick(const SimulatedRobot& robot, LaserId id,
                           const std::filesystem::path& link)
    : EmulatedLaser(robot, id),
      laser_({},
             [this](int scan, int beam) {
               return static_cast<std::uint16_t>(std::lround(
                   1e2F * range_m(laser_.scan_start(scan), static_cast<std::size_t>(beam))));
             }),
      line_(link, laser_) {}

void EmulatedSick::power_on(std::int64_t now) {
  laser_.power_on(in_phase(now, LmsEmulator::kFirstScanUs, kSickPeriodUs));
}

}  // namespace adit
