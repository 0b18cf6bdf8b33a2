// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/live/live_run.hpp"

#include <algorithm>
#include <chrono>
#include <iostream>

#include "common/bus/lcm_bus.hpp"
#include "common/bus/stages.hpp"
#include "common/bus/stop_signal.hpp"
#include "common/bus/transport_check.hpp"
#include "common/config/config.hpp"
#include "sim/live/live_simulator.hpp"
#include "sim/live/settings.hpp"
#include "sim/world/build_world.hpp"

namespace adit {
namespace {

constexpr std::int64_t kSecondUs = 1'000'000;
constexpr std::int64_t kWaitMaxUs = 50'000;  // so that a signal to stop is heard soon
constexpr int kQuietMs = 500;
constexpr std::int64_t kHearOutMaxUs = 10 * kSecondUs;

std::int64_t whole_second_utime() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::round<std::chrono::seconds>(now).count() * kSecondUs;
}

std::int64_t wall_us() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

LcmBusOptions bus_options(const LiveRunOptions& run) {
  LcmBusOptions options;
  options.url = run.lcm_url;
  options.time = BusTime::kSimulated;  // its own, which it hears as the others do
  if (!run.record.empty()) options.stage = kRecordStage;
  return options;
}

LiveRunOptions waiting_for_its_record(LiveRunOptions options) {
  if (!options.record.empty()) options.pacing.wait_for.emplace_back(kRecordStage);
  return options;
}

/// Handles what comes, for as long at most.
void listen(LcmBus& bus, std::int64_t wait_us) {
  const auto wait_ms = static_cast<int>(std::min(wait_us, kWaitMaxUs) / 1000);
  if (!bus.handle(wait_ms)) return;
  while (bus.handle(0)) {
  }
}

void run(LcmBus& bus, LiveSimulator& simulator, const StopSignal& stop) {
  while (!simulator.done() && !stop.came()) listen(bus, simulator.go_on(wall_us()));
}

/// Until nothing has come for a while: no message tells that there is none on its way.
void hear_out(LcmBus& bus) {
  const std::int64_t end_us = wall_us() + kHearOutMaxUs;
  while (bus.handle(kQuietMs) && wall_us() < end_us) {
  }
}

}  // namespace

void run_live(const WorldChoice& world, const LiveRunOptions& options) {
  const StopSignal stop;  // before Embree and LCM make threads
  const SimulationParams params = load_simulation_params(options.config, options.faults);
  if (options.print_config) {
    std::cout << to_yaml(params, kSimSection);
    return;
  }
  const WorldDescription description = describe(world);
  const Site site(build_world(description));

  if (const auto advice = buffer_advice(options.lcm_url)) {
    std::cerr << options.program << ": " << *advice << std::endl;
  }
  LcmBus bus(bus_options(options));
  LiveSimulator simulator(bus, site, description, params, waiting_for_its_record(options),
                          options.start_utime.value_or(whole_second_utime()));
  run(bus, simulator, stop);
  if (options.record.empty()) return;
  hear_out(bus);
  simulator.close_record();
}

}  // namespace adit
