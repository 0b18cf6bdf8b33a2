// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "drivers/device/device_node.hpp"
#include "drivers/laser/laser_device.hpp"

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"

namespace adit {

/// Connects a laser with its port and the bus.
/// Out: LASER_FRONT or LASER_REAR (planar_lidar_t), each scan as soon as it is complete; LIDAR
/// (spinning_lidar_t) of a spinning lidar, in fragments.
class LaserDeviceNode {
 public:
  /// `name` of the section of the configuration, for what is printed: losses and returns of the
  /// laser. Throws as ReconnectingPort does.
  LaserDeviceNode(Bus& bus, std::string name, const std::string& address, LaserId laser,
                  std::unique_ptr<LaserDevice> device);
  LaserDeviceNode(const LaserDeviceNode&) = delete;
  LaserDeviceNode& operator=(const LaserDeviceNode&) = delete;

  [[nodiscard]] Health health() const { return node_.health(); }

 private:
  std::size_t receive(std::span<const std::uint8_t> bytes, std::int64_t now_us);

  Bus& bus_;
  LaserId laser_;
  std::unique_ptr<LaserDevice> device_;
  DeviceNode node_;
};

/// The `main` of the driver of a laser of the class `Laser`: runs it for the laser of the first
/// argument, front or rear, with the section `<driver>_<laser>` of the configuration. `Laser` has
///   using Params = ...;                      // visited as in common/config, with `device`
///   Laser(const Params& params, LaserId laser);
template <class Laser>
int run_laser_driver(const std::string& driver, int argc, char** argv) {
  struct Node {
    using Params = typename Laser::Params;
    Node(Bus& bus, const std::string& section, const Params& params)
        : laser(section.ends_with("_rear") ? LaserId::kRear : LaserId::kFront),
          node(bus, section, params.device, laser, std::make_unique<Laser>(params, laser)) {}
    [[nodiscard]] Health health() const { return node.health(); }

    LaserId laser;
    LaserDeviceNode node;
  };
  return run_device_driver<Node>(driver, {"front", "rear"}, argc, argv);
}

}  // namespace adit
