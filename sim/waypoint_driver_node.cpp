// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/waypoint_driver_node.hpp"

#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/navigation.hpp"

namespace adit {
namespace {

BodyMotion motion_of(const pose_t& truth) {
  BodyMotion motion;
  motion.utime = truth.utime;
  const auto& q = truth.orientation;
  motion.T_world_body.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  motion.T_world_body.translation() = Eigen::Vector3d(truth.pos);
  motion.v_body = Eigen::Vector3d(truth.vel);
  motion.omega_body = Eigen::Vector3d(truth.rotation_rate);
  return motion;
}

}  // namespace

WaypointDriverNode::WaypointDriverNode(Bus& bus, WaypointDriver driver)
    : bus_(bus), driver_(std::move(driver)) {
  bus_.subscribe(channels::kTruth, Delivery::latest(),
                 [this](const ReceivedMessage& received) -> std::string_view {
                   const auto message = decode<pose_t>(received.bytes);
                   if (!message) return message.rejection();
                   const auto planar = from_message(*message);
                   if (!planar) return planar.rejection();
                   drive(motion_of(*message));
                   return {};
                 });
}

void WaypointDriverNode::drive(const BodyMotion& motion) {
  publish(bus_, channels::kDriveCommand, to_message(driver_.command(motion)));
}

}  // namespace adit
