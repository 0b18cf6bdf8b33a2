// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/base_serial/base_serial.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr std::int64_t kStateTimeoutUs = 500'000;  // of 25 states
constexpr std::int64_t kHelloPeriodUs = 1'000'000;
constexpr std::int64_t kHelloRetryUs = 100'000;
constexpr std::int64_t kDrivePeriodUs = 45'000;  // less than the period of ticks
constexpr std::int64_t kObeyedTimeoutUs = 1'000'000;
constexpr std::int64_t kDamageIntervalUs = 10'000'000;
constexpr double kDamagedShareMax = 0.02;
constexpr double kLatestTicks = 2.1e9;  // of an int32_t

std::int32_t ticks(double value) {
  return static_cast<std::int32_t>(std::lround(std::clamp(value, -kLatestTicks, kLatestTicks)));
}

}  // namespace

BaseSerial::BaseSerial(const BaseSerialParams& params)
    : params_(params),
      bauds_(params.baud, {115200, 57600, 230400, 38400}),
      odometry_(params.track_width_m, params.ticks_per_m) {
  if (params.battery_empty_v >= params.battery_full_v) {
    throw std::invalid_argument(
        fmt::format("battery_empty_v is {}, not less than battery_full_v, "
                    "{}",
                    params.battery_empty_v, params.battery_full_v));
  }
}

std::vector<PortRequest> BaseSerial::take_requests() { return std::exchange(requests_, {}); }

void BaseSerial::request_baud(std::int64_t now_us) {
  decoder_.clear();
  requests_.push_back({bauds_.current(), {}});
  received_us_ = now_us;
  send_hello(now_us);
}

void BaseSerial::start(std::int64_t now_us) {
  is_receiving_ = false;
  was_searched_ = false;
  bauds_.found();
  request_baud(now_us);
}

void BaseSerial::send(BaseFrameType type, std::span<const std::uint8_t> payload) {
  const auto frame = encode_base_frame(static_cast<std::uint8_t>(type), ++sequence_, payload);
  requests_.push_back({std::nullopt, frame});
  ++sent_;
}

void BaseSerial::send_hello(std::int64_t now_us) {
  send(BaseFrameType::kHello, std::vector<std::uint8_t>{kBaseProtocolVersion});
  hello_us_ = now_us;
  hello_sequence_ = sequence_;
}

void BaseSerial::send_drive(std::int64_t now_us) {
  BaseDrive drive;
  drive.brake = orders_.stopped(now_us);
  if (const auto command = orders_.command(now_us)) {
    const SideSpeeds speeds = side_speeds(command->speed_m_s, command->curvature_1_m,
                                          params_.track_width_m, params_.wheel_speed_max_m_s);
    drive.left_ticks_s = ticks(speeds.left_m_s * params_.ticks_per_m);
    drive.right_ticks_s = ticks(speeds.right_m_s * params_.ticks_per_m);
  }
  drive.acceleration_ticks_s2 =
      static_cast<std::uint32_t>(ticks(params_.acceleration_m_s2 * params_.ticks_per_m));
  drive.braking_ticks_s2 =
      static_cast<std::uint32_t>(ticks(params_.braking_m_s2 * params_.ticks_per_m));
  send(BaseFrameType::kDrive, encode_payload(drive));
  drive_us_ = now_us;
}

void BaseSerial::tick(std::int64_t now_us) {
  if (now_us - received_us_ > kStateTimeoutUs) {
    is_receiving_ = false;
    if (bauds_.advance()) was_searched_ = true;
    request_baud(now_us);
  }
  const std::int64_t hello_period_us = is_known_ ? kHelloPeriodUs : kHelloRetryUs;
  if (now_us - hello_us_ >= hello_period_us) send_hello(now_us);
  if (is_streaming() && now_us - drive_us_ >= kDrivePeriodUs) send_drive(now_us);
}

/// A new base, or one that was switched off: its clock and its encoders start at zero.
void BaseSerial::forget() {
  clock_.reset();
  odometry_.interrupt();
  last_.reset();
  implausible_ = 0;
  damage_us_ = 0;
}

/// The time of the base without overflow: the one that is next to the last.
std::int64_t BaseSerial::device_us(std::uint32_t clock_us) const {
  if (!last_) return clock_us;
  return last_us_ + static_cast<std::int32_t>(clock_us - last_->clock_us);
}

std::vector<BaseReading> BaseSerial::receive(std::span<const std::uint8_t> bytes,
                                             std::int64_t now_us) {
  std::vector<BaseReading> readings;
  decoder_.add(bytes, now_us, byte_us());
  while (const auto frame = decoder_.next()) {
    if (frame->type == static_cast<std::uint8_t>(BaseFrameType::kInfo)) {
      if (const auto info = decode_info(frame->payload)) process(*info, frame->end_us);
    } else if (frame->type == static_cast<std::uint8_t>(BaseFrameType::kState)) {
      const auto state = decode_state(frame->payload);
      auto reading = state ? process(*state, *frame) : std::nullopt;
      if (reading) readings.push_back(*reading);
    }
  }
  return readings;
}

void BaseSerial::process(const BaseInfo& info, std::int64_t end_us) {
  is_known_ = info.version == kBaseProtocolVersion;
  if (!is_known_) other_version_ = info.version;
  // Its clock is that of the states, of which the first tells how often it has overflowed.
  if (is_known_ && last_ && info.hello_sequence == hello_sequence_) {
    clock_.add_answer(device_us(info.clock_us), hello_us_, end_us);
  }
}

/// A damaged state that passes the CRC must not move the robot; if all are implausible the base was
/// switched off, or the cable was pulled for longer than its clock can tell.
bool BaseSerial::accept(const BaseState& state, std::int64_t at_us, std::int64_t arrival_us) {
  constexpr std::int64_t kOffMaxUs = 1'000'000;
  constexpr int kImplausibleMax = 5;
  constexpr double kFasterMax = 3.0;
  constexpr double kSlackM = 0.05;
  if (last_) {
    const std::int64_t since_us = at_us - last_us_;
    const bool is_time =
        since_us > 0 && std::abs(since_us - (arrival_us - last_arrival_us_)) <= kOffMaxUs;
    const double moved_max_m =
        kFasterMax * params_.wheel_speed_max_m_s * 1e-6 * static_cast<double>(since_us) + kSlackM;
    if (!is_time || odometry_.moved_m(state.left_ticks, state.right_ticks) > moved_max_m) {
      if (++implausible_ <= kImplausibleMax) return false;
      forget();
    }
  }
  implausible_ = 0;
  return true;
}

std::optional<BaseReading> BaseSerial::process(const BaseState& state, const BaseFrame& frame) {
  bauds_.found();
  was_searched_ = false;
  is_receiving_ = true;
  received_us_ = frame.end_us;
  if (state.is_new && is_known_) {
    is_known_ = false;
    forget();
    send_hello(frame.end_us);
  }
  if (!is_known_ || !accept(state, device_us(state.clock_us), frame.end_us)) return std::nullopt;
  const std::int64_t at_us = device_us(state.clock_us);
  watch_damage(state, frame.end_us);
  if (!last_ || state.drive_sequence != last_->drive_sequence) obeyed_us_ = frame.end_us;
  is_obeyed_ = frame.end_us - obeyed_us_ < kObeyedTimeoutUs;
  last_ = state;
  last_us_ = at_us;
  last_arrival_us_ = frame.end_us;
  clock_.add_arrival(at_us, frame.end_us);
  odometry_.add(at_us, state.left_ticks, state.right_ticks);

  const double line_us = static_cast<double>(frame.bytes) * byte_us();
  const std::int64_t utime = clock_.utime(at_us, line_us) - std::llround(1000.0 * params_.delay_ms);
  constexpr double kStandsM_S = 0.02;  // below, the ticks do not tell a curvature
  constexpr double kCurvatureMax = 10.0;
  const double speed = odometry_.speed_m_s();
  const double curvature =
      std::abs(speed) < kStandsM_S
          ? 0.0
          : std::clamp(odometry_.yaw_rate_rad_s() / speed, -kCurvatureMax, kCurvatureMax);
  const double volts = 0.001 * state.battery_mv;
  const double share =
      (volts - params_.battery_empty_v) / (params_.battery_full_v - params_.battery_empty_v);
  return BaseReading{{utime, odometry_.T_wheel_body()},
                     odometry_.yaw_rate_rad_s(),
                     {utime, speed, curvature, std::clamp(share, 0.0, 1.0),
                      state.is_stopped || state.emergency_switch || orders_.stopped(frame.end_us),
                      state.is_expired || orders_.expired(frame.end_us)}};
}

/// Of the frames to the base, by its own count.
void BaseSerial::watch_damage(const BaseState& state, std::int64_t now_us) {
  if (now_us - damage_us_ < kDamageIntervalUs) return;
  const auto damaged = static_cast<std::uint16_t>(state.damaged - damaged_);
  damaged_share_ = last_ && sent_ > 0 ? static_cast<double>(damaged) / sent_ : 0.0;
  damaged_ = state.damaged;
  damage_us_ = now_us;
  sent_ = 0;
}

DeviceProtocol::LineCounts BaseSerial::line_counts() const {
  return {decoder_.counts().frames, decoder_.counts().corrupt};
}

std::string BaseSerial::problem() const {
  if (!is_receiving_) {
    return fmt::format("{}searching the base at {} baud",
                       was_searched_ ? "no answer at any baud rate: " : "", bauds_.current());
  }
  if (!is_known_ && other_version_) {
    return fmt::format("the base speaks version {} of the protocol, this driver version {}",
                       *other_version_, kBaseProtocolVersion);
  }
  if (!is_known_) return "the base sends, but does not answer";
  if (!is_obeyed_) return "the base sends, but receives no commands: check the line to it";
  if (last_ && last_->motor_fault) return "the base reports a fault of a motor";
  if (last_ && last_->emergency_switch) return "the emergency switch is pressed";
  if (last_ && last_->battery_mv == 0) return "the base measures no battery voltage";
  if (damaged_share_ > kDamagedShareMax) {
    return fmt::format("{:.0f} % of the frames to the base are damaged: check the cable",
                       100.0 * damaged_share_);
  }
  return {};
}

}  // namespace adit
