// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/live/live_run.hpp"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <optional>
#include <string>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/bus/lcm_bus.hpp"
#include "common/bus/lcm_transport.hpp"
#include "common/bus/node/stages.hpp"
#include "common/bus/node/stop_signal.hpp"
#include "common/command_line/command_line.hpp"
#include "common/config/config.hpp"
#include "common/config/number_text.hpp"
#include "common/service/wall_time.hpp"
#include "common/text/message_text.hpp"
#include "sim/live/live_simulator.hpp"
#include "sim/live/sim_config.hpp"
#include "sim/world/build_world.hpp"

namespace adit {
namespace {

constexpr std::int64_t kSecondUs = 1'000'000;
constexpr std::int64_t kWaitMaxUs = 50'000;  // limits the delay of a signal to stop
constexpr double kSpeedFactorMax = 1e6;
constexpr int kQuietMs = 500;
constexpr std::int64_t kDrainMaxUs = 10 * kSecondUs;

std::int64_t full_second_utime() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::round<std::chrono::seconds>(now).count() * kSecondUs;
}

LcmBusOptions bus_options(const LiveRunOptions& run) {
  LcmBusOptions options;
  options.url = run.lcm_url;
  options.time = BusTime::kSimulated;  // its own SIM_TIME, received as by other stages
  options.seal = load_section<SealParams>(load_config(run.config), SealParams::kSection).read();
  if (!run.record.empty()) options.stage = Recording::kStage;
  return options;
}

LiveRunOptions with_record_stage(LiveRunOptions options) {
  if (options.record.empty()) return options;
  options.pacing.wait_for.emplace_back(Recording::kStage);
  if (options.compress) options.record = compressed_name(options.record);
  return options;
}

/// Handles messages until the timeout.
void listen(LcmBus& bus, std::int64_t wait_us) {
  const auto wait_ms = static_cast<int>(std::min(wait_us, kWaitMaxUs) / 1000);
  if (!bus.handle(wait_ms)) return;
  while (bus.handle(0)) {
  }
}

void run(LcmBus& bus, LiveSimulator& simulator, const StopSignal& stop) {
  while (!simulator.done() && !stop.received()) listen(bus, simulator.advance(steady_us()));
}

/// Handles messages until none has arrived for a while, since no message marks the last one.
void drain(LcmBus& bus) {
  const std::int64_t end_us = steady_us() + kDrainMaxUs;
  while (bus.handle(kQuietMs) && steady_us() < end_us) {
  }
}

}  // namespace

std::optional<double> speed_factor(const std::string& text) {
  if (text == "max") return std::nullopt;
  const auto factor = parse_number<double>(text);
  if (!factor || !(*factor > 0.0 && *factor <= kSpeedFactorMax)) {
    throw CLI::ValidationError(
        "--speed", fmt::format("{} is neither max nor a number above 0, at most {:g}", quote(text),
                               kSpeedFactorMax));
  }
  return factor;
}

const char* const kLiveRunFooter =
    R"(WORLD is a built-in world, `random`, a world file (.yaml) or a mesh (.obj, .ply, ..).

Time: stages started with --sim-time use the simulator's time and answer when they have handled all
earlier messages. With --wait-for the simulator is at most 0.2 s ahead of these stages, so that no message
is lost however slow they are; without it, it does not wait. lcm-logger is not waited for and may lose
messages; --record loses none.

The stages must use the same laser mounts as the simulator: pass the same --config to all, for example
deploy/config/groundhog.yaml, or the output of adit sim WORLD --print-config.

Faults, as KIND[:TARGET][=AMOUNT]@SECONDS, at a simulated time:
  laser_dies:front@20  laser_recovers:front@30  packet_loss=0.1@5  time_jump=2@40
  kill:mapping@60  suspend:mapping@60  (adit-mapping, started beside the simulator, which does not wait
  for it until it answers again))";

void add_live_run_options(CLI::App& app, LiveRunOptions& options) {
  app.add_option_function<std::string>(
         "--speed",
         [&options](const std::string& text) { options.pacing.factor = speed_factor(text); },
         "Simulated time per real time, or max: as fast as possible (default 1)")
      ->type_name("F|max");
  app.add_option("--wait-for", options.pacing.wait_for, "Stages that the simulator waits for")
      ->type_name("STAGE,..")
      ->delimiter(',');
  app.add_option("--ahead-max-s", options.pacing.ahead_max_s,
                 "Maximum lead over the slowest of these stages, in simulated time")
      ->type_name("SECONDS")
      ->check(number_in(within(0.05, 10.0)))
      ->capture_default_str();
  app.add_option("--outage-max-s", options.pacing.outage_max_s,
                 "Simulated time for which a stage that a fault has killed or suspended is not "
                 "waited for (default: until it answers again)")
      ->type_name("SECONDS")
      ->check(number_in(at_least(0.0)));
  app.add_option("--config", options.config, "YAML file with a section sim")->type_name("FILE");
  app.add_option("--fault", options.faults, "Injects a fault; may be given several times")
      ->type_name("FAULT")
      ->allow_extra_args(false);
  app.add_option("--lcm-url", options.lcm_url,
                 "LCM provider (default udpm://239.255.76.67:7667?ttl=0)")
      ->type_name("URL");
  app.add_option("--record", options.record,
                 "Records all messages on the bus in an LCM log, without loss")
      ->type_name("FILE");
  app.add_flag("--compress", options.compress,
               "Compresses the recorded log with zstd; as does a name that ends with .zst");
  app.add_flag("--print-config", options.print_config,
               "Prints every parameter with the value in effect, and exits");
  app.add_option("--start-utime", options.start_utime,
                 "Simulated time at the start, µs since the epoch (default: the system clock)")
      ->type_name("USEC")
      ->check(number_in(within(1.0, 1e16)));
  app.add_option("--for", options.for_s, "Ends after this simulated time")
      ->type_name("SECONDS")
      ->check(number_in(above(0.0)));
}

void run_live(const WorldChoice& world, const LiveRunOptions& options) {
  const StopSignal stop;  // before Embree and LCM start threads
  const SimulationParams params = load_simulation_params(options.config, options.faults);
  if (options.print_config) {
    std::cout << to_yaml(params, kSimSection);
    return;
  }
  const WorldDescription description = describe(world, params.vehicle);
  const Site site(build_world(description));

  if (const auto advice = receive_buffer_advice(options.lcm_url)) {
    print_error(options.program, *advice);
  }
  LcmBus bus(bus_options(options));
  LiveSimulator simulator(bus, site, description, params, with_record_stage(options),
                          options.start_utime.value_or(full_second_utime()));
  run(bus, simulator, stop);
  if (options.record.empty()) return;
  drain(bus);
  simulator.close_record();
}

}  // namespace adit
