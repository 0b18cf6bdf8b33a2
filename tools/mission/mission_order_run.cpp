// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_order_run.hpp"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "common/bus/channels.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mission.hpp"
#include "tools/mission/mission_folder.hpp"
#include "tools/mission/private_network.hpp"

namespace adit {
namespace {

using Clock = std::chrono::steady_clock;
using Kind = MissionOrder::Kind;

constexpr int kRepeatMs = 200;

/// The id in mission.pid. Throws std::runtime_error if no such process exists.
pid_t process_of(const std::filesystem::path& folder) {
  pid_t pid = 0;
  std::ifstream(folder / "mission.pid") >> pid;
  if (pid <= 0 || !std::filesystem::exists("/proc/" + std::to_string(pid))) {
    throw std::runtime_error("no mission is running in " + folder.string());
  }
  return pid;
}

bool is_executed(Kind order, const MissionPhase& phase) {
  switch (order) {
    case Kind::kPause:
      return phase.phase == Phase::kPaused;
    case Kind::kResume:
      return phase.phase != Phase::kPaused;
    case Kind::kReturnHome:
      return phase.returning_home;
    case Kind::kStop:
      return phase.phase == Phase::kEnded;
  }
  return false;
}

std::string status_text(const MissionPhase& phase) {
  return phase.returning_home ? phase.reason + " (returning home: " + phase.return_home_reason + ")"
                              : phase.reason;
}

[[noreturn]] void fail(const std::optional<MissionPhase>& phase) {
  if (!phase) {
    throw std::runtime_error(
        "no mission responds on LCM; a mission started by adit mission is on a private network: "
        "use "
        "--mission DIR with its --out folder");
  }
  throw std::runtime_error("the mission did not execute the order: " + status_text(*phase));
}

}  // namespace

std::string order_mission(const MissionOrderOptions& options) {
  if (!options.mission.empty()) {
    enter_network_of(process_of(options.mission));
    unsetenv("LCM_DEFAULT_URL");
  }
  LcmBus bus({.url = options.lcm_url, .time = BusTime::kSimulated});
  std::optional<MissionPhase> phase;
  subscribe<phase_t>(bus, channels::kPhase, Delivery::latest(),
                     [&](const MissionPhase& received) { phase = received; });
  const auto deadline = Clock::now() + std::chrono::duration<double>(options.timeout_s);
  while (Clock::now() < deadline) {
    const auto utime = std::chrono::duration_cast<std::chrono::microseconds>(
        std::chrono::system_clock::now().time_since_epoch());
    publish(bus, channels::kMissionOrder, to_message(MissionOrder{utime.count(), options.order}));
    const auto repeat = Clock::now() + std::chrono::milliseconds(kRepeatMs);
    while (Clock::now() < repeat) bus.handle(kRepeatMs / 4);
    if (!phase) continue;
    if (is_executed(options.order, *phase)) return status_text(*phase);
    if (phase->phase == Phase::kEnded) {
      throw std::runtime_error("the mission has ended: " + phase->reason);
    }
  }
  fail(phase);
}

}  // namespace adit
