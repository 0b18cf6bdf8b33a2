// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/drive/live_drive.hpp"

#include <array>
#include <iostream>
#include <stdexcept>
#include <vector>

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include "common/bus/channels.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/bus/node/stop_signal.hpp"
#include "common/bus/order_seal.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/config/config.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sim.hpp"
#include "sim/drive/waypoint_file.hpp"
#include "sim/live/sim_config.hpp"
#include "sim/waypoint_driver_node.hpp"
#include "tools/drive/key_driver.hpp"

namespace adit {
namespace {

/// Reads keys without echo and without Enter. The destructor restores the terminal. Throws
/// std::runtime_error if standard input is not a terminal.
class TerminalKeys {
 public:
  TerminalKeys();
  ~TerminalKeys();
  TerminalKeys(const TerminalKeys&) = delete;
  TerminalKeys& operator=(const TerminalKeys&) = delete;

  /// The keys since the last call; does not block.
  std::vector<DriveKey> pressed();

 private:
  termios before_{};
  KeyReader reader_;
};

TerminalKeys::TerminalKeys() {
  if (tcgetattr(STDIN_FILENO, &before_) != 0) {
    throw std::runtime_error("standard input is not a terminal, so there are no keys");
  }
  termios raw = before_;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  tcsetattr(STDIN_FILENO, TCSANOW, &raw);
}

TerminalKeys::~TerminalKeys() { tcsetattr(STDIN_FILENO, TCSANOW, &before_); }

std::vector<DriveKey> TerminalKeys::pressed() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (poll(&input, 1, 0) <= 0) return {};
  std::array<char, 64> bytes{};
  const ssize_t count = read(STDIN_FILENO, bytes.data(), bytes.size());
  if (count <= 0) return {DriveKey::kQuit};  // the terminal is closed
  return reader_.read({bytes.data(), static_cast<std::size_t>(count)});
}

constexpr std::int64_t kCommandPeriodUs = 50'000;
constexpr int kListenMs = 20;

Vehicle vehicle_in(const std::filesystem::path& config) {
  return load_section<Vehicle>(load_config(config), Vehicle::kSection);
}

LcmBusOptions bus_options(const LiveDriveOptions& options) {
  LcmBusOptions bus;
  bus.url = options.lcm_url;
  bus.seal = SealParams{options.key}.read();
  return bus;
}

/// TRUTH comes from a simulator, which may wait for this driver as for a stage.
LcmBusOptions answering_bus_options(const LiveDriveOptions& options) {
  LcmBusOptions bus = bus_options(options);
  bus.time = BusTime::kSimulated;
  bus.stage = "drive";
  return bus;
}

std::string failure_of(const WaypointDriver& driver, const std::string& run_failure) {
  return run_failure.empty() ? driver.abort_reason().value_or("") : run_failure;
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
    const DriveCommand requested = driver.command(simulated_utime.value_or(utime));
    publish(bus, channels::kDriveCommand, to_message(requested));
  };
  bus.create_timer(kCommandPeriodUs, command);
  std::cerr << "arrows or w a s d: drive, space: stop, q: quit\n";
  while (!driver.quits() && !stop.received()) {
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
  while (!node.driver().done() && !stop.received()) {
    bus.handle(kListenMs);
    const std::string failure = failure_of(node.driver(), run_failure);
    if (!failure.empty()) throw std::runtime_error(failure);
  }
}

}  // namespace adit
