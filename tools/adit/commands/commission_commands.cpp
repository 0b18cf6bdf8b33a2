// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/command_line/command_line.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/navigation.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/check_driver/driver_check.hpp"
#include "tools/commission/motion_check.hpp"
#include "tools/commission/stop_check.hpp"
#include "tools/mission/private_network.hpp"

namespace adit {
namespace {

constexpr int kExitFailed = 1;

/// Where the messages come from.
struct SourceOptions {
  double seconds = 60.0;
  std::filesystem::path log;      ///< empty: live
  std::filesystem::path mission;  ///< folder of a mission on a private network; empty: this network
  std::string lcm_url;            ///< empty: LCM's default
};

using Receive = std::function<void(std::string_view channel, std::span<const std::uint8_t> bytes,
                                   std::int64_t utime)>;

/// Passes on the messages of the channels until `is_over`, the time or the log ends.
void receive_messages(const SourceOptions& options, const std::vector<std::string_view>& channels,
                      const Receive& receive, const std::function<bool()>& is_over) {
  if (!options.log.empty()) {
    LogFile log(options.log);
    while (const auto event = log.next()) receive(event->channel, event->data, event->utime);
    return;
  }
  if (!options.mission.empty()) enter_network_of_mission(options.mission);
  LcmBus bus({.url = options.lcm_url});
  for (const std::string_view channel : channels) {
    bus.subscribe(channel, Delivery::queued(1000),
                  [&receive](const ReceivedMessage& received) -> std::string_view {
                    receive(received.channel, received.bytes, received.utime);
                    return {};
                  });
  }
  constexpr int kWaitMs = 50;
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(options.seconds);
  while (Clock::now() < end && !is_over()) bus.handle(kWaitMs);
}

/// Calls `use` with the value of a message, if it has one.
template <class Msg, class Use>
void with_value(std::span<const std::uint8_t> bytes, const Use& use) {
  const Result<Msg> message = decode<Msg>(bytes);
  if (!message) return;
  if (const auto value = from_message(*message)) use(*value);
}

void add_source_options(CLI::App& command, SourceOptions& options) {
  CLI::Option* const log =
      command.add_option("--log", options.log, "LCM log to read instead of the network")
          ->type_name("FILE");
  command.add_option("--seconds", options.seconds, "How long to wait at most")
      ->type_name("SECONDS")
      ->check(number_in(above_up_to(0.0, 3600.0)))
      ->excludes(log)
      ->capture_default_str();
  command.add_option("--mission", options.mission, "Output folder of a running adit mission")
      ->type_name("DIR")
      ->excludes(log);
  command.add_option("--lcm-url", options.lcm_url, "LCM network, instead of the default")
      ->type_name("URL")
      ->excludes(log);
}

void finish(const std::string& name, const CheckResults& results) {
  std::cout << text_of(name, results);
  if (!all_are_good(results)) throw CLI::RuntimeError(kExitFailed);
}

// ---- adit check-stop

struct CheckStopOptions {
  SourceOptions source;
  std::string cause;
};

constexpr const char* kCheckStopDetails =
    R"(For the first start, the robot on blocks, its wheels in the air: drive slowly (adit drive --keyboard), run this, and do
what it says. It passes if the wheels stand within 0.5 s, by STOP, DRIVE_COMMAND and VEHICLE_STATE. CAUSE:

  obstacle     before the front laser
  laser        unplugged
  operator     adit drive ends
  supervisor   killed
  guard        stopped

Do not let the robot down before all five pass.)";

constexpr const char* kCheckStopExamples = R"(  adit check-stop obstacle
  adit check-stop guard --seconds 120)";

void run_check_stop(const CheckStopOptions& options) {
  const auto& causes = stop_causes();
  const auto cause = std::ranges::find(causes, options.cause, &StopCause::name);
  StopCheck check(*cause);
  bool told = false;
  const auto receive = [&](std::string_view channel, std::span<const std::uint8_t> bytes,
                           std::int64_t utime) {
    const auto add = [&](const auto& value) { check.add(value, utime); };
    if (channel == channels::kVehicleState) with_value<vehicle_state_t>(bytes, add);
    if (channel == channels::kStop) with_value<stop_t>(bytes, add);
    if (channel == channels::kDriveCommand) with_value<drive_command_t>(bytes, add);
    if (!check.has_moved() || told) return;
    told = true;
    std::cout << fmt::format("The wheels turn. {}\n", cause->action) << std::flush;
  };
  receive_messages(options.source,
                   {channels::kVehicleState, channels::kStop, channels::kDriveCommand}, receive,
                   [&] { return check.has_stopped(); });
  finish("the stop", {check.result()});
}

// ---- adit check-motion

struct CheckMotionOptions {
  SourceOptions source;
  std::string motion;
  double amount = 0.0;  ///< [m or rad]; 0: a metre or a right angle
};

constexpr const char* kCheckMotionDetails =
    R"(For the first drive on the ground: run this, drive by the keys (adit drive --keyboard) a metre straight forwards, or a
right angle to the left, by a mark on the ground, and stop. It passes if POSE and the wheels agree with that: lengths
within 15 %, angles within 0.2 rad. Otherwise the poses of the lasers or the signs of the wheels are wrong.)";

constexpr const char* kCheckMotionExamples = R"(  adit check-motion forwards
  adit check-motion forwards --amount 2
  adit check-motion left)";

void run_check_motion(const CheckMotionOptions& options) {
  const bool forwards = options.motion == "forwards";
  const double usual = forwards ? 1.0 : 0.5 * std::numbers::pi;
  MotionCheck check(forwards ? MotionCheck::Motion::kForwards : MotionCheck::Motion::kLeft,
                    options.amount > 0.0 ? options.amount : usual);
  const auto receive = [&](std::string_view channel, std::span<const std::uint8_t> bytes,
                           std::int64_t utime) {
    if (channel == channels::kPose) {
      with_value<pose_t>(bytes,
                         [&](const StampedPose& pose) { check.add_pose(pose.T_odom_body, utime); });
    } else if (channel == channels::kVehicleState) {
      with_value<vehicle_state_t>(
          bytes, [&](const VehicleState& state) { check.add_speed(state.speed_m_s, utime); });
    }
  };
  receive_messages(options.source, {channels::kPose, channels::kVehicleState}, receive,
                   [&] { return check.is_over(); });
  finish("the motion", check.results());
}

}  // namespace

void add_commission_commands(CLI::App& adit) {
  CLI::App* stop =
      add_command(adit, "check-stop", "Say whether the wheels stop in time, for a cause of five");
  set_help(*stop, {kCheckStopDetails, "  1  the wheels did not stop in time", kCheckStopExamples});
  const auto stop_options = std::make_shared<CheckStopOptions>();
  std::vector<std::string> names;
  for (const StopCause& cause : stop_causes()) names.push_back(cause.name);
  stop->add_option("CAUSE", stop_options->cause, "What happens to the robot")
      ->required()
      ->check(CLI::IsMember(names));
  add_source_options(*stop, stop_options->source);
  stop->callback([stop_options] { run_check_stop(*stop_options); });

  CLI::App* motion =
      add_command(adit, "check-motion", "Say whether a motion that you measured is that in POSE");
  set_help(*motion, {kCheckMotionDetails, "  1  the motions differ", kCheckMotionExamples});
  const auto motion_options = std::make_shared<CheckMotionOptions>();
  motion->add_option("MOTION", motion_options->motion, "How you drive it")
      ->required()
      ->check(CLI::IsMember({"forwards", "left"}));
  motion
      ->add_option("--amount", motion_options->amount,
                   "Metres or radians, instead of 1 or a right angle")
      ->type_name("NUMBER")
      ->check(number_in(above_up_to(0.0, 100.0)));
  add_source_options(*motion, motion_options->source);
  motion->callback([motion_options] { run_check_motion(*motion_options); });
}

}  // namespace adit
