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

void EmulatedLaser::count(std::int64_t scan_utime, std::int64_t sim_utime) {
  ++scans_;
  if (std::abs(sim_utime - scan_utime) > kScanOffMaxUs) ++missing_;
}

std::int64_t power_on_in_phase(std::int64_t now, std::int64_t sim_utime, double first_us,
                               double period_us) {
  const double off_us = static_cast<double>(sim_utime - now) - first_us;
  return now + std::llround(off_us - period_us * std::floor(off_us / period_us));
}

float EmulatedScanner::range_m(std::int64_t scan_start, std::size_t beam) {
  if (beam == 0) {
    seen_ = robot_.scan(id_, scan_start);
    count(scan_start, seen_->utime);
  }
  return seen_->ranges_m.at(beam);
}

EmulatedHokuyo::EmulatedHokuyo(const SimulatedRobot& robot, LaserId id,
                               std::filesystem::path address_file)
    : EmulatedScanner(robot, id),
      laser_({.has_baud = false},
             [this](int scan, int step) {
               return static_cast<std::uint32_t>(std::lround(
                   1e3F * range_m(laser_.scan_start(scan), static_cast<std::size_t>(step))));
             }),
      line_(laser_),
      address_file_(std::move(address_file)) {}

void EmulatedHokuyo::power_on(std::int64_t now) {
  laser_.power_on(
      power_on_in_phase(now, sim_utime(now), ScipEmulator::kFirstScanUs, kHokuyoPeriodUs));
  std::ofstream(address_file_) << line_.address() << "\n";
}

EmulatedSick::EmulatedSick(const SimulatedRobot& robot, LaserId id,
                           const std::filesystem::path& link)
    : EmulatedScanner(robot, id),
      laser_({},
             [this](int scan, int beam) {
               return static_cast<std::uint16_t>(std::lround(
                   1e2F * range_m(laser_.scan_start(scan), static_cast<std::size_t>(beam))));
             }),
      line_(link, laser_) {}

void EmulatedSick::power_on(std::int64_t now) {
  laser_.power_on(power_on_in_phase(now, sim_utime(now), LmsEmulator::kFirstScanUs, kSickPeriodUs));
}

}  // namespace adit
