// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/imu_vectornav/imu_vectornav_node.hpp"

#include <vector>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/sensing.hpp"

namespace adit {

ImuVectorNavNode::ImuVectorNavNode(Bus& bus, const Params& params)
    : bus_(bus),
      imu_(params),
      node_(bus, {.name = "imu_vectornav", .address = params.device, .readings = "readings"}, imu_,
            [this](std::span<const std::uint8_t> bytes, std::int64_t now_us) {
              return receive(bytes, now_us);
            }) {}

std::size_t ImuVectorNavNode::receive(std::span<const std::uint8_t> bytes, std::int64_t now_us) {
  std::vector<ImuReading> readings = imu_.receive(bytes, now_us);
  for (ImuReading& reading : readings) {
    reading.utime += DeviceNode::to_wall_us();
    publish(bus_, channels::kImu, to_message(reading));
  }
  return readings.size();
}

}  // namespace adit
