// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/scores/mission_log.hpp"

#include <map>
#include <set>
#include <string_view>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/bus/motion_steps.hpp"
#include "common/geometry/attitude.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/exploration.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/mission.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sim.hpp"
#include "tools/map/full_map.hpp"

namespace adit::test {
namespace {

constexpr std::int64_t kPeriodUs = 100'000;

class Reader {
 public:
  void read(const LogEventView& event) {
    const auto on = [&](std::string_view channel) { return event.channel == channel; };
    if (on(channels::kTruth))
      add_message<pose_t>(event, [this](const auto& pose) { add_truth(pose); });
    if (on(channels::kPose))
      add_message<pose_t>(event, [this](const auto& pose) { add_pose(pose); });
    if (on(channels::kMapCorrection)) {
      add_message<map_correction_t>(event, [this](const auto& c) { correction_ = c; });
    }
    if (on(channels::kLocalMap)) {
      add_message<local_map_t>(
          event, [this](const auto& fragment) { locals_[fragment.part.id] = fragment.part; });
    }
    if (on(channels::kPoseGraph))
      add_message<pose_graph_t>(event, [this](const auto& p) { add(p); });
    if (on(channels::kPhase))
      add_message<phase_t>(event, [this](const auto& phase) { add(phase); });
    if (on(channels::kVehicleState)) {
      add_message<vehicle_state_t>(event, [this](const auto& state) { log_.budget.add(state); });
    }
    if (on(channels::kExploreRequest)) {
      add_message<explore_request_t>(event, [this](const auto& request) { add(request); });
    }
    if (on(channels::kExploration)) {
      add_message<exploration_t>(event, [this](const auto& report) { log_.report = report; });
    }
    if (on(channels::kStop)) add_message<stop_t>(event, [this](const auto& order) { add(order); });
    if (on(channels::kRunState)) {
      add_message<run_state_t>(event, [this](const auto& state) {
        log_.distance_travelled_m = state.distance_travelled_m;
        log_.failure = state.failure;
      });
    }
  }

  MissionLog log() && {
    add_mapped();
    log_.graph = std::move(graph_);
    return std::move(log_);
  }

 private:
  template <class Message, class Handler>
  static void add_message(const LogEventView& event, Handler handler) {
    const auto message = decode<Message>(event.data);
    if (!message) return;
    if (const auto value = from_message(*message)) handler(*value);
  }

  static bool is_due(const Trajectory& trajectory, std::int64_t utime) {
    return trajectory.empty() || utime >= trajectory.back().utime + kPeriodUs;
  }

  void add_truth(const StampedPose& pose) {
    if (!truth_steps_.check(stream_pose(pose), pose.utime).empty()) return;
    if (!is_due(log_.truth, pose.utime)) return;
    log_.truth.push_back({pose.utime, pose.T_odom_body, pose.z_m});
    log_.bodies.push_back(in_space(pose.T_odom_body, pose.z_m, pose.attitude));
  }
  void add_pose(const StampedPose& pose) {
    if (!pose_steps_.check(stream_pose(pose), pose.utime).empty()) return;
    log_.budget.add(pose.utime, pose.T_odom_body, pose.z_m);
    if (!is_due(odom_, pose.utime)) return;
    odom_.push_back({pose.utime, pose.T_odom_body, pose.z_m});
    log_.estimated.push_back({pose.utime, correction_.T_map_odom * pose.T_odom_body,
                              correction_.z_map_odom_m + pose.z_m});
  }
  void add(const PoseGraphFragment& fragment) {
    auto graph = graphs_.add(fragment);
    if (!graph) return;
    graph_ = std::move(*graph);
    for (const MapConstraint& c : graph_.constraints) {
      if (c.kind != MapConstraint::Kind::kLoopClosure) continue;
      log_.loop_closures.insert({c.measured.from, c.measured.to});
    }
  }
  void add(const MissionPhase& phase) {
    log_.budget.add(phase);
    executes_ = phase.phase == Phase::kExecute;
    if (log_.phases.empty() || phase.sequence != log_.phases.back().sequence) {
      log_.phases.push_back(phase);
    }
  }
  void add(const ExploreRequest& request) {
    if (request.blocked && reported_.insert(request.id).second) {
      log_.verdicts.push_back(*request.blocked);
    }
  }
  void add(const StopOrder& order) {
    if (order.stopped && !stopped_ && executes_) ++log_.guard_stops;
    stopped_ = order.stopped;
  }

  void add_mapped() {
    std::vector<MapAnchor> anchors;
    for (const auto& [id, map] : locals_) {
      log_.local_map_utimes[id] = map.utime;
      if (static_cast<std::size_t>(id) < graph_.poses.size()) {
        anchors.push_back(map_anchor(map, graph_));
      }
    }
    if (anchors.empty()) return;
    for (const TimedPose& at : corrected_trajectory(odom_, anchors)) {
      if (at.utime >= anchors.front().utime) log_.mapped.push_back(at);
    }
  }

  MissionLog log_;
  MotionSteps truth_steps_;
  MotionSteps pose_steps_;
  Trajectory odom_;
  MapCorrection correction_;
  std::map<int, LocalMap> locals_;  ///< with a part of their scans only
  PoseGraphReassembler graphs_;
  MapGraph graph_;
  std::set<std::int32_t> reported_;
  bool executes_ = false;
  bool stopped_ = true;
};

}  // namespace

MissionLog read_mission(const std::filesystem::path& log) {
  LogFile events(log);
  Reader reader;
  while (const auto event = events.next()) reader.read(*event);
  return std::move(reader).log();
}

}  // namespace adit::test
