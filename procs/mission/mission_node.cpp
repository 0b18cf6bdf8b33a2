// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/mission_node.hpp"

#include <exception>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/journal/journal.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/exploration.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "common/messages/mission.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

constexpr std::int64_t kPeriodUs = 100'000;
constexpr std::int64_t kPublishPeriodUs = 1'000'000;
constexpr std::int64_t kSpacePeriodUs = 1'000'000;
constexpr std::size_t kQueueLength = 100;

}  // namespace

MissionNode::MissionNode(Bus& bus, const Params& params) : bus_(bus), mission_(params) {
  if (!params.journal.empty()) {
    journal_.emplace(params.journal);
    if (journal_->last()) {
      mission_.restore(*journal_->last(), *journal_->start_utime(), journal_->take_stored_path(),
                       {journal_->newest_local_map(), journal_->home_unknown()});
    }
  }
  subscribe_to_stages();
  const auto latest = Delivery::latest();
  subscribe<vehicle_state_t>(bus, channels::kVehicleState, latest,
                             [this](const VehicleState& s) { mission_.add_vehicle_state(s); });
  subscribe<gas_t>(bus, channels::kGas, latest,
                   [this](const GasReading& gas) { mission_.limits().add(gas); });
  subscribe<sinkage_t>(bus, channels::kSinkage, latest,
                       [this](const SinkageReading& s) { mission_.limits().add(s); });
  subscribe<heartbeat_t>(bus, channels::kHeartbeat, Delivery::queued(kQueueLength),
                         [this](const Heartbeat& heartbeat) { on_heartbeat(heartbeat); });
  subscribe<mission_order_t>(bus, channels::kMissionOrder, Delivery::queued(kQueueLength),
                             [this](const MissionOrder& order) {
                               mission_.add_order(order);
                               advance();
                             });
  bus.create_timer(kPeriodUs, [this](std::int64_t) { advance(); });
  if (!journal_) return;
  space_.emplace(params.journal, params.limits.disk_free_min_mb);
  bus.create_timer(kSpacePeriodUs, [this](std::int64_t) {
    mission_.limits().add_disk_failure(space_->shortage());
  });
}

void MissionNode::subscribe_to_stages() {
  const auto queued = Delivery::queued(kQueueLength);
  subscribe<pose_t>(bus_, channels::kPose, queued, [this](const StampedPose& pose) {
    const auto stored = mission_.add_pose(pose.utime, pose.T_odom_body, pose.z_m);
    if (stored) store(*stored);
  });
  subscribe<scan_match_t>(bus_, channels::kScanMatch, queued,
                          [this](const ScanMatch& match) { mission_.add_match(match); });
  subscribe<map_correction_t>(
      bus_, channels::kMapCorrection, queued,
      [this](const MapCorrection& correction) { on_correction(correction); });
  subscribe<exploration_t>(bus_, channels::kExploration, queued,
                           [this](const ExplorationReport& report) {
                             mission_.add_exploration(report);
                             advance();
                           });
  subscribe<terrain_ready_t>(bus_, channels::kTerrainReady, queued,
                             [this](const TerrainReady& terrain) {
                               mission_.add_cloud(terrain.id, terrain.complete);
                               mission_.add_terrain(terrain.utime, terrain.id);
                               advance();
                             });
  subscribe<planned_path_t>(bus_, channels::kPath, queued, [this](const PlannedPath& path) {
    mission_.add_path(path);
    advance();
  });
  subscribe<driving_state_t>(bus_, channels::kDrivingState, queued,
                             [this](const DrivingState& state) {
                               mission_.add_driving(state);
                               advance();
                             });
}

/// A map that the disk does not take is of no use to who waits for it outside.
void MissionNode::on_heartbeat(const Heartbeat& heartbeat) {
  const Health& health = heartbeat.health;
  if (health.level != Health::Level::kFault || !is_about_journal(health.reason)) return;
  mission_.limits().add_disk_failure("what " + heartbeat.stage +
                                     " publishes is not stored safely: " + health.reason);
}

/// What the mission has seen of the map is on disk before it is used: a map that has fewer local
/// maps after a restart has lost its end.
void MissionNode::on_correction(const MapCorrection& correction) {
  const KnownMap before = mission_.known_map();
  mission_.add_correction(correction);
  const KnownMap& known = mission_.known_map();
  if (known.newest_local_map != before.newest_local_map)
    store(NewestLocalMap{*known.newest_local_map});
  if (known.home_unknown && !before.home_unknown) store(HomeUnknown{*known.home_unknown});
}

void MissionNode::advance() {
  const std::int64_t utime = bus_.now_utime();
  const MissionRequests requests = mission_.advance(utime);
  publish_phase();
  if (requests.explore) publish(bus_, channels::kExploreRequest, to_message(*requests.explore));
  if (requests.scan) publish(bus_, channels::kScanRequest, to_message(*requests.scan));
  if (requests.goal) publish(bus_, channels::kGoal, to_message(*requests.goal));
}

/// A phase is stored before it is published, so that a restart never contradicts it.
void MissionNode::publish_phase() {
  const MissionPhase& phase = mission_.phase();
  const bool is_new = phase.sequence != published_sequence_;
  if (!is_new && bus_.now_utime() < published_utime_ + kPublishPeriodUs) return;
  if (is_new) store(phase);
  publish(bus_, channels::kPhase, to_message(phase));
  published_sequence_ = phase.sequence;
  published_utime_ = bus_.now_utime();
}

template <class Record>
void MissionNode::store(const Record& record) {
  if (!journal_) return;
  try {
    journal_->append(record);
    journal_failure_.clear();
  } catch (const std::exception& failure) {
    journal_failure_ = failure.what();
  }
  mission_.limits().add_disk_failure(storage_failure(journal_, journal_failure_));
}

Health MissionNode::health() const {
  using Level = Health::Level;
  const MissionPhase& phase = mission_.phase();
  const std::string not_stored = storage_failure(journal_, journal_failure_);
  if (!not_stored.empty()) return {Level::kFault, not_stored};
  if (phase.outcome == MissionOutcome::kStranded) return {Level::kFault, phase.reason};
  if (phase.outcome == MissionOutcome::kHomeUncertain) return {Level::kDegraded, phase.reason};
  if (phase.phase == Phase::kWaiting) {
    return {Level::kDegraded, "waiting for pose and driving: " + phase.reason};
  }
  if (mission_.home_unknown())
    return {Level::kDegraded, "the robot does not know where home is: " + *mission_.home_unknown()};
  if (journal_ && !journal_->damage().empty()) return {Level::kDegraded, journal_->damage()};
  return {};
}

}  // namespace adit
