// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// check_standstill LOG CHANNEL EXPIRY: checks that the vehicle in a LOG of the simulator was
// driving at the last message on CHANNEL, stops within 300 ms after EXPIRY seconds without a
// message, remains stationary, and reports the stop. Exit code 1 if not.
#include <cmath>
#include <cstdint>
#include <exception>
#include <iostream>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sim.hpp"
#include "tests/live/checks/log_check.hpp"

namespace adit {
namespace {

constexpr double kStopTimeMaxS = 0.3;
constexpr double kDrivingSpeedMinM_S = 0.1;
constexpr double kStationaryS = 1.0;

struct LogSummary {
  std::optional<std::int64_t> last_utime;    // of the last message on the channel
  double speed_then_m_s = 0.0;               // at this message
  std::optional<std::int64_t> moving_utime;  // of the last motion
  std::int64_t end_utime = 0;
  VehicleState state;
  std::string failure;
};

LogSummary summarize(const LogFile& log, const std::string& channel) {
  LogSummary summary;
  double speed_m_s = 0.0;
  for (const LogEventView& event : log.events()) {
    summary.end_utime = event.utime;
    if (event.channel == channel) {
      summary.last_utime = event.utime;
      summary.speed_then_m_s = speed_m_s;
    } else if (event.channel == channels::kTruth) {
      const auto truth = value_of<pose_t>(event);
      speed_m_s = truth.v_body ? truth.v_body->head<2>().norm() : NAN;
      if (speed_m_s > 0.0) summary.moving_utime = event.utime;
    } else if (event.channel == channels::kVehicleState) {
      summary.state = value_of<vehicle_state_t>(event);
    } else if (event.channel == channels::kRunState) {
      summary.failure = value_of<run_state_t>(event).failure;
    }
  }
  return summary;
}

Requirements require;

int check(const std::string& path, const std::string& channel, double expiry_s) {
  const LogSummary summary = summarize(LogFile(path), channel);
  require(summary.last_utime && summary.moving_utime,
          "the log has messages on " + channel + ", and motion");
  if (!require.all_met()) return require.exit_code();
  const auto seconds = [](std::int64_t us) { return static_cast<double>(us) * 1e-6; };
  const double stopping_time_s = seconds(*summary.moving_utime - *summary.last_utime);
  std::cout << fmt::format("stopped {} s after the last {} (expiry {} s), from {} m/s\n",
                           stopping_time_s, channel, expiry_s, summary.speed_then_m_s);
  require(summary.speed_then_m_s > kDrivingSpeedMinM_S, "the vehicle drives");
  require(stopping_time_s <= expiry_s + kStopTimeMaxS, "the vehicle stops in time");
  require(seconds(summary.end_utime - *summary.moving_utime) > kStationaryS,
          "the vehicle remains stationary");
  require(summary.state.stopped, "the vehicle reports the stop");
  require(summary.failure.empty(), "no collision: " + summary.failure);
  return require.exit_code();
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::cerr << "check_standstill LOG CHANNEL EXPIRY\n";
    return 2;
  }
  return adit::check(argv[1], argv[2], std::stod(argv[3]));
} catch (const std::exception& error) {
  std::cerr << "check_standstill: " << error.what() << "\n";
  return 2;
}
