// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check_driver/channel_reading.hpp"

#include <array>
#include <string>

#include "common/bus/channels.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/lidar.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

ChannelReading reading_of(const LaserScan& scan) {
  return {scan.utime, {scan.ranges_m.begin(), scan.ranges_m.end()}, scan, {}, {}};
}

ChannelReading reading_of(const TiltReading& tilt) {
  return {tilt.utime, {tilt.angle_rad, tilt.rate_rad_s}, {}, {}, {}};
}

ChannelReading reading_of(const ImuReading& imu) {
  const Eigen::Vector3d& turn = imu.angular_velocity;
  const Eigen::Vector3d& force = imu.linear_acceleration;
  return {
      imu.utime, {turn.x(), turn.y(), turn.z(), force.x(), force.y(), force.z()}, {}, turn.z(), {}};
}

ChannelReading reading_of(const WheelOdometry& wheels) {
  const Pose2& pose = wheels.T_wheel_body;
  return {wheels.utime, {pose.x, pose.y, pose.theta}, {}, {}, {}};
}

ChannelReading reading_of(const VehicleState& state) {
  return {state.utime, {state.speed_m_s, state.curvature_1_m, state.battery_share}, {}, {}, {}};
}

ChannelReading reading_of(const GasReading& gas) {
  return {gas.utime, {gas.methane_share, gas.oxygen_share, gas.carbon_monoxide_share}, {}, {}, {}};
}

ChannelReading reading_of(const SinkageReading& sinkage) {
  return {sinkage.utime, {sinkage.depth_m.begin(), sinkage.depth_m.end()}, {}, {}, {}};
}

ChannelReading reading_of(const LidarFragment& fragment) {
  return {fragment.part.utime, {}, {}, {}, fragment};
}

template <class Msg>
Result<ChannelReading> read(std::span<const std::uint8_t> bytes) {
  const Result<Msg> message = decode<Msg>(bytes);
  if (!message) return Rejected{message.rejection()};
  const auto value = from_message(*message);
  if (!value) return Rejected{value.rejection()};
  return reading_of(*value);
}

// From the first beam to the last a scan takes some milliseconds.
constexpr double kScanAgeMinMs = 2.0;
// A revolution takes 50 ms or more.
constexpr double kRevolutionAgeMinMs = 40.0;

// Timeouts: those of the guard by default, GuardParams.
constexpr double kTimeoutS = 0.25;
constexpr double kSlowTimeoutS = 1.5;

constexpr double kJitterMs = 2.0;
// A servo measures when it is asked, which is when its driver is scheduled; with the right stamps
// that is harmless.
constexpr double kAskedJitterMs = 8.0;

const std::array<DriverChannel, 10> kChannels{
    {{channels::kLaserFront, 5.0, kScanAgeMinMs, kTimeoutS, kJitterMs, read<planar_lidar_t>},
     {channels::kLaserRear, 5.0, kScanAgeMinMs, kTimeoutS, kJitterMs, read<planar_lidar_t>},
     {channels::kLidar, 1.0, kRevolutionAgeMinMs, kSlowTimeoutS, kJitterMs, read<spinning_lidar_t>},
     {channels::kTiltFront, 20.0, 0.0, kTimeoutS, kAskedJitterMs, read<tilt_t>},
     {channels::kTiltRear, 20.0, 0.0, kTimeoutS, kAskedJitterMs, read<tilt_t>},
     {channels::kWheelOdometry, 10.0, 0.0, 0.5, kJitterMs, read<wheel_odometry_t>},
     {channels::kImu, 50.0, 0.0, kTimeoutS, kJitterMs, read<imu_t>},
     {channels::kVehicleState, 5.0, 0.0, kTimeoutS, kJitterMs, read<vehicle_state_t>},
     {channels::kGas, 1.0, 0.0, kSlowTimeoutS, kJitterMs, read<gas_t>},
     {channels::kSinkage, 2.0, 0.0, kSlowTimeoutS, kJitterMs, read<sinkage_t>}}};

}  // namespace

std::span<const DriverChannel> driver_channels() { return kChannels; }

}  // namespace adit
