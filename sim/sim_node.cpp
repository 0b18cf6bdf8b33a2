// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sim_node.hpp"

#include <algorithm>
#include <limits>

#include "adit/pose_t.hpp"

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/lidar.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "common/messages/sim.hpp"

namespace adit {
namespace {

/// TRUTH: in world instead of odom.
pose_t to_message(const BodyMotion& motion) {
  pose_t message{};
  message.utime = motion.utime;
  const Eigen::Quaterniond q(motion.T_world_body.linear());
  Eigen::Map<Eigen::Vector3d>(message.pos) = motion.T_world_body.translation();
  Eigen::Map<Eigen::Vector3d>(message.vel) = motion.v_body;
  Eigen::Map<Eigen::Vector4d>(message.orientation) = Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
  Eigen::Map<Eigen::Vector3d>(message.rotation_rate) = motion.omega_body;
  std::ranges::fill(message.accel, std::numeric_limits<double>::quiet_NaN());
  return message;
}

/// Publishes each kind of reading on its channel.
class Publisher {
 public:
  explicit Publisher(Bus& bus) : bus_(bus) {}

  void operator()(const LaserReading& laser) {
    const bool front = laser.laser == SimLaser::kFront;
    publish(bus_, front ? channels::kLaserFront : channels::kLaserRear,
            adit::to_message(laser.scan));
  }
  void operator()(const LidarRevolution& revolution) {
    for (const LidarFragment& fragment : split(revolution)) {
      publish(bus_, channels::kLidar, adit::to_message(fragment));
    }
  }
  void operator()(const LaserTiltReading& tilt) {
    const bool front = tilt.laser == SimLaser::kFront;
    publish(bus_, front ? channels::kTiltFront : channels::kTiltRear,
            adit::to_message(tilt.reading));
  }
  void operator()(const WheelOdometry& odometry) { send(channels::kWheelOdometry, odometry); }
  void operator()(const ImuReading& reading) { send(channels::kImu, reading); }
  void operator()(const GasReading& reading) { send(channels::kGas, reading); }
  void operator()(const SinkageReading& reading) { send(channels::kSinkage, reading); }
  void operator()(const VehicleState& state) { send(channels::kVehicleState, state); }
  void operator()(const RunState& state) { send(channels::kRunState, state); }
  void operator()(const BodyMotion& motion) { publish(bus_, channels::kTruth, to_message(motion)); }

 private:
  template <class Value>
  void send(std::string_view channel, const Value& value) {
    publish(bus_, channel, adit::to_message(value));
  }

  Bus& bus_;
};

}  // namespace

SimNode::SimNode(Bus& bus, const Site& site, const Params& params, std::uint64_t seed,
                 std::int64_t start_utime)
    : bus_(bus), simulation_(site, params, seed, start_utime), time_utime_(start_utime) {
  subscribe_commands();
}

void SimNode::subscribe_commands() {
  subscribe<drive_command_t>(bus_, channels::kDriveCommand, Delivery::latest(),
                             [this](const DriveCommand& command) { simulation_.command(command); });
  subscribe<stop_t>(bus_, channels::kStop, Delivery::latest(),
                    [this](const StopOrder& order) { simulation_.command(order); });
  const auto subscribe_tilt = [this](SimLaser laser, std::string_view channel) {
    subscribe<tilt_command_t>(
        bus_, channel, Delivery::latest(),
        [this, laser](const TiltCommand& command) { simulation_.command(laser, command); });
  };
  subscribe_tilt(SimLaser::kFront, channels::kTiltCommandFront);
  subscribe_tilt(SimLaser::kRear, channels::kTiltCommandRear);
}

void SimNode::step() {
  Publisher publish_reading(bus_);
  for (const Reading& reading : simulation_.step()) std::visit(publish_reading, reading);
  if (simulation_.utime() < time_utime_ + kTimePeriodUs) return;
  time_utime_ += kTimePeriodUs;
  publish_time();
}

void SimNode::publish_time() {
  publish(bus_, channels::kSimTime, adit::to_message(SimTime{time_utime_}));
}

Health SimNode::health() const {
  const std::string failure = simulation_.state().failure;
  if (failure.empty()) return {};
  return {Health::Level::kFault, failure};
}

}  // namespace adit
