// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/device/device_protocol.hpp"
#include "drivers/ports/reconnecting_port.hpp"

#include "common/bus/bus.hpp"
#include "common/bus/node/run_node.hpp"
#include "common/messages/diagnostics.hpp"

namespace adit {

/// Connects the protocol of a device with its port and the clock of the computer. The node of a
/// driver has one, and publishes the readings.
class DeviceNode {
 public:
  struct Options {
    std::string name;               ///< section of the configuration, for what is printed
    std::string address;            ///< of the port
    std::string readings;           ///< what they are called, "scans"
    std::int64_t tick_us = 50'000;  ///< period of DeviceProtocol::tick
    std::int64_t gap_us = 500'000;  ///< between two readings; longer ones are reported
  };

  /// Passes bytes to the protocol and publishes what it returns. Returns the number of readings.
  using Receive =
      std::function<std::size_t(std::span<const std::uint8_t> bytes, std::int64_t now_us)>;

  /// `bus` and `device` must outlive this. Throws as ReconnectingPort does.
  DeviceNode(Bus& bus, Options options, DeviceProtocol& device, Receive receive);
  DeviceNode(const DeviceNode&) = delete;
  DeviceNode& operator=(const DeviceNode&) = delete;

  /// Sends what the device wants now, not at the next tick.
  void obey();

  /// To be added to a time by the monotonic clock, in which readings are stamped, so that a clock
  /// that is set moves the stamps but not the filter behind them [µs].
  static std::int64_t to_wall_us();

  /// Fault while there are no readings. Degraded while the device reports a fault, after a share of
  /// its messages was damaged, and for a minute after a gap.
  [[nodiscard]] Health health() const;

 private:
  void poll();
  void receive();
  void report_gaps(std::int64_t now_us);
  void watch_line(std::int64_t now_us);

  Options options_;
  DeviceProtocol& device_;
  Receive receive_;
  ReconnectingPort port_;
  std::optional<std::int64_t> last_reading_us_;
  bool is_lost_ = false;                    ///< reported so
  std::optional<std::int64_t> gap_end_us_;  ///< of the last gap
  double gap_s_ = 0.0;
  std::int64_t gaps_ = 0;
  std::int64_t line_us_ = 0;  ///< when line_counts_ were taken
  DeviceProtocol::LineCounts line_counts_;
  double corrupt_share_ = 0.0;  ///< of the messages in the last interval
};

/// The `main` of a driver that runs once for each device of a kind, with the section
/// `<driver>_<device>` of the configuration, where the first argument names the device. A node has
///   using Params = ...;  // visited as in common/config
///   Node(Bus& bus, const std::string& section, const Params& params);
///   Health health() const;
template <class Node>
int run_device_driver(const std::string& driver, const std::vector<std::string>& devices, int argc,
                      char** argv) {
  struct Named {
    struct Params : Node::Params {
      std::string section;
    };
    Named(Bus& bus, const Params& params) : node(bus, params.section, params) {}
    [[nodiscard]] Health health() const { return node.health(); }

    Node node;
  };
  const auto configure = [](const ConfigFile& file, const std::string& section) {
    typename Named::Params params{load_section<typename Node::Params>(file, section), section};
    const std::string yaml = to_yaml<typename Node::Params>(params, section);
    return configured_node<Named>(section, yaml, params);
  };
  return run_stage(driver, devices, configure, argc, argv);
}

}  // namespace adit
