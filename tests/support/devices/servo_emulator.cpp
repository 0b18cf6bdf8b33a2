// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/devices/servo_emulator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace adit {
namespace {

constexpr std::int64_t kReturnDelayUs = 500;  // register 9: 250 times 2 µs
constexpr std::int64_t kStepUs = 500;
constexpr std::size_t kSamples = 1000;

/// By a table, as in the e-manual's update_crc.
std::uint16_t update_crc(const std::vector<std::uint8_t>& bytes, std::size_t count) {
  std::array<std::uint16_t, 256> table{};
  for (unsigned i = 0; i < table.size(); ++i) {
    unsigned value = i << 8;
    for (int bit = 0; bit < 8; ++bit) value = value & 0x8000 ? value * 2 ^ 0x8005 : value * 2;
    table[i] = static_cast<std::uint16_t>(value);
  }
  std::uint16_t crc = 0;
  for (std::size_t i = 0; i < count; ++i) {
    crc = static_cast<std::uint16_t>(crc << 8 ^ table[(crc >> 8 ^ bytes[i]) & 0xFF]);
  }
  return crc;
}

}  // namespace

template <class Number>
void ServoEmulator::set(std::size_t address, Number number) {
  for (std::size_t i = 0; i < sizeof number; ++i) {
    table_[address + i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(number) >> 8 * i);
  }
}

std::int32_t ServoEmulator::get(std::size_t address) const {
  return static_cast<std::int32_t>(table_[address] + 256U * table_[address + 1] +
                                   65536U * table_[address + 2] + 16777216U * table_[address + 3]);
}

void ServoEmulator::boot(std::int64_t utime) {
  table_.fill(0);
  set<std::uint16_t>(0, 1060);
  table_[6] = 45;  // firmware
  table_[7] = params_.id;
  table_[9] = 250;
  table_[11] = params_.operating_mode;
  set(48, params_.position_max);
  set(52, params_.position_min);
  table_[68] = params_.status_return_level;
  set(116, static_cast<std::int32_t>(std::lround(position_)));
  is_on_ = true;
  power_on_us_ = utime;
  moved_us_ = utime;
  velocity_ = 0.0;
  input_.clear();
  line_.clear();
}

void ServoEmulator::power_on(std::int64_t utime) {
  boot(utime);
  booted_us_ = utime + std::llround(1e6 * params_.boot_s);
}

void ServoEmulator::power_off() {
  is_on_ = false;
  line_.clear();
}

void ServoEmulator::already_holds(std::int64_t utime, std::int32_t position) {
  position_ = position;
  boot(utime);
  booted_us_ = utime;
  table_[64] = 1;
}

void ServoEmulator::fail(std::uint8_t hardware_error) {
  table_[70] = hardware_error;
  table_[64] = 0;
}

void ServoEmulator::receive(std::span<const std::uint8_t> bytes, int host_baud,
                            std::int64_t utime) {
  if (bytes.empty()) return;
  double at_us = static_cast<double>(std::max(utime, input_free_us_));
  std::vector<std::uint8_t> echo;
  for (const std::uint8_t byte : bytes) {
    if (params_.line_has_time) at_us += byte_us();
    const bool is_same_rate = host_baud == params_.baud;
    input_.push_back(
        {std::llround(at_us), is_same_rate ? byte : static_cast<std::uint8_t>(random_())});
    if (params_.line_echoes) line_.push_back({std::llround(at_us), byte});
  }
  input_free_us_ = std::llround(at_us);
  if (!is_on_) input_.clear();
}

/// Executes what has arrived.
void ServoEmulator::process_input() {
  const auto at = [this](std::size_t i) { return input_[i].byte; };
  while (input_.size() >= 10) {
    if (at(0) != 0xFF || at(1) != 0xFF || at(2) != 0xFD || at(3) != 0) {
      input_.pop_front();
      continue;
    }
    const std::size_t length = at(5) + 256U * at(6);
    if (length < 3 || length > 100) {
      input_.pop_front();
      continue;
    }
    if (input_.size() < 7 + length) return;
    std::vector<std::uint8_t> packet;
    for (std::size_t i = 0; i < 7 + length; ++i) packet.push_back(at(i));
    const std::int64_t utime = input_[6 + length].utime;
    const auto crc = update_crc(packet, 5 + length);
    if (packet[5 + length] + 256U * packet[6 + length] != crc) {
      input_.pop_front();
      continue;
    }
    input_.erase(input_.begin(), input_.begin() + static_cast<std::ptrdiff_t>(7 + length));
    std::vector<std::uint8_t> content(packet.begin() + 7, packet.end() - 2);
    for (std::size_t i = 3; i < content.size(); ++i) {  // remove what was inserted
      if (content[i - 3] == 0xFF && content[i - 2] == 0xFF && content[i - 1] == 0xFD) {
        content.erase(content.begin() + static_cast<std::ptrdiff_t>(i));
      }
    }
    if (packet[4] != params_.id || utime < booted_us_) continue;
    move(utime);
    execute(content[0], std::span(content).subspan(1), utime);
  }
}

void ServoEmulator::execute(std::uint8_t instruction, std::span<const std::uint8_t> parameters,
                            std::int64_t utime) {
  if (instruction == 0x01) {
    answer(0, std::array{table_[0], table_[1], table_[6]}, utime);
  } else if (instruction == 0x02 && parameters.size() == 4) {
    const std::size_t address = parameters[0] + 256U * parameters[1];
    const std::size_t length = parameters[2] + 256U * parameters[3];
    if (address + length > table_.size()) return answer(7, {}, utime);
    refresh(utime);
    if (address <= 132 && address + length >= 136) samples_.push_back({utime, position_});
    if (samples_.size() > kSamples) samples_.pop_front();
    answer(0, std::span(table_).subspan(address, length), utime);
  } else if (instruction == 0x03 && parameters.size() > 2) {
    const std::size_t address = parameters[0] + 256U * parameters[1];
    const std::uint8_t error = write(address, parameters.subspan(2));
    if (params_.status_return_level == 2) answer(error, {}, utime);
  } else {
    answer(2, {}, utime);
  }
}

/// Returns the error number.
std::uint8_t ServoEmulator::write(std::size_t address, std::span<const std::uint8_t> bytes) {
  if (address < 64 && torque()) return 7;
  if (address + bytes.size() > 120) return 7;
  const auto before = table_;
  std::ranges::copy(bytes, table_.begin() + static_cast<std::ptrdiff_t>(address));
  if (get(116) < params_.position_min || get(116) > params_.position_max) {
    table_ = before;
    return 6;
  }
  if (before[64] != 0 && table_[64] == 0) ++torque_losses_;
  if (before[64] == 0 && table_[64] != 0) {
    if (table_[70] != 0) {
      table_[64] = 0;  // not before it was switched off
    } else {
      set(116, static_cast<std::int32_t>(std::lround(position_)));
    }
  }
  return 0;
}

void ServoEmulator::answer(std::uint8_t error, std::span<const std::uint8_t> parameters,
                           std::int64_t utime) {
  std::vector<std::uint8_t> content{
      0x55, static_cast<std::uint8_t>(error | (table_[70] != 0 ? 0x80 : 0))};
  for (const std::uint8_t byte : parameters) {
    content.push_back(byte);
    const std::size_t n = content.size();
    if (n >= 3 && content[n - 3] == 0xFF && content[n - 2] == 0xFF && content[n - 1] == 0xFD) {
      content.push_back(0xFD);
    }
  }
  const std::size_t length = content.size() + 2;
  std::vector<std::uint8_t> packet{0xFF,
                                   0xFF,
                                   0xFD,
                                   0x00,
                                   params_.id,
                                   static_cast<std::uint8_t>(length),
                                   static_cast<std::uint8_t>(length >> 8)};
  packet.insert(packet.end(), content.begin(), content.end());
  const auto crc = update_crc(packet, packet.size());
  packet.push_back(static_cast<std::uint8_t>(crc));
  packet.push_back(static_cast<std::uint8_t>(crc >> 8));
  put(utime + kReturnDelayUs, packet);
}

void ServoEmulator::put(std::int64_t at_us, std::span<const std::uint8_t> bytes) {
  double byte_end_us = static_cast<double>(at_us);
  for (const std::uint8_t byte : bytes) {
    byte_end_us += byte_us();
    line_.push_back({std::llround(byte_end_us), byte});
  }
}

double ServoEmulator::rate_max_ticks_s() const {
  return get(112) == 0 ? 4000.0 : get(112) * 0.229 / 60.0 * 4096.0;
}

/// Towards the goal by the profile: velocity in 0.229 rev/min, acceleration in 214.577 rev/min².
void ServoEmulator::move(std::int64_t until) {
  while (moved_us_ + kStepUs <= until) {
    moved_us_ += kStepUs;
    if (params_.moved_position) {
      const double before = position_;
      position_ = params_.moved_position(moved_us_);
      velocity_ = (position_ - before) / (1e-6 * kStepUs);
      continue;
    }
    if (!torque()) {
      velocity_ = 0.0;
      continue;
    }
    constexpr double kStepS = 1e-6 * kStepUs;
    const double rate_max = rate_max_ticks_s();
    const double acceleration = get(108) == 0 ? 1e6 : get(108) * 214.577 / 3600.0 * 4096.0;
    const double left = get(116) - position_;
    const double rate_to_stop = std::sqrt(2.0 * acceleration * std::abs(left));
    const double wanted = std::copysign(std::min(rate_max, rate_to_stop), left);
    velocity_ += std::clamp(wanted - velocity_, -acceleration * kStepS, acceleration * kStepS);
    if (std::abs(left) <= std::abs(velocity_) * kStepS || std::abs(left) < 1e-3) {
      position_ = get(116);
      velocity_ = 0.0;
    } else {
      position_ += velocity_ * kStepS;
    }
  }
}

/// The registers that it measures.
void ServoEmulator::refresh(std::int64_t utime) {
  const double ms = params_.clock_start_ms +
                    1e-3 * static_cast<double>(utime - power_on_us_) * params_.clock_rate;
  set(120, static_cast<std::uint16_t>(std::fmod(ms, 32768.0)));
  set(128, static_cast<std::int32_t>(std::lround(velocity_ / 4096.0 * 60.0 / 0.229)));
  set(132, static_cast<std::int32_t>(std::lround(position_)));
}

std::vector<TimedByte> ServoEmulator::advance(std::int64_t utime, int host_baud) {
  if (!is_on_) return {};
  while (!input_.empty() && input_.size() >= 10 && input_.back().utime <= utime) {
    const std::size_t before = input_.size();
    process_input();
    if (input_.size() == before) break;
  }
  move(utime);
  std::vector<TimedByte> sent = take_due(line_, utime);
  if (host_baud != params_.baud) garble(sent, random_);
  return sent;
}

}  // namespace adit
