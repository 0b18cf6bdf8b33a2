// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "drivers/laser/laser_device.hpp"
#include "drivers/ports/reconnecting_port.hpp"

#include "common/bus/bus.hpp"
#include "common/bus/node/run_node.hpp"
#include "common/messages/diagnostics.hpp"

namespace adit {

/// Connects a laser with its port and the bus.
/// Out: LASER_FRONT or LASER_REAR (planar_lidar_t), each scan as soon as it is complete; LIDAR
/// (spinning_lidar_t) of a spinning lidar, in fragments.
/// Scans are stamped with the clock of this computer, of which a monotonic one is the measure, so
/// that a clock that is set moves the stamps but not the filter behind them.
class LaserDeviceNode {
 public:
  /// `name` of the section of the configuration, for what is printed: losses and returns of the
  /// laser. Throws as ReconnectingPort does.
  LaserDeviceNode(Bus& bus, std::string name, const std::string& address, LaserId laser,
                  std::unique_ptr<LaserDevice> device);
  LaserDeviceNode(const LaserDeviceNode&) = delete;
  LaserDeviceNode& operator=(const LaserDeviceNode&) = delete;

  /// Fault while there are no scans. Degraded while the laser reports a fault, after a share of its
  /// messages was damaged, and for a minute after a gap.
  [[nodiscard]] Health health() const;

 private:
  void poll();
  void receive(std::int64_t now_us);
  void obey();
  void report_gaps(std::int64_t now_us);
  void watch_line(std::int64_t now_us);

  Bus& bus_;
  std::string name_;
  LaserId laser_;
  ReconnectingPort port_;
  std::unique_ptr<LaserDevice> device_;
  std::optional<std::int64_t> last_scan_us_;
  bool is_lost_ = false;                    ///< reported so
  std::optional<std::int64_t> gap_end_us_;  ///< of the last gap
  double gap_s_ = 0.0;
  std::int64_t gaps_ = 0;
  std::int64_t line_us_ = 0;  ///< when line_counts_ were taken
  LaserDevice::LineCounts line_counts_;
  double corrupt_share_ = 0.0;  ///< of the messages in the last interval
};

/// The `main` of the driver of a laser of the class `Device`: runs it for the laser of the first
/// argument, front or rear, with the section `<driver>_<laser>` of the configuration. `Device` has
///   using Params = ...;                      // visited as in common/config, with `device`
///   Device(const Params& params, LaserId laser);
template <class Device>
int run_laser_driver(const std::string& driver, int argc, char** argv) {
  struct Node {
    struct Params : Device::Params {
      std::string name;
    };
    Node(Bus& bus, const Params& params)
        : laser(params.name.ends_with("_rear") ? LaserId::kRear : LaserId::kFront),
          node(bus, params.name, params.device, laser, std::make_unique<Device>(params, laser)) {}
    [[nodiscard]] Health health() const { return node.health(); }

    LaserId laser;
    LaserDeviceNode node;
  };
  const auto configure = [](const ConfigFile& file, const std::string& stage) {
    typename Node::Params params{load_section<typename Device::Params>(file, stage), stage};
    const std::string yaml = to_yaml<typename Device::Params>(params, stage);
    return configured_node<Node>(stage, yaml, params);
  };
  return run_stage(driver, {"front", "rear"}, configure, argc, argv);
}

}  // namespace adit
