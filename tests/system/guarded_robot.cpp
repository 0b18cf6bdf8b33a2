// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/system/guarded_robot.hpp"

#include <cmath>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/geometry/pose2.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "tests/support/robots/simulated_robot.hpp"

namespace adit {
namespace {

constexpr double kStepS = 0.01;
constexpr double kStationaryS = 2.0;

}  // namespace

GuardedRobot::GuardedRobot(World world, const SimulationParams& params)
    : robot_(std::move(world), params), guard_(robot_.bus(), with_groundhog_lasers<GuardParams>()) {
  subscribe_all();
  robot_.bus().create_timer(50'000, [this](std::int64_t utime) { command(utime); });
  robot_.bus().create_timer(1'000'000, [this](std::int64_t utime) {
    if (!supervised_) return;
    publish(robot_.bus(), channels::kHeartbeat,
            to_message(Heartbeat{utime, "supervisor", {}, 0, 0, 0}));
  });
}

void GuardedRobot::subscribe_all() {
  MemoryBus& bus = robot_.bus();
  for (const std::string_view channel :
       {channels::kLaserFront, channels::kLaserRear, channels::kPose, channels::kDriveCommand,
        channels::kHeartbeat}) {
    bus.subscribe(channel, Delivery::latest(), [this](const ReceivedMessage& received) {
      received_utime_[std::string(received.channel)] = received.utime;
      return std::string_view();
    });
  }
  subscribe<stop_t>(bus, channels::kStop, Delivery::queued(10), [this](const StopOrder& order) {
    if (order.stopped && !order_.stopped) ++stops_;
    order_ = order;
  });
  subscribe<gas_t>(bus, channels::kGas, Delivery::latest(),
                   [this](const GasReading& reading) { gas_ = reading; });
  subscribe<sinkage_t>(bus, channels::kSinkage, Delivery::latest(),
                       [this](const SinkageReading& reading) { sinkage_ = reading; });
}

void GuardedRobot::command(std::int64_t utime) {
  if (!commands_) return;
  const double curvature = curvature_1_m_.value_or(curvature_to_centre_line());
  publish(robot_.bus(), channels::kDriveCommand,
          to_message(DriveCommand{utime, speed_m_s_, curvature}));
}

double GuardedRobot::curvature_to_centre_line() const {
  const Pose2 T_world_body = in_plan(motion().T_world_body);
  const double sign = speed_m_s_ < 0.0 ? -1.0 : 1.0;
  return -0.5 * T_world_body.y - 1.5 * sign * T_world_body.theta;
}

void GuardedRobot::run(double seconds) {
  for (int i = 0; i < std::lround(seconds / kStepS); ++i) robot_.run(kStepS);
}

std::optional<double> GuardedRobot::seconds_to_standstill(const std::function<bool()>& condition,
                                                          double seconds_max) {
  std::optional<double> condition_s;
  std::optional<double> stopping_time_s;
  for (double s = 0.0; s < seconds_max + kStationaryS; s += kStepS) {
    robot_.run(kStepS);
    if (speed_m_s() > 0.0) stopping_time_s.reset();
    if (speed_m_s() == 0.0 && !stopping_time_s) stopping_time_s = s;
    if (!condition_s && condition()) condition_s = s;
    if (condition_s && stopping_time_s && s - *stopping_time_s >= kStationaryS)
      return *stopping_time_s - *condition_s;
  }
  return std::nullopt;
}

double GuardedRobot::message_age_s(std::string_view channel) const {
  const auto found = received_utime_.find(channel);
  if (found == received_utime_.end()) return 0.0;
  return static_cast<double>(robot_.simulation().utime() - found->second) * 1e-6;
}

const BodyMotion& GuardedRobot::motion() const { return robot_.simulation().vehicle().motion(); }

double GuardedRobot::speed_m_s() const { return motion().v_body.norm(); }

}  // namespace adit
