// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "common/bus/channels.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/node/node_host.hpp"
#include "common/bus/node/stages.hpp"
#include "common/bus/node/version.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/geometry/pose2.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/mission.hpp"
#include "common/sensing/seconds.hpp"
#include "sim/live/fault_parser.hpp"
#include "sim/live/sim_config.hpp"
#include "sim/sim_node.hpp"
#include "sim/world/build_world.hpp"
#include "tools/drive/drive_run.hpp"
#include "tools/mission/mission_progress.hpp"
#include "tools/mission/pipeline.hpp"

namespace adit {
namespace {

constexpr std::size_t kQueued = 100;
constexpr double kProgressS = 1.0;  // of simulated time
constexpr double kAfterEndS = 2.0;  // recorded after the end

/// Simulator and all stages on one bus.
class MissionInProcess {
 public:
  MissionInProcess(const MissionRunOptions& options, const WorldDescription& world,
                   const Site& site)
      : options_(options),
        params_(load_simulation_params(options.config, options.faults)),
        log_(options.folder / "run.lcmlog"),
        host_(bus_, {kSimSection, version(), yaml_in_effect(params_, world)}),
        sim_(host_.bus(), site, params_, static_cast<std::uint64_t>(world.seed), kDriveStartUtime),
        trace_(bus_, options.folder / "phases.tsv", [this] { return simulated_s(); }) {
    host_.set_health([this] { return sim_.health(); });
    bus_.tap([this](const ReceivedMessage& message) {
      log_.write({message.utime, message.channel, message.bytes});
    });
    subscribe_all();
    for (const ConfiguredNode& node : configure_pipeline(
             load_config(options.config), params_.lasers, params_.vehicle, options.folder)) {
      nodes_.push_back(std::make_unique<HostedNode>(bus_, node));
    }
    start_ = true_pose().translation();
  }

  MissionRunResult run(const std::function<void(const MissionProgress&)>& progress) {
    while (!is_over()) {
      bus_.advance_to(sim_.next_utime());
      sim_.step();
      update_farthest();
      if (progress &&
          (simulated_s() >= reported_s_ + kProgressS || phase_.sequence != reported_sequence_)) {
        reported_s_ = simulated_s();
        reported_sequence_ = phase_.sequence;
        progress(current_progress());
      }
    }
    log_.close();
    return {.last = current_progress(),
            .distance_from_start_m = distance_from_start_m(),
            .farthest_m = farthest_m_,
            .distance_travelled_m = sim_.simulation().state().distance_travelled_m,
            .failure = sim_.simulation().state().failure};
  }

 private:
  void subscribe_all() {
    subscribe<phase_t>(bus_, channels::kPhase, Delivery::queued(kQueued),
                       [this](const MissionPhase& phase) {
                         if (phase_.phase != Phase::kEnded) ended_s_ = simulated_s();
                         phase_ = phase;
                       });
    subscribe<map_correction_t>(bus_, channels::kMapCorrection, Delivery::queued(kQueued),
                                [this](const MapCorrection& correction) {
                                  local_maps_ = std::max(local_maps_, correction.local_map + 1);
                                });
  }

  [[nodiscard]] bool is_over() const {
    const bool ended = phase_.phase == Phase::kEnded && simulated_s() > ended_s_ + kAfterEndS;
    return ended || !sim_.simulation().state().failure.empty() ||
           simulated_s() > options_.time_max_s;
  }

  [[nodiscard]] double simulated_s() const {
    return seconds(sim_.simulation().utime() - kDriveStartUtime);
  }
  [[nodiscard]] Pose2 true_pose() const {
    return in_plan(sim_.simulation().vehicle().motion().T_world_body);
  }
  [[nodiscard]] double distance_from_start_m() const {
    return (true_pose().translation() - start_).norm();
  }
  void update_farthest() { farthest_m_ = std::max(farthest_m_, distance_from_start_m()); }
  [[nodiscard]] MissionProgress current_progress() const {
    return {phase_, simulated_s(), distance_from_start_m(), local_maps_};
  }

  const MissionRunOptions& options_;
  SimulationParams params_;
  LogWriter log_;
  MemoryBus bus_;
  NodeHost host_;
  SimNode sim_;
  PhaseTrace trace_;
  std::vector<std::unique_ptr<HostedNode>> nodes_;
  MissionPhase phase_;
  double ended_s_ = 0.0;
  double reported_s_ = 0.0;
  std::int32_t reported_sequence_ = 0;
  int local_maps_ = 0;
  Eigen::Vector2d start_{0.0, 0.0};
  double farthest_m_ = 0.0;
};

}  // namespace

MissionRunResult run_mission(const MissionRunOptions& options,
                             const std::function<void(const MissionProgress&)>& progress) {
  const WorldDescription world = describe(options.world);
  const Site site(build_world(world));
  std::filesystem::create_directories(options.folder);
  const auto start = std::chrono::steady_clock::now();
  MissionInProcess mission(options, world, site);
  MissionRunResult result = mission.run(progress);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  result.wall_s = wall.count();
  return result;
}

}  // namespace adit
