// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/reading_times.hpp"

#include "common/bus/channels.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/fields/quantities.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

bool is_laser(const LogEventView& event) { return laser_from_channel(event.channel).has_value(); }

/// Calls `use` with the decoded message of a reading; false if it cannot be decoded.
template <class Use>
bool with_message(const LogEventView& reading, const Use& use) {
  const auto decoded = [&]<class Message>(const Result<Message>& message) {
    if (message) use(*message);
    return static_cast<bool>(message);
  };
  if (is_laser(reading)) return decoded(decode<planar_lidar_t>(reading.data));
  if (reading.channel == channels::kImu) return decoded(decode<imu_t>(reading.data));
  return decoded(decode<wheel_odometry_t>(reading.data));
}

std::int64_t plausible(std::int64_t utime) { return is_plausible_utime(utime) ? utime : 0; }

}  // namespace

bool is_reading(const LogEventView& event) {
  return is_laser(event) || event.channel == channels::kWheelOdometry ||
         event.channel == channels::kImu;
}

RecordedTimes recorded_times(const LogEventView& reading) {
  RecordedTimes times{0, plausible(reading.utime)};
  with_message(reading,
               [&](const auto& message) { times.measured_utime = plausible(message.utime); });
  return times;
}

void add_times(const LogEventView& event, TimeJudge& judge) {
  if (is_laser(event)) {
    const auto message = decode<planar_lidar_t>(event.data);
    if (!message) return;
    judge.add_scan(event.channel, {plausible(message->utime), plausible(event.utime)},
                   message->radstep);
  } else if (event.channel == channels::kWheelOdometry) {
    const auto message = decode<wheel_odometry_t>(event.data);
    if (!message) return;
    const Pose2 T_wheel_body{message->x_m, message->y_m, message->theta_rad};
    judge.add_reading(event.channel, {plausible(message->utime), plausible(event.utime)},
                      &T_wheel_body);
  } else if (is_reading(event)) {
    judge.add_reading(event.channel, recorded_times(event));
  }
}

std::optional<LogEventView> RestampedEvents::next() {
  auto event = source_->next();
  if (!event || !is_reading(*event)) return event;
  const std::int64_t utime = event->utime;
  const bool decoded = with_message(*event, [&](auto message) {
    message.utime = utime;
    bytes_ = encode(message);
  });
  if (decoded) event->data = bytes_;
  return event;
}

}  // namespace adit
