// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// check_simulated SECONDS LOG: subscribes until SIGTERM, as a stage `check` for which the simulator
// waits. Then checks that scan matching published a match for every scan of the simulated SECONDS,
// that mapping published local maps, that no stage lost a message, that the robot drove and scan
// matching tracked it, and that the LOG of the simulator is complete. Exit code 1 if not.
#include <array>
#include <exception>
#include <iostream>
#include <map>
#include <optional>
#include <string>

#include "common/bus/channels.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/bus/node/stop_signal.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "tests/live/checks/log_check.hpp"

namespace adit {
namespace {

constexpr int kBeforeFirstTilt = 4;       // scans of two lasers in 20 ms, before the tilt is known
constexpr double kScansPerSecond = 75.0;  // of two lasers with 361 beams
constexpr double kDrivenMinM = 5.0;
constexpr std::size_t kQueued = 1000;
constexpr double kErrorMaxM = 0.5;  // over less than twenty metres

struct ReceivedMessages {
  std::map<std::string, int> messages;          // by channel
  std::map<std::string, Heartbeat> heartbeats;  // the newest, by stage
  std::optional<Pose2> first_truth;
  Pose2 truth;
  Pose2 pose;
};

constexpr std::array kCounted{channels::kLaserFront, channels::kLaserRear, channels::kImu,
                              channels::kPose,       channels::kScanMatch, channels::kLocalMap};

void subscribe_counts(Bus& bus, ReceivedMessages& received) {
  for (const std::string_view channel : kCounted) {
    bus.subscribe(channel, Delivery::queued(kQueued), [&received](const ReceivedMessage& message) {
      ++received.messages[std::string(message.channel)];
      return std::string_view();
    });
  }
}

void subscribe_all(Bus& bus, ReceivedMessages& received) {
  subscribe_counts(bus, received);
  const auto queued = Delivery::queued(kQueued);
  subscribe<pose_t>(bus, channels::kPose, queued,
                    [&received](const StampedPose& pose) { received.pose = pose.T_odom_body; });
  subscribe<pose_t>(bus, channels::kTruth, queued, [&received](const StampedPose& pose) {
    received.truth = pose.T_odom_body;
    if (!received.first_truth) received.first_truth = received.truth;
  });
  subscribe<heartbeat_t>(bus, channels::kHeartbeat, queued,
                         [&received](const Heartbeat& heartbeat) {
                           received.heartbeats[heartbeat.stage] = heartbeat;
                         });
}

Requirements require;

LcmBusOptions bus_options() {
  LcmBusOptions options;
  options.time = BusTime::kSimulated;
  options.stage = "check";
  return options;
}

/// Includes the simulator.
void check_stages(const ReceivedMessages& received) {
  for (const char* stage : {"scan_matching", "mapping", "sim"}) {
    const auto found = received.heartbeats.find(stage);
    require(found != received.heartbeats.end(), std::string(stage) + " published heartbeats");
    if (found == received.heartbeats.end()) continue;
    require(found->second.dropped == 0, std::string(stage) + " dropped no message");
    require(found->second.rejected == 0, std::string(stage) + " rejected no message");
  }
}

void check_log(const std::string& path, ReceivedMessages& received) {
  const LogFile log(path);
  std::map<std::string, int> recorded;
  for (const LogEventView& event : log.events()) ++recorded[std::string(event.channel)];
  for (const std::string_view counted : kCounted) {
    const std::string channel(counted);
    require(recorded[channel] == received.messages[channel],
            "the log has all messages on " + channel);
  }
}

int check(double seconds, const std::string& log) {
  const StopSignal stop;
  LcmBus bus(bus_options());
  ReceivedMessages received;
  subscribe_all(bus, received);
  bus.run(stop.descriptor());
  const int scans = received.messages["LASER_FRONT"] + received.messages["LASER_REAR"];
  require(scans >= static_cast<int>(kScansPerSecond * seconds) - 2, "all scans are received");
  const int unmatched = scans - received.messages["SCAN_MATCH"];
  require(unmatched >= 0 && unmatched <= kBeforeFirstTilt, "each scan has a match");
  require(received.messages["LOCAL_MAP"] > 0, "mapping published local maps");
  check_stages(received);
  check_log(log, received);
  if (!received.first_truth) return 1;
  const Pose2 driven = between(*received.first_truth, received.truth);
  const double error_m = between(driven, received.pose).translation().norm();
  require(driven.translation().norm() > kDrivenMinM, "the robot drives");
  require(error_m < kErrorMaxM, "scan matching tracks the robot");
  std::cout << scans << " scans, " << driven.translation().norm() << " m driven, error " << error_m
            << " m\n";
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
