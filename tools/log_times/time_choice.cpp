// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/log_times/time_choice.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/sensing/laser_scan.hpp"

namespace adit {
namespace {

constexpr double kUsableShareMin = 0.9;
constexpr double kPeriodMinUs = 1e3;  // 1000 scans per second
constexpr double kPeriodMaxUs = 1e7;
constexpr double kSpeed = 0.5;    // of a robot that moves [m/s, rad/s]
constexpr double kMoved = 0.005;  // a smaller step is noise of a body at rest [m, rad]

bool is_plausible_period(double us) { return us >= kPeriodMinUs && us <= kPeriodMaxUs; }

}  // namespace

std::string TimeChoice::text() const {
  if (source == Source::kLogged) {
    return fmt::format("times of the logger are used: of the times of measurement of scans, {}",
                       defects);
  }
  if (source == Source::kOrder) {
    return fmt::format(
        "times are assumed: order in the file, {:.4g} s from scan to scan by {}; of the times of "
        "scans, {}",
        1e-6 * period_us, period_origin, defects);
  }
  if (late > 0) return fmt::format("{} readings out of order are sorted by time", late);
  return {};
}

void TimeJudge::add_scan(std::string_view channel, const RecordedTimes& times,
                         double angle_step_rad, const Pose2* T_wheel_body) {
  Clocks& clocks = lasers_[std::string(channel)];
  clocks.measured.add(times.measured_utime, clocks.measured.readings());
  clocks.logged.add(times.logged_utime, clocks.logged.readings());
  if (scans_++ == 0) angle_step_rad_ = angle_step_rad;
  if (T_wheel_body != nullptr) add_wheels(*T_wheel_body);
  add_motion();
}

void TimeJudge::add_reading(std::string_view channel, const RecordedTimes& times,
                            const Pose2* T_wheel_body) {
  const auto* laser = pace();
  const std::size_t position = laser == nullptr ? 0 : laser->second.measured.readings();
  Clocks& clocks = others_[std::string(channel)];
  clocks.measured.add(times.measured_utime, position);
  clocks.logged.add(times.logged_utime, position);
  ++readings_;
  if (T_wheel_body != nullptr) add_wheels(*T_wheel_body);
}

void TimeJudge::add_wheels(const Pose2& T_wheel_body) {
  if (!motion_) motion_ = Motion{T_wheel_body, T_wheel_body};
  motion_->T_wheel_body_now = T_wheel_body;
}

/// Counts the motion of the wheels since the previous scan.
void TimeJudge::add_motion() {
  if (!motion_) return;
  const Pose2 step = between(motion_->T_wheel_body, motion_->T_wheel_body_now);
  motion_->T_wheel_body = motion_->T_wheel_body_now;
  const double moved_m = step.translation().norm();
  const double turned_rad = std::abs(step.theta);
  if (moved_m > kMoved) {
    motion_->moved_m += moved_m;
    ++motion_->steps;
  }
  if (turned_rad > kMoved) {
    motion_->turned_rad += turned_rad;
    ++motion_->turns;
  }
}

std::size_t TimeJudge::scans() const { return scans_; }

bool TimeJudge::logged_usable() const { return usable_share(&Clocks::logged) >= kUsableShareMin; }

TimeChoice TimeJudge::choose() const {
  TimeChoice choice;
  const auto* laser = pace();
  choice.late = late(&Clocks::measured);
  if (laser == nullptr || scans_ < 2) return choice;
  choice.channel = laser->first;
  if (usable_share(&Clocks::measured) >= kUsableShareMin) return choice;
  const Clocks& clocks = laser->second;
  choice.defects = clocks.measured.defects();
  if (logged_usable()) {
    choice.source = TimeChoice::Source::kLogged;
    choice.late = late(&Clocks::logged);
    return choice;
  }
  choice.source = TimeChoice::Source::kOrder;
  choice.late = 0;
  choice.start_utime = clocks.measured.first_utime().value_or(
      clocks.logged.first_utime().value_or(choice.start_utime));
  const Period chosen = period();
  choice.period_us = chosen.us;
  choice.period_origin = chosen.origin;
  const auto scans = static_cast<double>(clocks.measured.readings());
  choice.readings_per_scan = static_cast<double>(readings_ + scans_) / scans - 1.0;
  return choice;
}

/// The laser with the most scans, the first by name of equal ones.
const TimeJudge::Sensors::value_type* TimeJudge::pace() const {
  const auto most =
      std::max_element(lasers_.begin(), lasers_.end(), [](const auto& a, const auto& b) {
        return a.second.measured.readings() < b.second.measured.readings();
      });
  return most == lasers_.end() ? nullptr : &*most;
}

TimeJudge::Period TimeJudge::period() const {
  const Clocks& clocks = pace()->second;
  for (const auto& [statistics, origin] :
       {std::pair{&clocks.measured, "the changes of the times of scans"},
        std::pair{&clocks.logged, "the changes of the times of the logger"}}) {
    const auto us = statistics->scan_period_us();
    if (us && is_plausible_period(*us)) return {*us, origin};
  }
  for (const auto& [channel, other] : others_) {
    for (const ClockStatistics* statistics : {&other.measured, &other.logged}) {
      const auto us = statistics->scan_period_us();
      if (us && is_plausible_period(*us)) return {*us, "the times of " + channel};
    }
  }
  const double laser_us = 1e6 * ScanTiming{}.scan_period_s(angle_step_rad_);
  double moved = 0.0;
  if (motion_ && motion_->steps > 0) {
    moved = motion_->moved_m / static_cast<double>(motion_->steps);
  }
  if (motion_ && motion_->turns > 0) {
    moved = std::max(moved, motion_->turned_rad / static_cast<double>(motion_->turns));
  }
  const double motion_us = 1e6 * moved / kSpeed;
  if (motion_us > laser_us) {
    return {std::min(motion_us, kPeriodMaxUs), "a robot at 0.5 m/s or 0.5 rad/s"};
  }
  return {laser_us, "the rate of the laser"};
}

double TimeJudge::usable_share(ClockStatistics Clocks::*clock) const {
  std::size_t readings = 0;
  std::size_t usable = 0;
  for (const auto& [channel, clocks] : lasers_) {
    readings += (clocks.*clock).readings();
    usable += (clocks.*clock).usable();
  }
  return readings == 0 ? 0.0 : static_cast<double>(usable) / static_cast<double>(readings);
}

std::size_t TimeJudge::late(ClockStatistics Clocks::*clock) const {
  std::size_t total = 0;
  for (const Sensors* sensors : {&lasers_, &others_}) {
    for (const auto& [channel, clocks] : *sensors) total += (clocks.*clock).late();
  }
  return total;
}

}  // namespace adit
