// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// check_simulated SECONDS LOG: listens until SIGTERM, as a stage for which the simulator waits by
// the name `check`, and says then whether scan matching has made something of every scan of so many
// simulated seconds, mapping of what scan matching said, neither lost anything, scan matching
// followed the robot, which drove, and the simulator's LOG has all of that. Ends with 1 if not.
#include <array>
#include <exception>
#include <iostream>
#include <map>
#include <optional>
#include <string>

#include "common/bus/channels.hpp"
#include "common/bus/event_source.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/bus/stop_signal.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/heartbeat.hpp"
#include "common/messages/pose.hpp"
#include "tests/live/log_check.hpp"

namespace adit {
namespace {

constexpr int kBeforeFirstTilt = 4;       // scans of two lasers in 20 ms: nobody knows how tilted
constexpr double kScansPerSecond = 75.0;  // of two lasers with 361 beams
constexpr double kDrivenMinM = 5.0;
constexpr std::size_t kWaiting = 1000;
constexpr double kErrorMaxM = 0.5;  // over less than twenty metres, sideways and along

struct Heard {
  std::map<std::string, int> messages;          // by channel
  std::map<std::string, Heartbeat> heartbeats;  // the newest, by stage
  std::optional<Pose2> first_truth;
  Pose2 truth;
  Pose2 pose;
};

constexpr std::array kCounted{channels::kLaserFront, channels::kLaserRear, channels::kImu,
                              channels::kPose,       channels::kScanMatch, channels::kLocalMap};

void count(Bus& bus, Heard& heard) {
  for (const std::string_view channel : kCounted) {
    bus.subscribe(channel, Delivery::queued(kWaiting), [&heard](const Received& received) {
      ++heard.messages[std::string(received.channel)];
      return std::string_view();
    });
  }
}

void listen(Bus& bus, Heard& heard) {
  count(bus, heard);
  const auto queued = Delivery::queued(kWaiting);
  subscribe<pose_t>(bus, channels::kPose, queued,
                    [&heard](const StampedPose& pose) { heard.pose = pose.T_odom_body; });
  subscribe<pose_t>(bus, channels::kTruth, queued, [&heard](const StampedPose& pose) {
    heard.truth = pose.T_odom_body;
    if (!heard.first_truth) heard.first_truth = heard.truth;
  });
  subscribe<heartbeat_t>(bus, channels::kHeartbeat, queued, [&heard](const Heartbeat& heartbeat) {
    heard.heartbeats[heartbeat.stage] = heartbeat;
  });
}

Requirements require;

LcmBusOptions bus_options() {
  LcmBusOptions options;
  options.time = BusTime::kSimulated;
  options.stage = "check";
  return options;
}

/// Also the simulator itself.
void check_stages(const Heard& heard) {
  for (const char* stage : {"scan_matching", "mapping", "sim"}) {
    const auto found = heard.heartbeats.find(stage);
    require(found != heard.heartbeats.end(), std::string(stage) + " said that it is alive");
    if (found == heard.heartbeats.end()) continue;
    require(found->second.dropped == 0, std::string(stage) + " dropped no message");
    require(found->second.refused == 0, std::string(stage) + " refused no message");
  }
}

void check_log(const std::string& path, Heard& heard) {
  const LogFile log(path);
  std::map<std::string, int> recorded;
  for (const LogEventView& event : log.events()) ++recorded[std::string(event.channel)];
  for (const std::string_view counted : kCounted) {
    const std::string channel(counted);
    require(recorded[channel] == heard.messages[channel], "all of " + channel + " is in the log");
  }
}

int check(double seconds, const std::string& log) {
  const StopSignal stop;
  LcmBus bus(bus_options());
  Heard heard;
  listen(bus, heard);
  bus.run(stop.descriptor());
  const int scans = heard.messages["LASER_FRONT"] + heard.messages["LASER_REAR"];
  require(scans >= static_cast<int>(kScansPerSecond * seconds) - 2, "all scans are there");
  const int unmatched = scans - heard.messages["SCAN_MATCH"];
  require(unmatched >= 0 && unmatched <= kBeforeFirstTilt, "each scan has its match");
  require(heard.messages["LOCAL_MAP"] > 0, "mapping made a map of them");
  check_stages(heard);
  check_log(log, heard);
  if (!heard.first_truth) return 1;
  const Pose2 driven = between(*heard.first_truth, heard.truth);
  const double error_m = between(driven, heard.pose).translation().norm();
  require(driven.translation().norm() > kDrivenMinM, "the robot drove");
  require(error_m < kErrorMaxM, "scan matching followed it");
  std::cout << scans << " scans, " << driven.translation().norm() << " m driven, " << error_m
            << " m off\n";
  return require.exit_code();
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::cerr << "check_simulated SECONDS LOG\n";
    return 2;
  }
  return adit::check(std::stod(argv[1]), argv[2]);
} catch (const std::exception& error) {
  std::cerr << "check_simulated: " << error.what() << "\n";
  return 2;
}
