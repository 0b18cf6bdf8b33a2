// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/devices/base_emulator.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr std::int64_t kStepUs = 1000;
constexpr std::int64_t kStateUs = 20'000;
constexpr std::int64_t kWatchdogUs = 250'000;
constexpr std::size_t kHistory = 5000;

/// CRC-16/CCITT by nibbles, as microcontrollers without a table of 512 bytes do.
std::uint16_t crc_of(std::span<const std::uint8_t> bytes) {
  static constexpr std::uint16_t kNibbles[16] = {0x0000, 0x1021, 0x2042, 0x3063, 0x4084, 0x50A5,
                                                 0x60C6, 0x70E7, 0x8108, 0x9129, 0xA14A, 0xB16B,
                                                 0xC18C, 0xD1AD, 0xE1CE, 0xF1EF};
  std::uint16_t crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    for (const int nibble : {byte >> 4, byte & 15}) {
      crc = static_cast<std::uint16_t>(crc << 4 ^ kNibbles[(crc >> 12 ^ nibble) & 15]);
    }
  }
  return crc;
}

template <class Number>
void put(std::vector<std::uint8_t>& bytes, Number number) {
  for (std::size_t i = 0; i < sizeof number; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(number) >> 8 * i));
  }
}

std::uint32_t get32(std::span<const std::uint8_t> bytes, std::size_t at) {
  return bytes[at] + 256U * bytes[at + 1] + 65536U * bytes[at + 2] + 16777216U * bytes[at + 3];
}

}  // namespace

void BaseEmulator::power_on(std::int64_t utime) {
  is_on_ = true;
  is_new_ = true;
  is_expired_ = true;
  brakes_ = false;
  power_on_us_ = utime;
  booted_us_ = utime + std::llround(1e6 * params_.boot_s);
  now_us_ = utime;
  next_state_us_ = booted_us_;
  last_drive_us_ = utime - kWatchdogUs;
  targets_ = {};
  speeds_ = {};
  ticks_ = {};
  history_.clear();
  damaged_ = 0;
  input_.clear();
  line_.clear();
  line_free_us_ = utime;
}

void BaseEmulator::power_off() {
  is_on_ = false;
  line_.clear();
}

void BaseEmulator::already_streams(std::int64_t utime) {
  power_on(utime);
  booted_us_ = utime;
  next_state_us_ = utime;
  is_new_ = false;
}

std::uint32_t BaseEmulator::clock_at(std::int64_t utime) const {
  const auto since = std::llround(static_cast<double>(utime - power_on_us_) * params_.clock_rate);
  return static_cast<std::uint32_t>(params_.clock_start_us + static_cast<std::uint64_t>(since));
}

std::array<double, 2> BaseEmulator::ticks_at(std::int64_t utime) const {
  const auto after = std::ranges::find_if(
      history_, [utime](const auto& sample) { return sample[0] >= static_cast<double>(utime); });
  if (after == history_.end()) return ticks_;
  if (after == history_.begin()) return {(*after)[1], (*after)[2]};
  const auto& before = *(after - 1);
  const double share = (static_cast<double>(utime) - before[0]) / ((*after)[0] - before[0]);
  return {before[1] + share * ((*after)[1] - before[1]),
          before[2] + share * ((*after)[2] - before[2])};
}

void BaseEmulator::receive(std::span<const std::uint8_t> bytes, int host_baud, std::int64_t utime) {
  if (!is_on_ || utime < booted_us_) return;
  for (const std::uint8_t byte : bytes) {
    input_.push_back(host_baud == params_.baud ? byte : static_cast<std::uint8_t>(random_()));
  }
  read_input(utime);
}

void BaseEmulator::read_input(std::int64_t utime) {
  while (input_.size() >= 7) {
    const std::size_t length = input_[3];
    if (input_[0] != 0xA5 || input_[1] != 0x5A || length > 32) {
      input_.erase(input_.begin());
      continue;
    }
    if (input_.size() < 7 + length) return;
    const auto crc = crc_of(std::span(input_).subspan(2, 3 + length));
    if (input_[5 + length] + 256U * input_[6 + length] != crc) {
      ++damaged_;
      input_.erase(input_.begin());
      continue;
    }
    execute(std::span(input_).first(5 + length), utime);
    input_.erase(input_.begin(), input_.begin() + static_cast<std::ptrdiff_t>(7 + length));
  }
}

void BaseEmulator::execute(std::span<const std::uint8_t> frame, std::int64_t utime) {
  const std::uint8_t sequence = frame[4];
  const auto payload = frame.subspan(5);
  if (frame[2] == 0x01 && payload.size() == 1) {
    if (payload[0] == params_.version) is_new_ = false;
    std::vector<std::uint8_t> info{params_.version};
    put(info, clock_at(utime));
    put(info, sequence);
    send(0x81, info, utime);
  } else if (frame[2] == 0x02 && payload.size() == 17 && !is_new_) {
    brakes_ = (payload[0] & 1) != 0;
    targets_ = {static_cast<std::int32_t>(get32(payload, 1)),
                static_cast<std::int32_t>(get32(payload, 5))};
    acceleration_ = get32(payload, 9);
    braking_ = get32(payload, 13);
    last_drive_us_ = utime;
    drive_sequence_ = sequence;
    is_expired_ = false;
    ++drives_;
  }
}

void BaseEmulator::step(std::int64_t utime) {
  if (utime - last_drive_us_ >= kWatchdogUs) is_expired_ = true;
  if (params_.moved_ticks) {
    ticks_ = params_.moved_ticks(utime);
  } else {
    move();
  }
  history_.push_back({static_cast<double>(utime), ticks_[0], ticks_[1]});
  if (history_.size() > kHistory) history_.pop_front();
}

/// By its own motors.
void BaseEmulator::move() {
  constexpr double kStepS = 1e-6 * kStepUs;
  const bool stands = is_expired_ || brakes_ || emergency_switch || motor_fault;
  const double left = (stands ? 0.0 : targets_[0]) - speeds_[0];
  const double right = (stands ? 0.0 : targets_[1]) - speeds_[1];
  const auto faster = [](double a, double b) { return std::max(std::abs(a), std::abs(b)); };
  const bool slower = stands || faster(targets_[0], targets_[1]) < faster(speeds_[0], speeds_[1]);
  const double change_max = (slower ? braking_ : acceleration_) * kStepS;
  const double share = std::min(1.0, change_max / std::max(1e-9, faster(left, right)));
  speeds_ = {speeds_[0] + share * left, speeds_[1] + share * right};
  ticks_[0] += speeds_[0] * kStepS;
  ticks_[1] += speeds_[1] * kStepS;
}

void BaseEmulator::send_state(std::int64_t utime) {
  std::vector<std::uint8_t> state;
  put(state, clock_at(utime));
  for (const double ticks : ticks_) {
    put(state, static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(ticks)) +
                                          params_.ticks_start));
  }
  put(state, params_.battery_mv);
  put(state, damaged_);
  put(state, drive_sequence_);
  state.push_back(static_cast<std::uint8_t>((brakes_ ? 1 : 0) + (is_expired_ ? 2 : 0) +
                                            (emergency_switch ? 4 : 0) + (motor_fault ? 8 : 0) +
                                            (is_new_ ? 16 : 0)));
  send(0x82, state, utime);
}

void BaseEmulator::send(std::uint8_t type, std::vector<std::uint8_t> payload, std::int64_t utime) {
  std::vector<std::uint8_t> frame{0xA5, 0x5A, type, static_cast<std::uint8_t>(payload.size()),
                                  sequence_++};
  frame.insert(frame.end(), payload.begin(), payload.end());
  put(frame, crc_of(std::span(frame).subspan(2)));
  double at_us = static_cast<double>(std::max(utime, line_free_us_));
  for (const std::uint8_t byte : frame) {
    at_us += 1e7 / params_.baud;
    line_.push_back({std::llround(at_us), byte});
  }
  line_free_us_ = std::llround(at_us);
}

std::vector<TimedByte> BaseEmulator::advance(std::int64_t utime, int host_baud) {
  if (!is_on_) return {};
  while (now_us_ + kStepUs <= utime) {
    now_us_ += kStepUs;
    step(now_us_);
    if (now_us_ >= booted_us_ && now_us_ >= next_state_us_) {
      send_state(now_us_);
      next_state_us_ += kStateUs;
    }
  }
  std::vector<TimedByte> sent = take_due(line_, utime);
  if (host_baud != params_.baud) garble(sent, random_);
  return sent;
}

}  // namespace adit
