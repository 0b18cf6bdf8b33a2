// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/doctor/stage_load.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/bus/forwarding_bus.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/node/node_host.hpp"
#include "sim/live/sim_config.hpp"
#include "sim/live/world_choice.hpp"
#include "sim/sim_node.hpp"
#include "sim/world/build_world.hpp"
#include "tools/drive/drive_run.hpp"
#include "tools/mission/pipeline.hpp"

namespace adit {
namespace {

constexpr const char* kWorld = "random";
constexpr int kSeed = 1;
constexpr double kMovedM = 0.1;  // from the start, when the measurement begins
constexpr double kSecondS = 1.0;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Holds what the simulator publishes, so that the handlers of the stages do not run within its
/// step.
class HeldBus final : public ForwardingBus {
 public:
  using ForwardingBus::ForwardingBus;

  void publish(std::string_view channel, std::span<const std::uint8_t> bytes) override {
    held_.push_back({std::string(channel), {bytes.begin(), bytes.end()}});
  }
  void release() {
    for (const Held& message : held_) ForwardingBus::publish(message.channel, message.bytes);
    held_.clear();
  }

 private:
  struct Held {
    std::string channel;
    std::vector<std::uint8_t> bytes;
  };
  std::vector<Held> held_;
};

}  // namespace

StageLoad measure_stage_load(const std::filesystem::path& config,
                             const std::filesystem::path& folder, double wall_s) {
  const SimulationParams params = load_simulation_params(config, {});
  WorldChoice world;
  world.name = kWorld;
  world.seed = kSeed;
  const Site site(build_world(describe(world)));
  MemoryBus bus;
  double bytes = 0.0;
  bus.tap([&bytes](const ReceivedMessage& message) {
    bytes += static_cast<double>(message.bytes.size());
  });
  HeldBus held(bus);
  SimNode sim(held, site, params, kSeed, kDriveStartUtime);
  std::vector<std::unique_ptr<HostedNode>> nodes;
  for (const ConfiguredNode& node :
       configure_pipeline(load_config(config), params.lasers, params.vehicle, folder)) {
    nodes.push_back(std::make_unique<HostedNode>(bus, node));
  }

  StageLoad load;
  double stages_s = 0.0;
  double second_s = 0.0;  // in the stages, in the present second of the mission
  double second_begin_s = 0.0;
  const auto run_stages = [&](const auto& work) {
    const auto begin = Clock::now();
    work();
    const double seconds = seconds_since(begin);
    stages_s += seconds;
    second_s += seconds;
  };
  const auto begin = Clock::now();
  bool measuring = false;
  Clock::time_point measured_since = begin;
  constexpr double kStepS = 1e-6 * static_cast<double>(Simulation::kStepUs);
  // A robot that does not start to move is measured all the same, from the middle of the time on.
  while (!(measuring && seconds_since(measured_since) >= wall_s) &&
         seconds_since(begin) < 3.0 * wall_s) {
    run_stages([&] { bus.advance_to(sim.next_utime()); });
    sim.step();
    run_stages([&] { held.release(); });
    const bool moved = sim.simulation().state().distance_travelled_m > kMovedM;
    if (!measuring && (moved || seconds_since(begin) >= 2.0 * wall_s)) {
      measuring = true;
      measured_since = Clock::now();
      stages_s = second_s = bytes = 0.0;
      load = {};
      second_begin_s = 0.0;
    }
    load.simulated_s += kStepS;
    if (load.simulated_s - second_begin_s < kSecondS) continue;
    load.share_max = std::max(load.share_max, second_s / (load.simulated_s - second_begin_s));
    second_begin_s = load.simulated_s;
    second_s = 0.0;
  }
  load.share = stages_s / std::max(kStepS, load.simulated_s);
  load.log_mb_s = 1e-6 * bytes / std::max(kStepS, load.simulated_s);
  return load;
}

}  // namespace adit
