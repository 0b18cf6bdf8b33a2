// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// check_arrival LOG: checks that the robot in a LOG of the simulator found a path, reached its true
// end, reported the arrival, and did not collide. Prints the number of guard stops, which occur on
// a loaded machine where readings arrive late. Exit code 1 if a requirement fails.
#include <cmath>
#include <cstdint>
#include <exception>
#include <iostream>
#include <optional>
#include <string>

#include <fmt/format.h>

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
constexpr double kEndM = 0.15;  // error of scan matching over a few metres
constexpr double kStationaryS = 1.0;

struct LogSummary {
  std::optional<Pose2> T_world_odom;  // the robot starts at the origin of odom
  Pose2 T_world_body;
  PlannedPath path;
  DrivingState state;
  std::int64_t moving_utime = 0;  // of the last motion
  std::int64_t end_utime = 0;
  int guard_stops = 0;  // while a path was driven
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
  require(!summary.path.points.empty(), "a path is found: " + summary.path.reason);
  require(summary.T_world_odom.has_value(), "the log has TRUTH");
  if (!require.all_met()) return require.exit_code();
  const Pose2 T_world_end = *summary.T_world_odom * summary.path.points.back().T_odom_body;
  const double error_m = between(T_world_end, summary.T_world_body).translation().norm();
  const double path_length_m =
      between(*summary.T_world_odom, summary.T_world_body).translation().norm();
  const double stationary_s = static_cast<double>(summary.end_utime - summary.moving_utime) * 1e-6;
  std::cout << fmt::format(
      "distance {} m, error at the end of the path {} m, stationary for {} s, {} guard stops\n",
      path_length_m, error_m, stationary_s, summary.guard_stops);
  require(path_length_m > kPathLengthMinM, "the robot drives");
  require(summary.state.kind == DrivingState::Kind::kArrived,
          "the robot arrives: " + summary.state.reason);
  require(error_m < kEndM, "the robot stops at the end of the path");
  require(stationary_s > kStationaryS, "the robot remains stationary");
  require(summary.failure.empty(), "no collision: " + summary.failure);
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
