// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/tilt/tilt_node.hpp"

#include <vector>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/sensing.hpp"

namespace adit {

TiltNode::TiltNode(Bus& bus, const std::string& section, const Params& params)
    : bus_(bus),
      channel_(section.ends_with("_rear") ? channels::kTiltRear : channels::kTiltFront),
      servo_(params),
      node_(bus,
            {.name = section,
             .address = params.device,
             .readings = "tilts",
             .tick_us = TiltServo::kTickUs},
            servo_, [this](std::span<const std::uint8_t> bytes, std::int64_t now_us) {
              return receive(bytes, now_us);
            }) {
  const bool is_rear = channel_ == channels::kTiltRear;
  subscribe<tilt_command_t>(
      bus_, is_rear ? channels::kTiltCommandRear : channels::kTiltCommandFront, Delivery::latest(),
      [this](const TiltCommand& command) { servo_.command(command); });
}

std::size_t TiltNode::receive(std::span<const std::uint8_t> bytes, std::int64_t now_us) {
  std::vector<TiltReading> readings = servo_.receive(bytes, now_us);
  for (TiltReading& reading : readings) {
    reading.utime += DeviceNode::to_wall_us();
    publish(bus_, channel_, to_message(reading));
  }
  return readings.size();
}

}  // namespace adit
