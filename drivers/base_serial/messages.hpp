// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace adit {

/// Of the protocol that this driver speaks.
inline constexpr std::uint8_t kBaseProtocolVersion = 1;

/// Types of frames: to the base, and from it.
enum class BaseFrameType : std::uint8_t {
  kHello = 0x01,
  kDrive = 0x02,
  kInfo = 0x81,
  kState = 0x82,
};

/// DRIVE: what the wheels of each side are to do, at most 250 ms.
struct BaseDrive {
  bool brake = true;  ///< a stop: the base stands whatever the speeds
  std::int32_t left_ticks_s = 0;
  std::int32_t right_ticks_s = 0;
  std::uint32_t acceleration_ticks_s2 = 0;
  std::uint32_t braking_ticks_s2 = 0;
};

std::vector<std::uint8_t> encode_payload(const BaseDrive& drive);

/// INFO: the answer to HELLO.
struct BaseInfo {
  std::uint8_t version = 0;
  std::uint32_t clock_us = 0;  ///< when HELLO was received; overflows after 71 minutes
  std::uint8_t hello_sequence = 0;
};

/// Nothing for another length.
std::optional<BaseInfo> decode_info(std::span<const std::uint8_t> payload);

/// STATE: every 20 ms.
struct BaseState {
  std::uint32_t clock_us = 0;    ///< when the encoders were read
  std::int32_t left_ticks = 0;   ///< since the base was switched on; overflow
  std::int32_t right_ticks = 0;  ///< positive forwards
  std::uint16_t battery_mv = 0;
  std::uint16_t damaged = 0;        ///< frames with a wrong CRC since the base was switched on
  std::uint8_t drive_sequence = 0;  ///< of the last DRIVE that was valid
  bool is_stopped = false;          ///< by the brake of a DRIVE
  bool is_expired = false;          ///< without a valid DRIVE for 250 ms
  bool emergency_switch = false;    ///< pressed
  bool motor_fault = false;
  bool is_new = false;  ///< no HELLO since the base was switched on
};

/// Nothing for another length.
std::optional<BaseState> decode_state(std::span<const std::uint8_t> payload);

}  // namespace adit
