// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/drive/drive_run.hpp"

#include <chrono>

#include "common/bus/channels.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/node/node_host.hpp"
#include "common/bus/node/stages.hpp"
#include "common/bus/node/version.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/sensing/seconds.hpp"
#include "sim/drive/waypoint_file.hpp"
#include "sim/live/sim_config.hpp"
#include "sim/sim_node.hpp"
#include "sim/waypoint_driver_node.hpp"
#include "sim/world/build_world.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {
namespace {

constexpr std::size_t kTruthQueueSize = 100;  // in one process, none is queued

/// Simulator and driver on one bus.
class Drive {
 public:
  Drive(MemoryBus& bus, const Site& site, const WorldDescription& world,
        const SimulationParams& params, std::vector<Waypoint> waypoints)
      : bus_(bus),
        host_(bus, {kSimSection, version(), yaml_in_effect(params, world)}),
        sim_(host_.bus(), site, params, static_cast<std::uint64_t>(world.seed), kDriveStartUtime),
        driver_(bus, WaypointDriver(std::move(waypoints), params.vehicle)) {
    host_.set_health([this] { return sim_.health(); });
  }

  void step() {
    bus_.advance_to(sim_.next_utime());
    sim_.step();
  }

  [[nodiscard]] bool done() const { return driver_.driver().done() || !failure().empty(); }
  [[nodiscard]] double share() const {
    const double length_m = driver_.driver().length_m();
    return length_m > 0.0 ? driver_.driver().progress_m() / length_m : 0.0;
  }
  [[nodiscard]] std::string failure() const {
    std::string failure = sim_.simulation().state().failure;
    if (!failure.empty()) return failure;
    return driver_.driver().abort_reason().value_or("");
  }
  [[nodiscard]] const Simulation& simulation() const { return sim_.simulation(); }

 private:
  MemoryBus& bus_;
  NodeHost host_;
  SimNode sim_;
  WaypointDriverNode driver_;
};

void record_truth(Bus& bus, Trajectory& truth) {
  subscribe<pose_t>(bus, channels::kTruth, Delivery::queued(kTruthQueueSize),
                    [&truth](const StampedPose& pose) {
                      truth.push_back({pose.utime, pose.T_odom_body, pose.z_m});
                    });
}

}  // namespace

DriveRunResult run_drive(const DriveRunOptions& options, const DriveProgress& progress) {
  const SimulationParams params = load_simulation_params(options.config, options.faults);
  reject_process_faults(params.faults);
  std::vector<Waypoint> waypoints = read_waypoints(options.waypoints);
  const WorldDescription world = describe(options.world, params.vehicle);
  const Site site(build_world(world));

  const auto start = std::chrono::steady_clock::now();
  LogWriter log(options.log, LogWriter::Name::kWhenClosed);
  MemoryBus bus;
  bus.tap([&log](const ReceivedMessage& message) {
    log.write({message.utime, message.channel, message.bytes});
  });
  Trajectory truth;
  record_truth(bus, truth);
  Drive drive(bus, site, world, params, std::move(waypoints));
  while (!drive.done()) {
    drive.step();
    if (progress) progress(drive.share());
  }
  log.close();
  if (!options.truth.empty()) write_tum(options.truth, truth);

  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  const auto simulated_us = drive.simulation().utime() - kDriveStartUtime;
  return {seconds(simulated_us), wall.count(), drive.simulation().state().distance_travelled_m,
          log.events(), drive.failure()};
}

}  // namespace adit
