// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/fault_injection.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "common/text/message_text.hpp"

namespace adit {
namespace {

std::int64_t microseconds(double seconds) { return std::llround(seconds * 1e6); }

bool is_laser_fault(const FaultDescription& fault) {
  return fault.kind == "laser_dies" || fault.kind == "laser_recovers";
}

void check(const FaultDescription& fault) {
  if (is_laser_fault(fault) && fault.target != "front" && fault.target != "rear") {
    throw std::invalid_argument(fmt::format("fault {}: no laser {}; lasers are front and rear",
                                            fault.kind, quote(fault.target)));
  }
  if (fault.kind == "packet_loss" && !(fault.amount >= 0.0 && fault.amount <= 1.0)) {
    throw std::invalid_argument("fault packet_loss: the amount must be a fraction, 0 to 1");
  }
}

}  // namespace

FaultSchedule::FaultSchedule(const std::vector<FaultDescription>& faults,
                             std::int64_t start_utime) {
  for (const FaultDescription& fault : faults) {
    check(fault);
    faults_.push_back({start_utime + microseconds(fault.at_s), fault});
  }
  std::stable_sort(faults_.begin(), faults_.end(),
                   [](const Fault& a, const Fault& b) { return a.utime < b.utime; });
}

bool FaultSchedule::alive(SimLaser laser, std::int64_t utime) const {
  const char* target = laser == SimLaser::kFront ? "front" : "rear";
  bool alive = true;
  for (const auto& [at, fault] : faults_) {
    if (at > utime) break;
    if (is_laser_fault(fault) && fault.target == target) alive = fault.kind == "laser_recovers";
  }
  return alive;
}

std::int64_t FaultSchedule::clock_ahead_us(std::int64_t utime) const {
  std::int64_t ahead = 0;
  for (const auto& [at, fault] : faults_) {
    if (at <= utime && fault.kind == "time_jump") ahead += microseconds(fault.amount);
  }
  return ahead;
}

double FaultSchedule::loss_share(std::int64_t utime) const {
  double share = 0.0;
  for (const auto& [at, fault] : faults_) {
    if (at <= utime && fault.kind == "packet_loss") share = fault.amount;
  }
  return share;
}

void ReadingQueue::add(std::int64_t utime, Reading reading) {
  added_.emplace_back(utime, std::move(reading));
}

std::vector<Reading> ReadingQueue::take() {
  std::stable_sort(added_.begin(), added_.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Reading> readings;
  for (auto& [utime, reading] : added_) {
    if (is_driver_reading(reading)) {
      if (is_lost(utime)) continue;
      std::int64_t& measured = utime_of(reading);
      measured += faults_.clock_ahead_us(measured);
    }
    readings.push_back(std::move(reading));
  }
  added_.clear();
  return readings;
}

bool ReadingQueue::is_lost(std::int64_t utime) {
  const double share = faults_.loss_share(utime);
  return share > 0.0 && std::uniform_real_distribution<double>()(random_) < share;
}

}  // namespace adit
