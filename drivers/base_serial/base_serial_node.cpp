// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/base_serial/base_serial_node.hpp"

#include <vector>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "common/service/wall_time.hpp"

namespace adit {

BaseSerialNode::BaseSerialNode(Bus& bus, const Params& params)
    : bus_(bus),
      base_(params),
      node_(bus, {.name = "base_serial", .address = params.device, .readings = "states"}, base_,
            [this](std::span<const std::uint8_t> bytes, std::int64_t now_us) {
              return receive(bytes, now_us);
            }) {
  subscribe<drive_command_t>(bus_, channels::kDriveCommand, Delivery::latest(),
                             [this](const DriveCommand& command) { obey(command); });
  // Not the latest alone: a stop that a release follows at once is obeyed as well.
  constexpr std::size_t kStopQueueSize = 20;
  subscribe<stop_t>(bus_, channels::kStop, Delivery::queued(kStopQueueSize),
                    [this](const StopOrder& order) { obey(order); });
}

template <class Order>
void BaseSerialNode::obey(const Order& order) {
  base_.obey(order, bus_.now_utime(), steady_us());
  node_.obey();
}

std::size_t BaseSerialNode::receive(std::span<const std::uint8_t> bytes, std::int64_t now_us) {
  std::vector<BaseReading> readings = base_.receive(bytes, now_us);
  const std::int64_t to_wall_us = DeviceNode::to_wall_us();
  for (BaseReading& reading : readings) {
    reading.odometry.utime += to_wall_us;
    reading.state.utime += to_wall_us;
    wheel_odometry_t odometry = to_message(reading.odometry);
    odometry.forward_m_s = reading.state.speed_m_s;
    odometry.yaw_rate_rad_s = reading.yaw_rate_rad_s;
    publish(bus_, channels::kWheelOdometry, odometry);
    publish(bus_, channels::kVehicleState, to_message(reading.state));
  }
  return readings.size();
}

}  // namespace adit
