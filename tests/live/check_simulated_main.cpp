// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// check_simulated RECORDED SECONDS: whether scan matching has made something of every scan of so
// many simulated seconds, lost none, and followed the robot, which drove. Says what is not so and
// ends with 1.
#include <exception>
#include <iostream>
#include <optional>
#include <string>

#include "common/bus/channels.hpp"
#include "common/bus/event_source.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/heartbeat.hpp"
#include "common/messages/pose.hpp"

namespace adit {
namespace {

constexpr double kScansPerSecond = 75.0;  // of two lasers with 361 beams
constexpr double kDrivenMinM = 5.0;
constexpr double kErrorMaxM = 0.5;  // over less than twenty metres, sideways and along

struct Recorded {
  int scans = 0;
  int matches = 0;
  std::optional<Heartbeat> heartbeat;  // the newest of scan matching
  std::optional<Pose2> first_truth;
  Pose2 truth;
  Pose2 pose;
};

template <class Msg>
auto value_of(const LogEventView& event) {
  return *from_message(*decode<Msg>(event.data));
}

void take(const LogEventView& event, Recorded& recorded) {
  if (event.channel.starts_with("LASER_")) ++recorded.scans;
  if (event.channel == channels::kScanMatch) ++recorded.matches;
  if (event.channel == channels::kPose) recorded.pose = value_of<pose_t>(event).T_odom_body;
  if (event.channel == channels::kTruth) {
    recorded.truth = value_of<pose_t>(event).T_odom_body;
    if (!recorded.first_truth) recorded.first_truth = recorded.truth;
  }
  if (event.channel == channels::kHeartbeat) {
    const auto heartbeat = value_of<heartbeat_t>(event);
    if (heartbeat.stage == "scan_matching") recorded.heartbeat = heartbeat;
  }
}

int failures = 0;

void require(bool holds, const std::string& what) {
  if (holds) return;
  std::cerr << "not so: " << what << "\n";
  ++failures;
}

int check(const std::string& path, double seconds) {
  Recorded recorded;
  LogFile log(path);
  while (const auto event = log.next()) take(*event, recorded);
  require(recorded.scans >= static_cast<int>(kScansPerSecond * seconds) - 2, "all scans are there");
  require(recorded.matches == recorded.scans, "each scan has its match");
  require(recorded.heartbeat && recorded.heartbeat->dropped == 0, "no message was dropped");
  require(recorded.heartbeat && recorded.heartbeat->refused == 0, "no message was refused");
  if (!recorded.first_truth) return 1;
  const Pose2 driven = between(*recorded.first_truth, recorded.truth);
  const double error_m = between(driven, recorded.pose).translation().norm();
  require(driven.translation().norm() > kDrivenMinM, "the robot drove");
  require(error_m < kErrorMaxM, "scan matching followed it");
  std::cout << recorded.scans << " scans, " << recorded.matches << " matches, "
            << driven.translation().norm() << " m driven, " << error_m << " m off\n";
  return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::cerr << "check_simulated RECORDED SECONDS\n";
    return 2;
  }
  return adit::check(argv[1], std::stod(argv[2]));
} catch (const std::exception& error) {
  std::cerr << "check_simulated: " << error.what() << "\n";
  return 2;
}
