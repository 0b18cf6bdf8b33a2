// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/message_types.hpp"

#include "common/bus/channels.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/exploration.hpp"
#include "common/messages/fields/diagnostics_fields.hpp"
#include "common/messages/fields/mapping_fields.hpp"
#include "common/messages/fields/navigation_fields.hpp"
#include "common/messages/fields/procman_fields.hpp"
#include "common/messages/fields/sensing_fields.hpp"
#include "common/messages/lidar.hpp"
#include "common/messages/mapping/association.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/cloud_match.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "common/messages/mapping/volume.hpp"
#include "common/messages/mission.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/procman.hpp"
#include "common/messages/seal.hpp"
#include "common/messages/sensing.hpp"
#include "common/messages/sim.hpp"

namespace adit {
namespace {

constexpr std::int64_t kUtime = 1'600'000'000'000'000;

template <class Msg>
std::string_view process(std::span<const std::uint8_t> bytes) {
  const Result<Msg> message = decode<Msg>(bytes);
  return message ? from_message(*message).rejection() : message.rejection();
}

template <class Msg>
MessageType type_of(std::string_view channel, const Msg& sample) {
  return {Msg::getTypeName(), std::string(channel), Msg::getHash(),
          encode(sample),     process<Msg>,         field_layout<Msg>};
}

ScanMatch sample_match() {
  ScanMatch report;
  report.utime = kUtime;
  report.reference_utime = kUtime - 13'333;
  report.odom_epoch_utime = kUtime - 40'000;
  report.channel = channels::kLaserFront;
  report.status = ScanMatch::Status::kMatched;
  report.T_odom_body = {12.0, -3.0, 0.7};
  report.T_reference_body = {0.01, 0.0, 0.001};
  report.covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-6).asDiagonal();
  report.inlier_share = 0.93;
  report.rms_residual_m = 0.012;
  report.degenerate = {{Eigen::Vector3d::UnitX(), DegenerateDirection::Fill::kOdometry},
                       {Eigen::Vector3d::UnitY(), DegenerateDirection::Fill::kNone}};
  report.iterations = 7;
  report.points = 171;
  return report;
}

MatchDoubt sample_doubt() {
  const MatchDoubt::Alternative turned{{12.0, -3.0, -0.9}, 0.71};
  return {kUtime, kUtime - 1'000'000, MatchDoubt::Reason::kAmbiguous, {turned, turned}};
}

const Eigen::Matrix3d kCovariance = Eigen::Vector3d(1e-2, 1e-2, 1e-4).asDiagonal();
const Eigen::Matrix3d kInformation = Eigen::Vector3d(400.0, 400.0, 1e4).asDiagonal();

LocalMap sample_local_map() {
  const LaserScan scan{kUtime, std::vector<float>(12, 5.0F), -1.5, 0.0087};
  LocalMap map;
  map.id = 7;
  map.utime = kUtime;
  map.end_utime = kUtime + 1'000'000;
  map.T_odom_local = {12.0, -3.0, 0.7};
  map.T_previous_local = {5.0, 0.1, 0.02};
  map.information = kInformation;
  map.scans = {{"LASER_FRONT", scan, {0.1, 0.0, 0.0}}, {"LASER_REAR", scan, {0.2, 0.0, 0.01}}};
  return map;
}

MapGraph sample_graph() {
  const PoseConstraint sequential{0, 1, {5.0, 0.0, 0.0}, kInformation};
  const PoseConstraint loop_closure{2, 0, {-10.0, 0.0, 0.0}, kInformation};
  return {kUtime,
          12,
          {{0.0, 0.0, 0.0}, {5.0, 0.0, 0.0}, {10.0, 0.1, 0.0}},
          {{sequential, MapConstraint::Kind::kSequential},
           {loop_closure, MapConstraint::Kind::kLoopClosure}}};
}

Association sample_association() {
  Association association;
  association.utime = kUtime;
  association.action = Association::Action::kRevised;
  association.loop_closure = {
      3, 40, {{7, {0.4, 0.1, 0.0}, kInformation, 31.0}, {9, {0.0, 0.0, 0.1}, kInformation, 12.0}}};
  association.chosen = 1;
  association.previously_chosen = 0;
  association.log_likelihood = -120.5;
  association.reason = "the corner does not agree";
  return association;
}

/// Types for the control and state of the vehicle.
std::vector<MessageType> vehicle_types() {
  const DriveCommand drive{kUtime, 0.4, -0.2};
  const StopOrder stop{kUtime, true, "a wall is near"};
  const TiltCommand tilt{kUtime, -0.3, 0.2};
  const VehicleState vehicle{kUtime, 0.4, -0.2, 0.83, false, true};
  const GasReading gas{kUtime, 0.011, 0.198, 0.00002};
  const SinkageReading sinkage{kUtime, {0.0, 0.01, 0.12, 0.0}};
  return {type_of(channels::kDriveCommand, to_message(drive)),
          type_of(channels::kStop, to_message(stop)),
          type_of(channels::kTiltCommandFront, to_message(tilt)),
          type_of(channels::kVehicleState, to_message(vehicle)),
          type_of(channels::kGas, to_message(gas)),
          type_of(channels::kSinkage, to_message(sinkage))};
}

Cloud sample_cloud() {
  const CloudLine line{kUtime - 5, {1.0F, 0.0F, 0.6F}, {{3.0F, 1.0F, 0.0F}}, {{1.0F, 0.0F, 0.0F}}};
  return {kUtime, 3, {12.0, -3.0, 0.7}, true, {line, line}};
}

TerrainMap sample_terrain() {
  const TerrainCell cell{Ground::kObserved, 12, 0.01F, 0.11F, 0.1F, 1.7F, 0.02F, 0.05F, 0.03F};
  return {kUtime, 3, {12.0, -3.0, 0.7}, {-1.0, -1.0}, 0.1, {3, 2, cell}};
}

Volume sample_volume() {
  // The first child of the root is free, the last one occupied.
  const std::int64_t eighth = std::int64_t{1} << 45;
  return {kUtime, 3, 1, 12, 7, {12.0, -3.0, 0.7}, 0.1, eighth, eighth, {0x01, 0x80}};
}

PlannedPath sample_path() {
  PlannedPath path;
  path.utime = kUtime;
  path.id = 4;
  path.outcome = PlanOutcome::kFound;
  path.points = {{{12.0, -3.0, 0.7}, 0.2, false, 0.4, 0.0},
                 {{12.3, -2.8, 0.8}, 0.0, true, 0.3, 9.5}};
  path.reached_m = 9.6;
  path.blocking = {{{14.0, 1.0}, BlockingCell::Reason::kRoof, 0.8}};
  return path;
}

ExplorationReport sample_exploration() {
  ExplorationReport report;
  report.utime = kUtime;
  report.revision = 12;
  report.request = 6;
  report.decision = {
      ExplorationDecision::Kind::kAlong, {20.0, -3.0, 0.1}, 12.5, 1, false, "straight on"};
  report.T_odom_goal = {20.1, -2.9, 0.1};
  report.route_odom = {{12.0, -3.0}, {16.5, -2.5}, {20.0, -3.0}};
  report.budget = {800.0, 310.0};
  report.frontiers = {{0, 3, {5, 1}, {0, 1}, 2.8, FrontierState::kBlocked, kUtime, "a beam"},
                      {1, 7, {20, -3}, {1, 0}, 3.1, FrontierState::kOpen, kUtime, ""}};
  report.corridors = {{{{0, 0}, CorridorNode::Kind::kDeadEnd}, {{20, -3}, {}}},
                      {{0, 1, 20.4, 2.9, {{0, 0}, {10, -1}, {20, -3}}}}};
  return report;
}

/// Types from a 3D scan to a drive, and of exploration.
std::vector<MessageType> navigation_types() {
  const PlanGoal goal{
      kUtime, 4, PlanGoal::Kind::kRoute, {20.0, -3.0, 0.1}, 10.0, {{12.0, -3.0}, {20.0, -3.0}}};
  const DrivingState driving{
      kUtime, 4, DrivingState::Kind::kWaiting, "the pose is old", 2.5, 7.1, {0.02, -0.01}};
  return {type_of(channels::kScanRequest, to_message(ScanRequest{kUtime, 3, LaserId::kFront})),
          type_of(channels::kCloud, to_message(split(sample_cloud()).front())),
          type_of(channels::kCloudRequest, to_message(CloudRequest{kUtime, 0, {kUtime - 1}})),
          type_of(channels::kCloudResend, to_message(split(sample_cloud()).front())),
          type_of(channels::kTerrain, to_message(split(sample_terrain()).front())),
          type_of(channels::kTerrainReady, to_message(TerrainReady{kUtime, 3, true})),
          type_of(channels::kVolume, to_message(split(sample_volume()).front())),
          type_of(channels::kGoal, to_message(goal)),
          type_of(channels::kPath, to_message(sample_path())),
          type_of(channels::kDrivingState, to_message(driving)),
          type_of(channels::kExploration, to_message(sample_exploration()))};
}

/// Types of the mission stage.
std::vector<MessageType> mission_types() {
  MissionPhase phase;
  phase.utime = kUtime;
  phase.sequence = 17;
  phase.phase = Phase::kExecute;
  phase.reason = "a path of 8.1 m";
  phase.returning_home = true;
  phase.return_home_reason = "the route ahead is blocked";
  phase.laser = LaserId::kRear;
  phase.goal_id = 4;
  phase.scans = 5;
  phase.distance_travelled_m = 40.5;
  phase.remaining_m = 800.0;
  const ExploreRequest request{kUtime, 6, 800.0, true, BlockedVerdict{kUtime, 1, 1.4, "a beam"}};
  const MissionOrder order{kUtime, MissionOrder::Kind::kReturnHome};
  return {type_of(channels::kPhase, to_message(phase)),
          type_of(channels::kExploreRequest, to_message(request)),
          type_of(channels::kMapRequest, to_message(MapRequest{kUtime, "exploration"})),
          type_of(channels::kMissionOrder, to_message(order))};
}

/// Types of a simulated run.
std::vector<MessageType> simulation_types() {
  const RunState state{kUtime, 120.5, "hit a post"};
  return {type_of(channels::kRunState, to_message(state)),
          type_of(channels::kSimTime, to_message(SimTime{kUtime})),
          type_of(channels::kSimTimeDone, to_message(SimTimeDone{kUtime, "mapping"}))};
}

/// Types of sealed orders.
std::vector<MessageType> seal_types() {
  SealNonce nonce{};
  for (std::size_t i = 0; i < nonce.size(); ++i) nonce.at(i) = static_cast<std::uint8_t>(i + 1);
  return {type_of(channels::kSealChallenge, to_message(SealChallenge{kUtime, nonce}))};
}

/// Types of procman.
std::vector<MessageType> procman_types() {
  const ProcmanCommand command{"mapping", "adit-mapping --sim-time", "slam", true, 15, 3.0};
  const ProcmanInfo info{kUtime,
                         "robot",
                         {0.4, 8'000'000'000, 3'000'000'000, 0, 0},
                         {{command, 4711, 3, 9, 0.7, 120'000'000, 40'000'000}}};
  const ProcmanOrders orders{kUtime, "robot", "base", {{command, 4, false}, {command, 4, true}}};
  const ProcmanOutput output{kUtime, "robot", {{"mapping", "a loop"}, {"terrain", "no cloud"}}};
  std::vector<MessageType> types{
      type_of(channels::kPmInfo, to_message(info)),
      type_of(channels::kPmOrders, to_message(orders)),
      type_of(channels::kPmOutput, to_message(output)),
      type_of(channels::kPmDiscover, to_message(ProcmanDiscovery{kUtime, "base", 77}))};
  for (MessageType& type : types) type.package = "procman_lcm";
  return types;
}

std::vector<MessageType> stage_types() {
  const LaserScan scan{kUtime, std::vector<float>(40, 5.0F), -1.5, 0.0087};
  const LidarRevolution revolution{kUtime,
                                   {{-0.02F, 0.0F, 0.0F}, {0.02F, 0.001F, 2.3F}},
                                   {{0, 3.1F}, {55, 3.09F}, {110, 3.08F}},
                                   {5.0F, 5.1F, 5.2F, 5.3F, 5.4F, 5.5F}};
  const StampedPose pose{kUtime, {12.0, -3.0, 0.7}, Eigen::Vector3d(0.5, 0.0, 0.1)};
  const WheelOdometry odometry{kUtime, {1.0, 2.0, 0.5}};
  const ImuReading imu{kUtime, {0.0, 0.1, 0.2}, {0.1, 0.0, 9.81}};
  const TiltReading tilt{kUtime, 0.3, -0.1};
  const Heartbeat heartbeat{kUtime, "mapping", {Health::Level::kDegraded, "no odometry"}, 9, 1, 2};
  const ConfigSnapshot config{kUtime, "mapping", "0.1.0", "mapping:\n  cell_m: 0.1\n"};
  const MapCorrection correction{kUtime, 12, 0, 40, {0.3, -0.2, 0.01}, kCovariance};
  const MapContradictions contradictions{kUtime, 12, {{3, 40, 55.5}, {4, 41, 31.25}}};
  const CloudMatch cloud_match{{kUtime - 5, 3, 0.1, 2.0}, {kUtime, 4, 0.0, 0.0}, {5.0, 0.2, 0.1}};
  const StageStats stats{kUtime,
                         "mapping",
                         5.0,
                         {{"POSE", 370, 1, 2, 0.4, 3.1}, {"LASER_FRONT", 375, 0, 0, 0.9, 5.0}}};
  return {type_of(channels::kLaserFront, to_message(scan)),
          type_of(channels::kLidar, to_message(split(revolution).front())),
          type_of(channels::kPose, to_message(pose)),
          type_of(channels::kWheelOdometry, to_message(odometry)),
          type_of(channels::kImu, to_message(imu)),
          type_of(channels::kTiltFront, to_message(tilt)),
          type_of(channels::kScanMatch, to_message(sample_match())),
          type_of(channels::kMatchDoubt, to_message(sample_doubt())),
          type_of(channels::kLocalMap, to_message(split(sample_local_map()).front())),
          type_of(channels::kPoseGraph, to_message(split(sample_graph()).front())),
          type_of(channels::kMapCorrection, to_message(correction)),
          type_of(channels::kAssociation, to_message(sample_association())),
          type_of(channels::kContradictions, to_message(contradictions)),
          type_of(channels::kCloudMatch, to_message(cloud_match)),
          type_of(channels::kHeartbeat, to_message(heartbeat)),
          type_of(channels::kConfig, to_message(config)),
          type_of(channels::kStageStats, to_message(stats))};
}

}  // namespace

std::vector<MessageType> message_types() {
  std::vector<MessageType> types = stage_types();
  for (const auto& more : {vehicle_types(), navigation_types(), mission_types(), simulation_types(),
                           seal_types(), procman_types()}) {
    types.insert(types.end(), more.begin(), more.end());
  }
  return types;
}

}  // namespace adit
