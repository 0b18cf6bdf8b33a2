// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// check_stand LOG CHANNEL EXPIRY: whether the vehicle in a simulator's LOG drove when the last
// message came on CHANNEL, stands within 300 ms after this has been so for EXPIRY seconds, for
// good, and says why it stands. Ends with 1 if not.
#include <cmath>
#include <cstdint>
#include <exception>
#include <iostream>
#include <optional>
#include <string>

#include "common/bus/channels.hpp"
#include "common/bus/event_source.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/pose.hpp"
#include "common/messages/run_state.hpp"
#include "common/messages/vehicle_state.hpp"
#include "tests/live/log_check.hpp"

namespace adit {
namespace {

constexpr double kSoonS = 0.3;
constexpr double kDroveM_S = 0.1;
constexpr double kForGoodS = 1.0;

struct Seen {
  std::optional<std::int64_t> last_utime;    // of a message on the channel
  double speed_then_m_s = 0.0;               // when it came
  std::optional<std::int64_t> moving_utime;  // last
  std::int64_t end_utime = 0;
  VehicleState state;
  std::string failure;
};

Seen look(const LogFile& log, const std::string& channel) {
  Seen seen;
  double speed_m_s = 0.0;
  for (const LogEventView& event : log.events()) {
    seen.end_utime = event.utime;
    if (event.channel == channel) {
      seen.last_utime = event.utime;
      seen.speed_then_m_s = speed_m_s;
    } else if (event.channel == channels::kTruth) {
      const auto truth = value_of<pose_t>(event);
      speed_m_s = truth.v_body ? truth.v_body->head<2>().norm() : NAN;
      if (speed_m_s > 0.0) seen.moving_utime = event.utime;
    } else if (event.channel == channels::kVehicleState) {
      seen.state = value_of<vehicle_state_t>(event);
    } else if (event.channel == channels::kRunState) {
      seen.failure = value_of<run_state_t>(event).failure;
    }
  }
  return seen;
}

Requirements require;

int check(const std::string& path, const std::string& channel, double expiry_s) {
  const Seen seen = look(LogFile(path), channel);
  require(seen.last_utime && seen.moving_utime, "there is " + channel + " and motion in the log");
  if (!require.hold()) return require.exit_code();
  const auto seconds = [](std::int64_t us) { return static_cast<double>(us) * 1e-6; };
  const double stood_s = seconds(*seen.moving_utime - *seen.last_utime);
  std::cout << "stood " << stood_s << " s after the last " << channel << ", of which " << expiry_s
            << " s are allowed to pass, at " << seen.speed_then_m_s << " m/s\n";
  require(seen.speed_then_m_s > kDroveM_S, "the vehicle drove");
  require(stood_s <= expiry_s + kSoonS, "it stands soon");
  require(seconds(seen.end_utime - *seen.moving_utime) > kForGoodS, "and for good");
  require(seen.state.stopped, "it says that it is held");
  require(seen.failure.empty(), "it touched nothing: " + seen.failure);
  return require.exit_code();
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::cerr << "check_stand LOG CHANNEL EXPIRY\n";
    return 2;
  }
  return adit::check(argv[1], argv[2], std::stod(argv[3]));
} catch (const std::exception& error) {
  std::cerr << "check_stand: " << error.what() << "\n";
  return 2;
}
