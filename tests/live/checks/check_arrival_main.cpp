// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// check_arrival LOG: whether the robot in a simulator's LOG found a path, drove it to its end,
// where it truly stands, said so, and touched nothing. Says how often it was held on the way: on a
// machine that is so busy that readings come late the guard does that. Ends with 1 if not.
#include <cmath>
#include <cstdint>
#include <exception>
#include <iostream>
#include <optional>
#include <string>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sim.hpp"
#include "tests/live/checks/log_check.hpp"

namespace adit {
namespace {

constexpr double kPathLengthMinM = 3.0;
constexpr double kEndM = 0.15;  // poses are those of scan matching, over a few metres
constexpr double kStationaryS = 1.0;

struct LogSummary {
  std::optional<Pose2> T_world_odom;  // the robot starts at the origin of odom
  Pose2 T_world_body;
  PlannedPath path;
  DrivingState state;
  std::int64_t moving_utime = 0;  // last
  std::int64_t end_utime = 0;
  int guard_stops = 0;  // how often, while there was a path to drive
  bool stopped = true;
  std::string failure;
};

void update_truth(const LogEventView& event, LogSummary& summary) {
  const StampedPose truth = value_of<pose_t>(event);
  summary.T_world_body = truth.T_odom_body;
  if (!summary.T_world_odom) summary.T_world_odom = summary.T_world_body;
  if (!truth.v_body || truth.v_body->head<2>().norm() > 0.0) summary.moving_utime = event.utime;
}

LogSummary summarize(const LogFile& log) {
  LogSummary summary;
  for (const LogEventView& event : log.events()) {
    summary.end_utime = event.utime;
    if (event.channel == channels::kTruth) update_truth(event, summary);
    if (event.channel == channels::kPath) summary.path = value_of<planned_path_t>(event);
    if (event.channel == channels::kDrivingState) summary.state = value_of<driving_state_t>(event);
    if (event.channel == channels::kRunState)
      summary.failure = value_of<run_state_t>(event).failure;
    if (event.channel != channels::kStop) continue;
    const bool stopped = value_of<stop_t>(event).stopped;
    if (stopped && !summary.stopped && summary.state.remaining_m > 0.0) ++summary.guard_stops;
    summary.stopped = stopped;
  }
  return summary;
}

Requirements require;

int check(const std::string& path) {
  const LogSummary summary = summarize(LogFile(path));
  require(!summary.path.points.empty(), "there is a path: " + summary.path.reason);
  require(summary.T_world_odom.has_value(), "there is truth");
  if (!require.all_met()) return require.exit_code();
  const Pose2 T_world_end = *summary.T_world_odom * summary.path.points.back().T_odom_body;
  const double off_m = between(T_world_end, summary.T_world_body).translation().norm();
  const double path_length_m =
      between(*summary.T_world_odom, summary.T_world_body).translation().norm();
  const double stationary_s = static_cast<double>(summary.end_utime - summary.moving_utime) * 1e-6;
  std::cout << "drove " << path_length_m << " m, stands " << off_m
            << " m from the end of its path, since " << stationary_s << " s, was held "
            << summary.guard_stops << " times\n";
  require(path_length_m > kPathLengthMinM, "it drove");
  require(summary.state.kind == DrivingState::Kind::kArrived,
          "it arrived: " + summary.state.reason);
  require(off_m < kEndM, "it stands at the end of its path");
  require(stationary_s > kStationaryS, "and for good");
  require(summary.failure.empty(), "it touched nothing: " + summary.failure);
  return require.exit_code();
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "check_arrival LOG\n";
    return 2;
  }
  return adit::check(argv[1]);
} catch (const std::exception& error) {
  std::cerr << "check_arrival: " << error.what() << "\n";
  return 2;
}
