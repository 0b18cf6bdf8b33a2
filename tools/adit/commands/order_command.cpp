// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/bus/order_seal.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/command_line/command_line.hpp"
#include "common/messages/mission.hpp"
#include "common/service/wall_time.hpp"
#include "common/text/message_text.hpp"
#include "common/types/mission.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/mission/private_network.hpp"

namespace adit {
namespace {

constexpr int kRepeatMs = 200;

/// An order of the operator to a mission on LCM.
struct MissionOrderOptions {
  MissionOrder::Kind order = MissionOrder::Kind::kPause;
  std::filesystem::path mission;  ///< folder of a mission on a private network; empty: this network
  std::string lcm_url;            ///< empty: LCM's default
  SealParams seal;
  double timeout_s = 10.0;  ///< of wall time
};

const std::map<std::string, MissionOrder::Kind> kOrders{{"pause", MissionOrder::Kind::kPause},
                                                        {"resume", MissionOrder::Kind::kResume},
                                                        {"return", MissionOrder::Kind::kReturnHome},
                                                        {"stop", MissionOrder::Kind::kStop}};

constexpr const char* kOrderDetails =
    R"(Orders:
  pause   stop the vehicle until the order resume
  resume  continue after a pause, or start a mission that waits for this order
  return  return to the start; this cannot be undone
  stop    stop the vehicle and end the mission in place; the robot does not return

The order is repeated until the mission executes it; the new phase is printed. A robot with sealed orders
executes those sealed with its --key only. Orders require a network
connection to the robot: use them at the surface and in simulation.)";

constexpr const char* kOrderExamples =
    R"(  adit order return                          the mission on this network
  adit order resume --key seal.key           a robot with sealed orders
  adit order pause --mission out             the mission of `adit mission mathies --out out`)";

std::string status_text(const MissionPhase& phase) {
  if (!phase.returning_home) return phase.reason;
  return fmt::format("{} (returning home: {})", phase.reason, phase.return_home_reason);
}

[[noreturn]] void fail_order(const std::optional<MissionPhase>& phase) {
  if (!phase) {
    throw std::runtime_error(
        "no mission responds on LCM; a mission started by adit mission is on a private network: "
        "use --mission DIR with its --out folder");
  }
  throw std::runtime_error(
      fmt::format("the mission did not execute the order: {}", status_text(*phase)));
}

/// Repeats the order until PHASE confirms it. Returns the reason in PHASE, a sentence. Throws
/// std::runtime_error if no mission responds, the order is not executed within the timeout, or the
/// mission has ended.
std::string order_mission(const MissionOrderOptions& options) {
  using Clock = std::chrono::steady_clock;
  if (!options.mission.empty()) enter_network_of_mission(options.mission);
  LcmBus bus({.url = options.lcm_url, .time = BusTime::kSimulated, .seal = options.seal.read()});
  std::optional<MissionPhase> phase;
  subscribe<phase_t>(bus, channels::kPhase, Delivery::latest(),
                     [&](const MissionPhase& received) { phase = received; });
  const auto deadline = Clock::now() + std::chrono::duration<double>(options.timeout_s);
  while (Clock::now() < deadline) {
    publish(bus, channels::kMissionOrder, to_message(MissionOrder{wall_utime(), options.order}));
    const auto repeat = Clock::now() + std::chrono::milliseconds(kRepeatMs);
    while (Clock::now() < repeat) bus.handle(kRepeatMs / 4);
    if (!phase) continue;
    if (is_executed(options.order, *phase)) return status_text(*phase);
    if (phase->phase == Phase::kEnded) {
      throw std::runtime_error(fmt::format("the mission has ended: {}", phase->reason));
    }
  }
  fail_order(phase);
}

}  // namespace

void add_order_command(CLI::App& adit) {
  CLI::App* command =
      add_command(adit, "order", "Order a mission to pause, resume, return or stop");
  set_help(*command, {kOrderDetails, "", kOrderExamples});
  const auto options = std::make_shared<MissionOrderOptions>();
  command
      ->add_option_function<std::string>(
          "ORDER", [options](const std::string& order) { options->order = kOrders.at(order); },
          "What the mission shall do")
      ->check(CLI::IsMember(kOrders))
      ->required();
  command->add_option("--mission", options->mission, "Output folder of a running adit mission")
      ->type_name("DIR");
  command
      ->add_option("--timeout-s", options->timeout_s,
                   "Maximum time until the mission executes the order")
      ->type_name("SECONDS")
      ->check(number_in(above(0.0)))
      ->capture_default_str();
  command->add_option("--lcm-url", options->lcm_url, "LCM network, instead of the default")
      ->type_name("URL");
  add_key_option(*command, options->seal.key);
  command->callback([options] { std::cout << message_line(order_mission(*options)) << "\n"; });
}

}  // namespace adit
