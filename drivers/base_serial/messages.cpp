// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/base_serial/messages.hpp"

#include <cstddef>

namespace adit {
namespace {

constexpr std::size_t kInfoBytes = 6;
constexpr std::size_t kStateBytes = 18;

/// Low byte first.
void append(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<std::uint8_t>(value >> shift & 0xFFU));
  }
}

std::uint32_t number_at(std::span<const std::uint8_t> payload, std::size_t offset,
                        std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    value |= static_cast<std::uint32_t>(payload[offset + i]) << 8 * i;
  }
  return value;
}

}  // namespace

std::vector<std::uint8_t> encode_payload(const BaseDrive& drive) {
  std::vector<std::uint8_t> payload{static_cast<std::uint8_t>(drive.brake ? 1 : 0)};
  append(payload, static_cast<std::uint32_t>(drive.left_ticks_s));
  append(payload, static_cast<std::uint32_t>(drive.right_ticks_s));
  append(payload, drive.acceleration_ticks_s2);
  append(payload, drive.braking_ticks_s2);
  return payload;
}

std::optional<BaseInfo> decode_info(std::span<const std::uint8_t> payload) {
  if (payload.size() != kInfoBytes) return std::nullopt;
  return BaseInfo{payload[0], number_at(payload, 1, 4), payload[5]};
}

std::optional<BaseState> decode_state(std::span<const std::uint8_t> payload) {
  if (payload.size() != kStateBytes) return std::nullopt;
  const auto flag = [flags = payload[17]](int bit) { return (flags >> bit & 1) != 0; };
  return BaseState{.clock_us = number_at(payload, 0, 4),
                   .left_ticks = static_cast<std::int32_t>(number_at(payload, 4, 4)),
                   .right_ticks = static_cast<std::int32_t>(number_at(payload, 8, 4)),
                   .battery_mv = static_cast<std::uint16_t>(number_at(payload, 12, 2)),
                   .damaged = static_cast<std::uint16_t>(number_at(payload, 14, 2)),
                   .drive_sequence = payload[16],
                   .is_stopped = flag(0),
                   .is_expired = flag(1),
                   .emergency_switch = flag(2),
                   .motor_fault = flag(3),
                   .is_new = flag(4)};
}

}  // namespace adit
