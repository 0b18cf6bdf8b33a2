// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>

/// The channels of the pipeline; lcmtypes/README.md lists their types, publishers and subscribers.
namespace adit::channels {

inline constexpr std::string_view kLaserFront = "LASER_FRONT";
inline constexpr std::string_view kLaserRear = "LASER_REAR";
inline constexpr std::string_view kLidar = "LIDAR";
inline constexpr std::string_view kPose = "POSE";
inline constexpr std::string_view kTiltFront = "TILT_FRONT";
inline constexpr std::string_view kTiltRear = "TILT_REAR";
inline constexpr std::string_view kWheelOdometry = "WHEEL_ODOMETRY";
inline constexpr std::string_view kImu = "IMU";
inline constexpr std::string_view kScanMatch = "SCAN_MATCH";
inline constexpr std::string_view kMatchDoubt = "MATCH_DOUBT";
inline constexpr std::string_view kLocalMap = "LOCAL_MAP";
inline constexpr std::string_view kPoseGraph = "POSE_GRAPH";
inline constexpr std::string_view kMapCorrection = "MAP_CORRECTION";
inline constexpr std::string_view kAssociation = "ASSOCIATION";
inline constexpr std::string_view kCloudMatch = "CLOUD_MATCH";
inline constexpr std::string_view kContradictions = "CONTRADICTIONS";
inline constexpr std::string_view kDriveCommand = "DRIVE_COMMAND";
inline constexpr std::string_view kStop = "STOP";
inline constexpr std::string_view kTiltCommandFront = "TILT_COMMAND_FRONT";
inline constexpr std::string_view kTiltCommandRear = "TILT_COMMAND_REAR";
inline constexpr std::string_view kScanRequest = "SCAN_REQUEST";
inline constexpr std::string_view kCloud = "CLOUD";
inline constexpr std::string_view kCloudRequest = "CLOUD_REQUEST";
inline constexpr std::string_view kCloudResend = "CLOUD_RESEND";
inline constexpr std::string_view kTerrain = "TERRAIN";
inline constexpr std::string_view kTerrainReady = "TERRAIN_READY";
inline constexpr std::string_view kVolume = "VOLUME";
inline constexpr std::string_view kGoal = "GOAL";
inline constexpr std::string_view kPath = "PATH";
inline constexpr std::string_view kDrivingState = "DRIVING_STATE";
inline constexpr std::string_view kExploration = "EXPLORATION";
inline constexpr std::string_view kPhase = "PHASE";
inline constexpr std::string_view kExploreRequest = "EXPLORE_REQUEST";
inline constexpr std::string_view kMapRequest = "MAP_REQUEST";
inline constexpr std::string_view kMissionOrder = "MISSION_ORDER";
inline constexpr std::string_view kVehicleState = "VEHICLE_STATE";
inline constexpr std::string_view kGas = "GAS";
inline constexpr std::string_view kSinkage = "SINKAGE";
inline constexpr std::string_view kTruth = "TRUTH";
inline constexpr std::string_view kRunState = "RUN_STATE";
inline constexpr std::string_view kSimTime = "SIM_TIME";
inline constexpr std::string_view kSimTimeDone = "SIM_TIME_DONE";
inline constexpr std::string_view kHeartbeat = "HEARTBEAT";
inline constexpr std::string_view kConfig = "CONFIG";
inline constexpr std::string_view kStageStats = "STAGE_STATS";
inline constexpr std::string_view kSealChallenge = "SEAL_CHALLENGE";
inline constexpr std::string_view kSealAnswer = "SEAL_ANSWER";
inline constexpr std::string_view kPmInfo = "PM_INFO";
inline constexpr std::string_view kPmOrders = "PM_ORDERS";
inline constexpr std::string_view kPmOutput = "PM_OUTPUT";
inline constexpr std::string_view kPmDiscover = "PM_DISCOVER";

/// All channels.
inline constexpr std::array kAll{kLaserFront,
                                 kLaserRear,
                                 kLidar,
                                 kPose,
                                 kTiltFront,
                                 kTiltRear,
                                 kWheelOdometry,
                                 kImu,
                                 kScanMatch,
                                 kLocalMap,
                                 kPoseGraph,
                                 kMapCorrection,
                                 kAssociation,
                                 kDriveCommand,
                                 kStop,
                                 kTiltCommandFront,
                                 kTiltCommandRear,
                                 kVehicleState,
                                 kGas,
                                 kSinkage,
                                 kTruth,
                                 kRunState,
                                 kSimTime,
                                 kSimTimeDone,
                                 kScanRequest,
                                 kCloud,
                                 kTerrain,
                                 kVolume,
                                 kGoal,
                                 kPath,
                                 kDrivingState,
                                 kHeartbeat,
                                 kConfig,
                                 kStageStats,
                                 kPmInfo,
                                 kPmOrders,
                                 kPmOutput,
                                 kPmDiscover,
                                 kExploration,
                                 kPhase,
                                 kExploreRequest,
                                 kMapRequest,
                                 kMissionOrder,
                                 kCloudRequest,
                                 kCloudResend,
                                 kTerrainReady,
                                 kMatchDoubt,
                                 kContradictions,
                                 kCloudMatch,
                                 kSealChallenge,
                                 kSealAnswer};

}  // namespace adit::channels
