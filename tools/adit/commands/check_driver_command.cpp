// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/command_line/command_line.hpp"
#include "common/config/config.hpp"
#include "common/files/file_utils.hpp"
#include "common/sensing/laser_mount.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/check_driver/driver_check.hpp"
#include "tools/mission/private_network.hpp"

namespace adit {
namespace {

constexpr int kExitBad = 1;

struct CheckDriverOptions {
  std::string channel;
  double seconds = 10.0;
  std::filesystem::path log;      ///< empty: live
  std::filesystem::path config;   ///< empty: defaults
  std::filesystem::path mission;  ///< folder of a mission on a private network; empty: this network
  std::string lcm_url;            ///< empty: LCM's default
};

constexpr const char* kCheckDriverDetails =
    R"(Listens to LASER_FRONT, LASER_REAR, LIDAR, TILT_FRONT, TILT_REAR, WHEEL_ODOMETRY, IMU, VEHICLE_STATE, GAS or
SINKAGE, or reads them from a log, and prints one line for each property that the stages depend on: rate, gaps, order and
regularity of the stamps, clock, frame, beams, ranges, repetition, order of the beams, sign; of a spinning lidar whole
revolutions, rings and returns. A line that begins with BAD says what to do; one with - could not be checked.

Whether a laser turns the right direction is seen when the vehicle turns, by IMU or WHEEL_ODOMETRY: turn it on the spot
while this runs. Arrivals in a log are the times of recording.)";

constexpr const char* kCheckDriverExamples =
    R"(  adit check-driver LASER_FRONT --config /etc/adit/robot.yaml
  adit check-driver IMU --seconds 30
  adit check-driver LASER_REAR --log run.lcmlog)";

double range_max_m(const CheckDriverOptions& options) {
  ConfigFile file;
  if (!options.config.empty()) {
    file = ConfigFile::load(find_installed_file(options.config, "config"));
  }
  const auto lasers = load_section<Lasers>(file, Lasers::kSection);
  const bool is_rear = options.channel == channels::kLaserRear;
  return is_rear ? lasers.rear.range_max_m : lasers.front.range_max_m;
}

void listen(const CheckDriverOptions& options, DriverCheck& check) {
  using Clock = std::chrono::steady_clock;
  if (!options.mission.empty()) enter_network_of_mission(options.mission);
  LcmBus bus({.url = options.lcm_url});
  for (const std::string_view channel : check.channels()) {
    bus.subscribe(channel, Delivery::queued(10'000),
                  [&check](const ReceivedMessage& received) -> std::string_view {
                    check.add(received.channel, received.bytes, received.utime);
                    return {};
                  });
  }
  constexpr int kWaitMs = 100;
  const auto end = Clock::now() + std::chrono::duration<double>(options.seconds);
  while (Clock::now() < end) bus.handle(kWaitMs);
  while (bus.handle(0)) {
  }
}

void read_log(const CheckDriverOptions& options, DriverCheck& check) {
  LogFile log(options.log);
  while (const auto event = log.next()) check.add(event->channel, event->data, event->utime);
}

void run(const CheckDriverOptions& options) {
  DriverCheck check(options.channel, range_max_m(options));
  options.log.empty() ? listen(options, check) : read_log(options, check);
  const CheckResults results = check.results();
  std::cout << text_of(options.channel, results);
  if (!all_are_good(results)) throw CLI::RuntimeError(kExitBad);
}

}  // namespace

void add_check_driver_command(CLI::App& adit) {
  CLI::App* command = add_command(adit, "check-driver",
                                  "Say whether the messages of a driver are what the stages need");
  set_help(*command, {kCheckDriverDetails, "  1  a property is not what the stages need",
                      kCheckDriverExamples});
  const auto options = std::make_shared<CheckDriverOptions>();
  command->add_option("CHANNEL", options->channel, "Channel of the driver")->required();
  CLI::Option* const log =
      command->add_option("--log", options->log, "LCM log to read instead of the network")
          ->type_name("FILE");
  command->add_option("--seconds", options->seconds, "How long to listen")
      ->type_name("SECONDS")
      ->check(number_in(above_up_to(0.0, 3600.0)))
      ->excludes(log)
      ->capture_default_str();
  command
      ->add_option("--config", options->config,
                   "YAML file of the robot, for the range of the laser")
      ->type_name("FILE")
      ->envname("ADIT_CONFIG");
  command->add_option("--mission", options->mission, "Output folder of a running adit mission")
      ->type_name("DIR")
      ->excludes(log);
  command->add_option("--lcm-url", options->lcm_url, "LCM network, instead of the default")
      ->type_name("URL")
      ->excludes(log);
  command->callback([options] { run(*options); });
}

}  // namespace adit
