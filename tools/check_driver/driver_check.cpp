// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check_driver/driver_check.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/bus/channels.hpp"
#include "common/geometry/pose2.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

using Verdict = CheckResult::Verdict;

constexpr double kRadPerTurn = 6.283185307179586;

const DriverChannel* find_channel(std::string_view name) {
  const auto all = driver_channels();
  const auto found = std::ranges::find(all, name, &DriverChannel::name);
  return found == all.end() ? nullptr : &*found;
}

bool is_laser(std::string_view channel) {
  return channel == channels::kLaserFront || channel == channels::kLaserRear;
}

CheckResult check_repetition(const std::vector<std::vector<double>>& values) {
  std::size_t repeated = 0;
  for (std::size_t i = 1; i < values.size(); ++i) repeated += values[i] == values[i - 1] ? 1 : 0;
  const std::string text =
      fmt::format("{} of {} messages repeat the values before", repeated, values.size());
  return {Verdict::kGood, "repetition", text};
}

/// The noise of gyroscopes and accelerometers makes every reading another one.
CheckResults check_imu(const std::vector<std::vector<double>>& values) {
  constexpr double kGravityOffMax = 1.5;
  constexpr double kRepeatedMax = 0.5;
  std::size_t repeated = 0;
  double up = 0.0;
  double force = 0.0;
  double fastest = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& v = values[i];
    if (i > 0 && v == values[i - 1]) ++repeated;
    up += v[5] / static_cast<double>(values.size());
    force += std::hypot(v[3], v[4], v[5]) / static_cast<double>(values.size());
    fastest = std::max({fastest, std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  }
  CheckResults results;
  const bool is_frozen =
      static_cast<double>(repeated) > kRepeatedMax * static_cast<double>(values.size());
  results.push_back({is_frozen ? Verdict::kBad : Verdict::kGood, "repetition",
                     fmt::format("{} of {} messages repeat the values before{}", repeated,
                                 values.size(), is_frozen ? ": publish each reading once" : "")});
  const std::string text =
      fmt::format("specific force {:.2f} m/s², {:.2f} of it along z", force, up);
  if (std::abs(force - 9.81) > kGravityOffMax) {
    results.push_back({Verdict::kBad, "gravity",
                       text + ": a vehicle at rest has 9.81; publish m/s², with gravity"});
  } else if (up < 0.5 * force) {
    results.push_back({Verdict::kBad, "gravity",
                       text + ": axes are x forward, y left, z up, so that z has +9.81"});
  } else {
    results.push_back({Verdict::kGood, "gravity", text});
  }
  if (fastest > kRadPerTurn) {
    results.push_back({Verdict::kBad, "rotation",
                       fmt::format("up to {:.1f} rad/s: publish radians, not degrees", fastest)});
  }
  return results;
}

/// The rate must have the sign of the change of the angle.
CheckResults check_tilt(const std::vector<std::vector<double>>& values) {
  double product = 0.0;
  double moved_rad = 0.0;
  double largest_rad = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    largest_rad = std::max(largest_rad, std::abs(values[i][0]));
    if (i == 0) continue;
    const double change_rad = values[i][0] - values[i - 1][0];
    product += change_rad * values[i][1];
    moved_rad += std::abs(change_rad);
  }
  CheckResults results;
  const bool in_degrees = largest_rad > 1.6;
  results.push_back({in_degrees ? Verdict::kBad : Verdict::kGood, "angle",
                     fmt::format("up to {:.2f} rad from level{}", largest_rad,
                                 in_degrees ? ": publish radians, 0 when level" : "")});
  if (moved_rad < 0.2) {
    results.push_back({Verdict::kUnknown, "sign",
                       "not checked: tilt the laser while this runs; down is positive"});
  } else {
    results.push_back({product < 0.0 ? Verdict::kBad : Verdict::kGood, "sign",
                       product < 0.0 ? "the rate has the other sign than the change of the angle: "
                                       "both are positive downwards"
                                     : "rate and change of the angle agree"});
  }
  return results;
}

}  // namespace

DriverCheck::DriverCheck(std::string_view channel, double range_max_m)
    : channel_(find_channel(channel)), range_max_m_(range_max_m) {
  if (channel_ != nullptr) return;
  std::vector<std::string_view> names;
  for (const DriverChannel& known : driver_channels()) names.push_back(known.name);
  throw std::invalid_argument(fmt::format("{} is not a channel of a driver; those are {}",
                                          quote(channel), fmt::join(names, ", ")));
}

std::vector<std::string_view> DriverCheck::channels() const {
  std::vector<std::string_view> names{channel_->name};
  for (const std::string_view name : {channels::kImu, channels::kWheelOdometry}) {
    if (name != channel_->name) names.push_back(name);
  }
  return names;
}

void DriverCheck::add(std::string_view channel, std::span<const std::uint8_t> bytes,
                      std::int64_t arrival_utime) {
  const DriverChannel* const of = find_channel(channel);
  if (of == nullptr) return;
  const bool is_checked = of == channel_;
  if (!is_checked && channel != channels::kImu && channel != channels::kWheelOdometry) return;
  const Result<ChannelReading> reading = of->read(bytes);
  if (!reading) {
    if (is_checked) ++rejections_[std::string(reading.rejection())];
    return;
  }
  add_yaw(channel, *reading);
  if (!is_checked) return;
  if (reading->lidar) {
    const auto revolution = reassembler_.add(*reading->lidar);
    if (!revolution) return;
    turns_.emplace_back(*revolution);
  }
  times_.stamps.push_back(reading->utime);
  times_.arrivals.push_back(arrival_utime);
  if (reading->lidar) return;
  if (reading->scan) {
    if (!reading->scan->ranges_m.empty()) scans_.push_back(*reading->scan);
  } else {
    values_.push_back(reading->values);
  }
}

/// Integrates the gyro, and takes the differences of the heading by the wheels.
void DriverCheck::add_yaw(std::string_view channel, const ChannelReading& reading) {
  const bool is_gyro = reading.yaw_rate_rad_s.has_value();
  if (!is_gyro && channel != channels::kWheelOdometry) return;
  YawHistory& history = is_gyro ? gyro_yaw_ : wheel_yaw_;
  if (history.empty()) {
    history.emplace_back(reading.utime, is_gyro ? 0.0 : reading.values[2]);
    return;
  }
  const auto [before_utime, before_rad] = history.back();
  if (reading.utime <= before_utime) return;
  const double seconds = 1e-6 * static_cast<double>(reading.utime - before_utime);
  history.emplace_back(reading.utime,
                       before_rad + (is_gyro ? *reading.yaw_rate_rad_s * seconds
                                             : angle_diff(reading.values[2], before_rad)));
}

CheckResults DriverCheck::value_results() const {
  if (is_laser(channel_->name) && !scans_.empty()) {
    CheckResults results = check_scans(scans_, range_max_m_);
    results.push_back(check_turn(scans_, gyro_yaw_.empty() ? wheel_yaw_ : gyro_yaw_));
    return results;
  }
  if (!turns_.empty()) {
    CheckResults results = check_lidar(turns_);
    const auto lost = reassembler_.counts().superseded;
    results.push_back(
        {lost > 0 ? Verdict::kBad : Verdict::kGood, "fragments",
         fmt::format("{} of {} revolutions arrived incomplete{}", lost,
                     lost + static_cast<std::int64_t>(turns_.size()),
                     lost > 0
                         ? ": raise the receive buffer (net.core.rmem_max), or look for a busy "
                           "computer"
                         : "")});
    return results;
  }
  if (values_.empty()) return {};
  if (channel_->name == channels::kImu) return check_imu(values_);
  if (values_.front().size() == 2) return check_tilt(values_);
  return {check_repetition(values_)};
}

CheckResults DriverCheck::results() const {
  CheckResults results;
  const std::size_t messages = times_.stamps.size();
  int rejected = 0;
  for (const auto& [reason, count] : rejections_) {
    rejected += count;
    results.push_back(
        {Verdict::kBad, "messages",
         fmt::format("{} are rejected, {}: compare with lcmtypes/README.md", count, reason)});
  }
  if (messages < 3) {
    results.push_back({Verdict::kBad, "messages",
                       fmt::format("{} arrived: is the driver running (adit ps), on this network "
                                   "(LCM_DEFAULT_URL) and on this channel?",
                                   messages + static_cast<std::size_t>(rejected))});
    return results;
  }
  if (rejected == 0) {
    results.push_back({Verdict::kGood, "messages", fmt::format("{}, all valid", messages)});
  }
  for (CheckResult& result : check_times(*channel_, times_)) results.push_back(std::move(result));
  for (CheckResult& result : value_results()) results.push_back(std::move(result));
  return results;
}

bool all_are_good(const CheckResults& results) {
  return std::ranges::none_of(
      results, [](const CheckResult& result) { return result.verdict == Verdict::kBad; });
}

std::string text_of(std::string_view channel, const CheckResults& results) {
  std::string text;
  for (const CheckResult& result : results) {
    const char* const mark = result.verdict == Verdict::kGood  ? "ok"
                             : result.verdict == Verdict::kBad ? "BAD"
                                                               : "-";
    text += fmt::format("{:<4} {:<11} {}\n", mark, result.property, result.text);
  }
  const auto bad = std::ranges::count(results, Verdict::kBad, &CheckResult::verdict);
  text += bad == 0 ? fmt::format("{} is what the stages need\n", channel)
                   : fmt::format("{} is not what the stages need: {} of {} checks\n", channel, bad,
                                 results.size());
  return text;
}

}  // namespace adit
