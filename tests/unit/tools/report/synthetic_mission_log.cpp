// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/tools/report/synthetic_mission_log.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include "common/bus/channels.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/config/config.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/exploration.hpp"
#include "common/messages/mapping/association.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "common/messages/mission.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "common/messages/sim.hpp"
#include "common/sensing/seconds.hpp"
#include "procs/planning/planning.hpp"
#include "procs/terrain/terrain.hpp"
#include "tests/unit/procs/volume_map/swept_tunnel.hpp"

namespace adit::test {
namespace {

constexpr double kHalfWidthM = 2.0;
constexpr double kEndsM[] = {-3.0, 25.0};

std::int64_t at(double seconds) {
  return kMissionUtime + static_cast<std::int64_t>(std::llround(1e6 * seconds));
}

Pose2 pose_at(double seconds) {
  const double out_m = std::min(0.5 * seconds, 10.0);
  return {seconds < 30.0 ? out_m : 10.0 - 0.5 * (seconds - 30.0), 0.0, 0.0};
}

/// Scan of a laser in the tunnel at a time.
LaserScan scan_of_tunnel(double seconds) {
  LaserScan scan{at(seconds), {}, -std::numbers::pi / 2.0, std::numbers::pi / 180.0};
  for (int i = 0; i <= 180; ++i) {
    const double angle = scan.angle_min_rad + i * scan.angle_step_rad;
    const double across = kHalfWidthM / std::max(std::abs(std::sin(angle)), 1e-9);
    const double along = (kEndsM[1] - pose_at(seconds).x) / std::max(std::cos(angle), 1e-9);
    scan.ranges_m.push_back(static_cast<float>(std::min(across, along)));
  }
  return scan;
}

class SyntheticMissionLog {
 public:
  SyntheticMissionLog(const std::filesystem::path& path, const MissionLogOptions& options)
      : writer_(path), options_(options) {}

  template <class Value>
  void write(double seconds, std::string_view channel, const Value& value) {
    const bool is_time = seconds >= options_.from_s && seconds < options_.to_s;
    if (!is_time || options_.omitted_channels.contains(channel)) return;
    events_.push_back({at(seconds), std::string(channel), encode(to_message(value))});
  }
  template <class Value>
  void write_fragments(double seconds, std::string_view channel, const Value& value) {
    for (const auto& fragment : split(value)) write(seconds, channel, fragment);
  }
  void close() {
    std::stable_sort(events_.begin(), events_.end(),
                     [](const LogEvent& a, const LogEvent& b) { return a.utime < b.utime; });
    for (const LogEvent& event : events_) writer_.write({event.utime, event.channel, event.data});
    writer_.close();
  }

 private:
  LogWriter writer_;
  MissionLogOptions options_;
  std::vector<LogEvent> events_;
};

MissionPhase phase(double seconds, int sequence, Phase phase, const std::string& reason) {
  MissionPhase reported;
  reported.utime = at(seconds);
  reported.sequence = sequence;
  reported.phase = phase;
  reported.reason = reason;
  reported.distance_travelled_m = seconds < 30.0 ? pose_at(seconds).x : 20.0 - pose_at(seconds).x;
  reported.returning_home = seconds >= 30.0;
  if (reported.returning_home) reported.return_home_reason = kHtmlInjection;
  if (phase == Phase::kEnded) reported.outcome = MissionOutcome::kHome;
  return reported;
}

void write_phases(SyntheticMissionLog& log) {
  const MissionPhase phases[] = {phase(0.0, 1, Phase::kWaiting, "the mission begins"),
                                 phase(2.0, 2, Phase::kExecute, "ahead"),
                                 phase(20.0, 3, Phase::kScan, kHtmlInjection),
                                 phase(28.0, 4, Phase::kPlan, "scan received"),
                                 phase(30.0, 5, Phase::kExecute, "home"),
                                 phase(kMissionS, 6, Phase::kEnded, "at home")};
  for (const MissionPhase& reported : phases) {
    const double seconds = adit::seconds(reported.utime - kMissionUtime);
    for (const double delay : {0.0, 1.0}) log.write(seconds + delay, channels::kPhase, reported);
  }
}

void write_poses(SyntheticMissionLog& log) {
  const Pose2 T_world_odom{100.0, 50.0, 0.3};
  for (double t = 0.0; t <= kMissionS; t += 0.1) {
    log.write(t, channels::kPose, StampedPose{at(t), pose_at(t), {}});
    log.write(t, channels::kTruth, StampedPose{at(t), T_world_odom * pose_at(t), {}});
    log.write(t, channels::kRunState, RunState{at(t), 0.0, ""});
    log.write(t, channels::kGas, GasReading{at(t), 0.001, 0.2, 1e-5});
  }
}

LocalMap local_map(int id, double from_s) {
  LocalMap map;
  map.id = id;
  map.utime = at(from_s);
  map.end_utime = at(from_s + 10.0);
  map.T_odom_local = pose_at(from_s);
  map.information = Eigen::Matrix3d::Identity();
  for (double t = from_s; t <= from_s + 10.0; t += 1.0) {
    map.scans.push_back({"LASER_FRONT", scan_of_tunnel(t), between(map.T_odom_local, pose_at(t))});
  }
  return map;
}

MapConstraint constraint(int from, int to, double x, MapConstraint::Kind kind) {
  return {{from, to, {x, 0.0, 0.0}, Eigen::Matrix3d::Identity()}, kind};
}

void write_map(SyntheticMissionLog& log) {
  using Kind = MapConstraint::Kind;
  MapGraph graph;
  const double begins_s[] = {0.0, 10.0, 30.0, 40.0};
  for (int id = 0; id < 4; ++id) {
    log.write_fragments(begins_s[id] + 10.0, channels::kLocalMap, local_map(id, begins_s[id]));
    graph.poses.push_back(pose_at(begins_s[id]));
    if (id > 0) {
      const double step = pose_at(begins_s[id]).x - pose_at(begins_s[id - 1]).x;
      graph.constraints.push_back(constraint(id - 1, id, step, Kind::kSequential));
    }
    if (id == 3) graph.constraints.push_back(constraint(1, 3, 0.0, Kind::kLoopClosure));
    graph.utime = at(begins_s[id] + 10.0);
    graph.revision = id + 1;
    log.write_fragments(begins_s[id] + 10.0, channels::kPoseGraph, graph);
    log.write(begins_s[id] + 10.0, channels::kMapCorrection,
              MapCorrection{graph.utime, graph.revision, 0, id, {}, {}});
  }
}

Association association(double seconds, Association::Action action, int id, int newer, int chosen,
                        int before) {
  Association a;
  a.utime = at(seconds);
  a.action = action;
  a.loop_closure = {id, newer, {{newer - 2, {}, Eigen::Matrix3d::Identity(), 3.0}}};
  a.chosen = chosen;
  a.previously_chosen = before;
  a.reason = kHtmlInjection;
  return a;
}

void write_associations(SyntheticMissionLog& log) {
  using Action = Association::Action;
  constexpr int kNone = Association::kNone;
  log.write(40.0, channels::kAssociation, association(40, Action::kProposed, 0, 2, 0, kNone));
  log.write(50.0, channels::kAssociation, association(50, Action::kProposed, 1, 3, 0, kNone));
  log.write(50.0, channels::kAssociation, association(50, Action::kRevised, 0, 2, kNone, 0));
}

PlannedPath found(const TerrainMap& terrain, const PlanGoal& goal) {
  return Planning(PlanningParams{}).plan(terrain, goal, terrain.T_odom_level);
}

PlannedPath blocked() {
  PlannedPath path;
  path.outcome = PlanOutcome::kBlocked;
  path.reason = kHtmlInjection;
  path.blocking.push_back({{12.0, 0.3}, BlockingCell::Reason::kStep, 0.4});
  return path;
}

void write_scan(SyntheticMissionLog& log, double seconds, int id) {
  Cloud cloud = sweep_of_tunnel(pose_at(seconds), 24);
  cloud.id = id;
  cloud.utime = at(seconds);
  cloud.T_odom_level = pose_at(seconds);
  const TerrainMap terrain = Terrain(TerrainParams{}).make(cloud);
  const PlanGoal goal{at(seconds), 10 + id, PlanGoal::Kind::kAlong, cloud.T_odom_level, 8.0, {}};
  PlannedPath path = id == 1 ? found(terrain, goal) : blocked();
  path.utime = cloud.utime;
  path.id = goal.id;
  const LaserId laser = id == 1 ? LaserId::kFront : LaserId::kRear;
  log.write(20.0 + id, channels::kScanRequest, ScanRequest{at(20.0 + id), id, laser});
  log.write_fragments(seconds, channels::kCloud, cloud);
  log.write_fragments(seconds, channels::kTerrain, terrain);
  log.write(seconds, channels::kGoal, goal);
  log.write(seconds, channels::kPath, path);
}

void write_exploration(SyntheticMissionLog& log) {
  ExplorationReport report;
  report.utime = at(49.0);
  report.decision.reason = "home is near";
  report.frontiers = {
      {0, 0, {15.0, 0.0}, {1.0, 0.0}, 4.0, FrontierState::kOpen, at(28.0), kHtmlInjection},
      {1, 0, {-3.0, 0.0}, {-1.0, 0.0}, 4.0, FrontierState::kOutsideMine, at(1.0), "the entrance"},
      {2, 1, {9.0, 2.0}, {0.0, 1.0}, 1.0, FrontierState::kTooNarrow, at(9.0), "1 m wide"}};
  report.corridors.nodes = {{{0.0, 0.0}, CorridorNode::Kind::kDeadEnd},
                            {{15.0, 0.0}, CorridorNode::Kind::kOpenEnd}};
  report.corridors.corridors = {{0, 1, 15.0, 4.0, {{0.0, 0.0}, {15.0, 0.0}}}};
  report.budget.explored_m = 15.0;
  log.write(49.0, channels::kExploration, report);
}

void write_events(SyntheticMissionLog& log) {
  const std::string yaml = to_yaml(PlanningParams{}, "planning") + "# " + kHtmlInjection + "\n";
  log.write(0.0, channels::kConfig, ConfigSnapshot{at(0.0), "planning", "1.2.3", yaml});
  for (double t = 5.0; t < 8.0; t += 0.1) {
    log.write(t, channels::kStop, StopOrder{at(t), t < 7.0, t < 7.0 ? kHtmlInjection : ""});
  }
  log.write(6.0, channels::kMissionOrder, MissionOrder{at(6.0), MissionOrder::Kind::kReturnHome});
  for (int t = 0; t < 50; ++t) {
    Heartbeat heartbeat{at(t), "planning", {}, t < 30 ? 100 + t : t, 0, 0};
    if (t == 12) heartbeat.health = {Health::Level::kDegraded, kHtmlInjection};
    log.write(t, channels::kHeartbeat, heartbeat);
  }
  for (int t = 0; t < 50; ++t) {
    const bool driving = t >= 2 && (t < 20 || t >= 30);
    DrivingState state;
    state.utime = at(t);
    state.kind = driving ? DrivingState::Kind::kDriving : DrivingState::Kind::kIdle;
    log.write(t, channels::kDrivingState, state);
  }
}

}  // namespace

void write_mission_log(const std::filesystem::path& path, const MissionLogOptions& options) {
  SyntheticMissionLog log(path, options);
  write_phases(log);
  write_poses(log);
  write_events(log);
  write_map(log);
  write_associations(log);
  write_scan(log, 28.0, 1);
  write_scan(log, 29.0, 2);
  write_exploration(log);
  log.close();
}

}  // namespace adit::test
