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
#include "common/bus/event_source.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/driving_state.hpp"
#include "common/messages/planned_path.hpp"
#include "common/messages/pose.hpp"
#include "common/messages/run_state.hpp"
#include "common/messages/stop_order.hpp"
#include "tests/live/log_check.hpp"

namespace adit {
namespace {

constexpr double kWayMinM = 3.0;
constexpr double kEndM = 0.15;  // poses are those of scan matching, over a few metres
constexpr double kForGoodS = 1.0;

struct Seen {
  std::optional<Pose2> T_world_odom;  // the robot starts at the origin of odom
  Pose2 T_world_body;
  PlannedPath path;
  DrivingState state;
  std::int64_t moving_utime = 0;  // last
  std::int64_t end_utime = 0;
  int held = 0;  // how often, while there was a path to drive
  bool stopped = true;
  std::string failure;
};

void see_truth(const LogEventView& event, Seen& seen) {
  const StampedPose truth = value_of<pose_t>(event);
  seen.T_world_body = truth.T_odom_body;
  if (!seen.T_world_odom) seen.T_world_odom = seen.T_world_body;
  if (!truth.v_body || truth.v_body->head<2>().norm() > 0.0) seen.moving_utime = event.utime;
}

Seen look(const LogFile& log) {
  Seen seen;
  for (const LogEventView& event : log.events()) {
    seen.end_utime = event.utime;
    if (event.channel == channels::kTruth) see_truth(event, seen);
    if (event.channel == channels::kPath) seen.path = value_of<planned_path_t>(event);
    if (event.channel == channels::kDrivingState) seen.state = value_of<driving_state_t>(event);
    if (event.channel == channels::kRunState) seen.failure = value_of<run_state_t>(event).failure;
    if (event.channel != channels::kStop) continue;
    const bool stopped = value_of<stop_t>(event).stopped;
    if (stopped && !seen.stopped && seen.state.remaining_m > 0.0) ++seen.held;
    seen.stopped = stopped;
  }
  return seen;
}

Requirements require;

int check(const std::string& path) {
  const Seen seen = look(LogFile(path));
  require(!seen.path.points.empty(), "there is a path: " + seen.path.reason);
  require(seen.T_world_odom.has_value(), "there is truth");
  if (!require.hold()) return require.exit_code();
  const Pose2 T_world_end = *seen.T_world_odom * seen.path.points.back().T_odom_body;
  const double off_m = between(T_world_end, seen.T_world_body).translation().norm();
  const double way_m = between(*seen.T_world_odom, seen.T_world_body).translation().norm();
  const double stands_s = static_cast<double>(seen.end_utime - seen.moving_utime) * 1e-6;
  std::cout << "drove " << way_m << " m, stands " << off_m << " m from the end of its path, since "
            << stands_s << " s, was held " << seen.held << " times\n";
  require(way_m > kWayMinM, "it drove");
  require(seen.state.kind == DrivingState::Kind::kArrived, "it arrived: " + seen.state.reason);
  require(off_m < kEndM, "it stands at the end of its path");
  require(stands_s > kForGoodS, "and for good");
  require(seen.failure.empty(), "it touched nothing: " + seen.failure);
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
