// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// check_simulated SECONDS: listens until SIGTERM, as a stage for which the simulator waits by the
// name `check`, and says then whether scan matching has made something of every scan of so many
// simulated seconds, lost none, and followed the robot, which drove. Ends with 1 if not. A recorder
// could not tell: nobody waits for it.
#include <exception>
#include <iostream>
#include <optional>
#include <string>

#include "common/bus/channels.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/bus/stop_signal.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/heartbeat.hpp"
#include "common/messages/pose.hpp"

namespace adit {
namespace {

constexpr double kScansPerSecond = 75.0;  // of two lasers with 361 beams
constexpr double kDrivenMinM = 5.0;
constexpr std::size_t kWaiting = 1000;
constexpr double kErrorMaxM = 0.5;  // over less than twenty metres, sideways and along

struct Heard {
  int scans = 0;
  int matches = 0;
  std::optional<Heartbeat> heartbeat;  // the newest of scan matching
  std::optional<Pose2> first_truth;
  Pose2 truth;
  Pose2 pose;
};

void count(Bus& bus, std::string_view channel, int& messages) {
  bus.subscribe(channel, Delivery::queued(kWaiting), [&messages](const Received&) {
    ++messages;
    return std::string_view();
  });
}

void listen(Bus& bus, Heard& heard) {
  count(bus, channels::kLaserFront, heard.scans);
  count(bus, channels::kLaserRear, heard.scans);
  count(bus, channels::kScanMatch, heard.matches);
  const auto queued = Delivery::queued(kWaiting);
  subscribe<pose_t>(bus, channels::kPose, queued,
                    [&heard](const StampedPose& pose) { heard.pose = pose.T_odom_body; });
  subscribe<pose_t>(bus, channels::kTruth, queued, [&heard](const StampedPose& pose) {
    heard.truth = pose.T_odom_body;
    if (!heard.first_truth) heard.first_truth = heard.truth;
  });
  subscribe<heartbeat_t>(bus, channels::kHeartbeat, queued, [&heard](const Heartbeat& heartbeat) {
    if (heartbeat.stage == "scan_matching") heard.heartbeat = heartbeat;
  });
}

int failures = 0;

void require(bool holds, const std::string& what) {
  if (holds) return;
  std::cerr << "not so: " << what << "\n";
  ++failures;
}

LcmBusOptions bus_options() {
  LcmBusOptions options;
  options.time = BusTime::kSimulated;
  options.stage = "check";
  return options;
}

int check(double seconds) {
  const StopSignal stop;
  LcmBus bus(bus_options());
  Heard heard;
  listen(bus, heard);
  bus.run(stop.descriptor());
  require(heard.scans >= static_cast<int>(kScansPerSecond * seconds) - 2, "all scans are there");
  require(heard.matches == heard.scans, "each scan has its match");
  require(heard.heartbeat && heard.heartbeat->dropped == 0, "no message was dropped");
  require(heard.heartbeat && heard.heartbeat->refused == 0, "no message was refused");
  if (!heard.first_truth) return 1;
  const Pose2 driven = between(*heard.first_truth, heard.truth);
  const double error_m = between(driven, heard.pose).translation().norm();
  require(driven.translation().norm() > kDrivenMinM, "the robot drove");
  require(error_m < kErrorMaxM, "scan matching followed it");
  std::cout << heard.scans << " scans, " << heard.matches << " matches, "
            << driven.translation().norm() << " m driven, " << error_m << " m off\n";
  return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "check_simulated SECONDS\n";
    return 2;
  }
  return adit::check(std::stod(argv[1]));
} catch (const std::exception& error) {
  std::cerr << "check_simulated: " << error.what() << "\n";
  return 2;
}
