// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/drive/live_drive.hpp"

#include <iostream>
#include <stdexcept>

#include "common/bus/channels.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/bus/stop_signal.hpp"
#include "common/bus/typed.hpp"
#include "common/config/config.hpp"
#include "common/messages/drive_command.hpp"
#include "common/messages/run_state.hpp"
#include "common/messages/sim_time.hpp"
#include "sim/drive/waypoint_file.hpp"
#include "sim/live/settings.hpp"
#include "sim/waypoint_driver_node.hpp"
#include "tools/drive/key_driver.hpp"
#include "tools/drive/terminal_keys.hpp"

namespace adit {
namespace {

constexpr std::int64_t kCommandPeriodUs = 50'000;
constexpr int kListenMs = 20;

Vehicle vehicle_in(const std::filesystem::path& config) {
  return load_section<Vehicle>(load_config(config), Vehicle::kSection);
}

LcmBusOptions bus_options(const LiveDriveOptions& options) {
  LcmBusOptions bus;
  bus.url = options.lcm_url;
  return bus;
}

/// TRUTH is of a simulator, and that may wait for this driver as for a stage.
LcmBusOptions answering_bus_options(const LiveDriveOptions& options) {
  LcmBusOptions bus = bus_options(options);
  bus.time = BusTime::kSimulated;
  bus.stage = "drive";
  return bus;
}

std::string failure_of(const WaypointDriver& driver, const std::string& run_failure) {
  return run_failure.empty() ? driver.given_up().value_or("") : run_failure;
}

}  // namespace

void drive_by_keys(const LiveDriveOptions& options) {
  const StopSignal stop;
  KeyDriver driver(vehicle_in(options.config));
  TerminalKeys terminal;
  LcmBus bus(bus_options(options));
  std::optional<std::int64_t> simulated_utime;
  subscribe<sim_time_t>(bus, channels::kSimTime, Delivery::latest(),
                        [&](const SimTime& time) { simulated_utime = time.utime; });
  const auto command = [&](std::int64_t utime) {
    const DriveCommand wanted = driver.command(simulated_utime.value_or(utime));
    publish(bus, channels::kDriveCommand, to_message(wanted));
  };
  bus.every(kCommandPeriodUs, command);
  std::cerr << "arrows or w a s d: drive, space: stop, q: quit\n";
  while (!driver.quits() && !stop.came()) {
    for (const DriveKey key : terminal.pressed()) driver.press(key);
    bus.handle(kListenMs);
  }
  driver.press(DriveKey::kStop);
  command(bus.now_utime());
}

void drive_by_waypoints(const LiveDriveOptions& options) {
  const StopSignal stop;
  LcmBus bus(answering_bus_options(options));
  const WaypointDriverNode node(
      bus, WaypointDriver(read_waypoints(options.waypoints), vehicle_in(options.config)));
  std::string run_failure;
  subscribe<run_state_t>(bus, channels::kRunState, Delivery::latest(),
                         [&](const RunState& state) { run_failure = state.failure; });
  while (!node.driver().done() && !stop.came()) {
    bus.handle(kListenMs);
    const std::string failure = failure_of(node.driver(), run_failure);
    if (!failure.empty()) throw std::runtime_error(failure);
  }
}

}  // namespace adit
