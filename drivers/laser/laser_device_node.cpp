// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/laser/laser_device_node.hpp"

#include <utility>
#include <vector>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/lidar.hpp"
#include "common/messages/sensing.hpp"

namespace adit {

LaserDeviceNode::LaserDeviceNode(Bus& bus, std::string name, const std::string& address,
                                 LaserId laser, std::unique_ptr<LaserDevice> device)
    : bus_(bus),
      laser_(laser),
      device_(std::move(device)),
      node_(bus, {.name = std::move(name), .address = address, .readings = "scans"}, *device_,
            [this](std::span<const std::uint8_t> bytes, std::int64_t now_us) {
              return receive(bytes, now_us);
            }) {}

std::size_t LaserDeviceNode::receive(std::span<const std::uint8_t> bytes, std::int64_t now_us) {
  std::vector<LaserScan> scans = device_->receive(bytes, now_us);
  const std::int64_t to_wall_us = DeviceNode::to_wall_us();
  for (LaserScan& scan : scans) {
    scan.utime += to_wall_us;
    publish(bus_, laser_channel(laser_), to_message(scan));
  }
  for (LidarRevolution& revolution : device_->take_revolutions()) {
    revolution.utime += to_wall_us;
    for (const LidarFragment& fragment : split(revolution)) {
      publish(bus_, channels::kLidar, to_message(fragment));
    }
  }
  return scans.size();
}

}  // namespace adit
