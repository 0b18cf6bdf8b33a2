// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/laser/laser_device_node.hpp"

#include <utility>
#include <vector>

#include "common/bus/typed_messages.hpp"
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
  for (LaserScan& scan : scans) {
    scan.utime += DeviceNode::to_wall_us();
    publish(bus_, laser_channel(laser_), to_message(scan));
  }
  return scans.size();
}

}  // namespace adit
