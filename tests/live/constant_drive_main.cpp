// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// adit-constant_drive SPEED: drives straight ahead at this speed [m/s] until SIGTERM, with a
// DRIVE_COMMAND every 50 ms of simulated time and without obstacle avoidance. The simulator can
// wait for it by the stage name `constant_drive`.
#include <exception>
#include <iostream>
#include <string>

#include "common/bus/channels.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/bus/node/stop_signal.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/navigation.hpp"

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "adit-constant_drive SPEED\n";
    return 2;
  }
  const double speed_m_s = std::stod(argv[1]);
  const adit::StopSignal stop;
  adit::LcmBusOptions options;
  options.time = adit::BusTime::kSimulated;
  options.stage = "constant_drive";
  adit::LcmBus bus(options);
  bus.create_timer(50'000, [&bus, speed_m_s](std::int64_t utime) {
    adit::publish(bus, adit::channels::kDriveCommand,
                  adit::to_message(adit::DriveCommand{utime, speed_m_s, 0.0}));
  });
  bus.run(stop.descriptor());
  return 0;
} catch (const std::exception& error) {
  std::cerr << "adit-constant_drive: " << error.what() << "\n";
  return 2;
}
