// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_run.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "common/bus/log/recording.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/node/node_host.hpp"
#include "common/bus/node/stages.hpp"
#include "common/bus/node/version.hpp"
#include "common/geometry/pose2.hpp"
#include "common/sensing/seconds.hpp"
#include "sim/live/sim_config.hpp"
#include "sim/sim_node.hpp"
#include "sim/world/build_world.hpp"
#include "tools/drive/drive_run.hpp"
#include "tools/mission/mission_folder.hpp"
#include "tools/mission/mission_progress.hpp"
#include "tools/mission/pipeline.hpp"

namespace adit {
namespace {

constexpr double kProgressS = 1.0;                  // of simulated time
constexpr std::int64_t kSpacePeriodUs = 1'000'000;  // of simulated time

/// Simulator and all stages on one bus.
class MissionInProcess {
 public:
  MissionInProcess(const MissionRunOptions& options, const SimulationParams& params,
                   const WorldDescription& world, const Site& site, std::int64_t start_utime)
      : options_(options),
        start_utime_(start_utime),
        params_(params),
        log_(MissionFolder(options.folder).next_log(options.log_form), params_.record_free_min_mb),
        host_(bus_, {kSimSection, version(), yaml_in_effect(params_, world)}),
        sim_(host_.bus(), site, params_, static_cast<std::uint64_t>(world.seed), start_utime),
        follower_(bus_, options.folder / "phases.tsv", [this] { return simulated_s(); }) {
    host_.set_health([this] { return sim_.health(); });
    bus_.tap([this](const ReceivedMessage& message) {
      log_.write({message.utime, message.channel, message.bytes});
    });
    for (const ConfiguredNode& node : configure_pipeline(
             load_config(options.config), params_.lasers, params_.vehicle, options.folder)) {
      nodes_.push_back(std::make_unique<HostedNode>(bus_, node));
    }
    start_ = true_position();
  }

  /// Where the mission began, if not where the robot is now.
  void set_start(const Eigen::Vector3d& p_world_start) { start_ = p_world_start; }

  MissionRunResult run(const std::function<void(const MissionProgress&)>& progress) {
    while (!is_over()) {
      bus_.advance_to(sim_.next_utime());
      sim_.step();
      follower_.set_distance_from_start(distance_from_start_m());
      check_record();
      if (progress && is_progress_due()) {
        reported_s_ = simulated_s();
        reported_sequence_ = follower_.phase().sequence;
        progress(follower_.progress());
      }
    }
    log_.close();
    follower_.add_not_stored(log_.stopped());
    return {.last = follower_.progress(),
            .distance_from_start_m = distance_from_start_m(),
            .farthest_m = follower_.farthest_m(),
            .distance_travelled_m = sim_.simulation().state().distance_travelled_m,
            .failure = sim_.simulation().state().failure,
            .trace_failure = follower_.failure()};
  }

 private:
  void check_record() {
    const std::int64_t utime = sim_.simulation().utime();
    if (utime < space_utime_ + kSpacePeriodUs) return;
    space_utime_ = utime;
    log_.check_space(utime);
    follower_.add_not_stored(log_.stopped());
  }

  [[nodiscard]] bool is_over() const {
    return follower_.has_ended() || !sim_.simulation().state().failure.empty() ||
           simulated_s() > options_.time_max_s;
  }

  [[nodiscard]] bool is_progress_due() const {
    return simulated_s() >= reported_s_ + kProgressS ||
           follower_.phase().sequence != reported_sequence_;
  }

  [[nodiscard]] double simulated_s() const {
    return seconds(sim_.simulation().utime() - start_utime_);
  }
  [[nodiscard]] Eigen::Vector3d true_position() const {
    return sim_.simulation().vehicle().motion().T_world_body.translation();
  }
  [[nodiscard]] double distance_from_start_m() const { return (true_position() - start_).norm(); }

  const MissionRunOptions& options_;
  std::int64_t start_utime_;
  SimulationParams params_;
  Recording log_;
  MemoryBus bus_;
  NodeHost host_;
  SimNode sim_;
  MissionFollower follower_;
  std::vector<std::unique_ptr<HostedNode>> nodes_;
  std::int64_t space_utime_ = 0;
  double reported_s_ = 0.0;
  std::int32_t reported_sequence_ = 0;
  Eigen::Vector3d start_{0.0, 0.0, 0.0};
};

}  // namespace

MissionRunResult run_mission(const MissionRunOptions& options,
                             const std::function<void(const MissionProgress&)>& progress) {
  const MissionFolder folder(options.folder);
  const SimulationParams params = load_simulation_params(options.config, options.faults);
  WorldDescription world = describe(options.world, params.vehicle);
  std::int64_t start_utime = kDriveStartUtime;
  std::optional<Eigen::Vector3d> first_start;
  if (options.resume) {
    const SimulatedPose pose = folder.last_pose();
    const Eigen::Vector2d start = world.T_world_start.translation();
    first_start = {start.x(), start.y(), folder.start_height_m().value_or(0.0)};
    start_utime = pose.utime + kPowerLossDurationUs;
    world = with_start_at(std::move(world), pose);
  }
  const Site site(build_world(world));
  const auto start = std::chrono::steady_clock::now();
  MissionInProcess mission(options, params, world, site, start_utime);
  if (first_start) mission.set_start(*first_start);
  MissionRunResult result = mission.run(progress);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  result.wall_s = wall.count();
  return result;
}

}  // namespace adit
