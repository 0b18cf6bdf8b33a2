// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/base_serial/base_serial.hpp"
#include "drivers/device/device_node.hpp"

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"

namespace adit {

/// In:  DRIVE_COMMAND (drive_command_t), STOP (stop_t), passed on to the base at once. With a key
///      the bus checks their seals.
/// Out: WHEEL_ODOMETRY (wheel_odometry_t), VEHICLE_STATE (vehicle_state_t), per state of the base.
class BaseSerialNode {
 public:
  using Params = BaseSerialParams;

  /// Throws as BaseSerial and DeviceNode do.
  BaseSerialNode(Bus& bus, const Params& params);

  [[nodiscard]] Health health() const { return node_.health(); }

 private:
  std::size_t receive(std::span<const std::uint8_t> bytes, std::int64_t now_us);
  template <class Order>
  void obey(const Order& order);

  Bus& bus_;
  BaseSerial base_;
  DeviceNode node_;
};

}  // namespace adit
