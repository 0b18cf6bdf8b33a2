// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "drivers/device/device_node.hpp"
#include "drivers/tilt/servo.hpp"

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"

namespace adit {

/// In:  TILT_COMMAND_FRONT or TILT_COMMAND_REAR (tilt_command_t).
/// Out: TILT_FRONT or TILT_REAR (tilt_t), 50 Hz.
class TiltNode {
 public:
  using Params = TiltServoParams;

  /// `section`: tilt_front or tilt_rear. Throws as TiltServo and DeviceNode do.
  TiltNode(Bus& bus, const std::string& section, const Params& params);

  [[nodiscard]] Health health() const { return node_.health(); }

 private:
  std::size_t receive(std::span<const std::uint8_t> bytes, std::int64_t now_us);

  Bus& bus_;
  std::string_view channel_;
  TiltServo servo_;
  DeviceNode node_;
};

}  // namespace adit
