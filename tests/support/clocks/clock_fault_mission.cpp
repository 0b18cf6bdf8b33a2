// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/clocks/clock_fault_mission.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <map>
#include <memory>
#include <random>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/node/node_host.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mission.hpp"
#include "common/sensing/seconds.hpp"
#include "sim/live/sim_config.hpp"
#include "sim/live/world_choice.hpp"
#include "sim/sim_node.hpp"
#include "sim/world/build_world.hpp"
#include "tools/mission/pipeline.hpp"

namespace adit::test {
namespace {

constexpr std::int64_t kStartUtime = 1'600'000'000'000'000;
constexpr double kTimeMaxS = 600.0;  // simulated; a mission takes a quarter of it
constexpr double kBlindMaxS = 5.0;
constexpr double kHomeM = 0.5;
constexpr std::array kMines{1, 2, 3, 4, 5, 6};
constexpr double kLastingS = 15.0;
constexpr double kFirstS = 5.0;  // of a mission: the earliest and the latest begin of a fault
constexpr double kLastS = 60.0;
constexpr std::array kChannels{channels::kLaserFront, channels::kLaserRear,
                               channels::kTiltFront,  channels::kTiltRear,
                               channels::kImu,        channels::kWheelOdometry};
constexpr std::array kJumpsS{0.001, 0.01, 0.1, 0.6, 1.0, 10.0, 60.0, 3600.0};
constexpr std::array kDriftsPpm{-500.0, 500.0};

WorldDescription mine(int seed) {
  WorldChoice choice;
  choice.name = "random_level";
  choice.seed = seed;
  choice.length_m = 30.0;
  choice.topology = "parallel_entries";
  return describe(choice);
}

/// The simulator on a bus with the fault, the stages behind it.
class Mission {
 public:
  Mission(const ClockFault& fault, const WorldDescription& world, const Site& site,
          const std::filesystem::path& config, const std::filesystem::path& journals)
      : fault_(fault),
        params_(load_simulation_params(config, {})),
        drivers_(bus_, fault, kStartUtime),
        sim_(drivers_, site, params_, static_cast<std::uint64_t>(world.seed), kStartUtime) {
    subscribe<phase_t>(bus_, channels::kPhase, Delivery::queued(100),
                       [this](const MissionPhase& phase) { phase_ = phase; });
    subscribe<heartbeat_t>(bus_, channels::kHeartbeat, Delivery::queued(100),
                           [this](const Heartbeat& heartbeat) { add(heartbeat); });
    bus_.tap([this](const ReceivedMessage& message) {
      if (message.channel == channels::kPose) pose_s_ = now_s();
    });
    for (const ConfiguredNode& node :
         configure_pipeline(ConfigFile::load(config), params_.lasers, params_.vehicle, journals)) {
      nodes_.push_back(std::make_unique<HostedNode>(bus_, node));
    }
    start_ = true_position();
  }

  ClockFaultResult run() {
    while (phase_.phase != Phase::kEnded && sim_.simulation().state().failure.empty() &&
           now_s() < kTimeMaxS) {
      bus_.advance_to(sim_.next_utime());
      sim_.step();
      measure_blind_time();
    }
    result_.outcome = phase_.outcome;
    result_.reason = phase_.reason;
    result_.failure = sim_.simulation().state().failure;
    result_.distance_from_start_m = (true_position() - start_).norm();
    result_.simulated_s = now_s();
    result_.changed = drivers_.changed();
    for (const auto& [stage, rejected] : rejected_)
      result_.rejected += rejected.last - rejected.before;
    return result_;
  }

 private:
  struct Rejected {
    std::int64_t before = 0;
    std::int64_t last = 0;
  };

  void add(const Heartbeat& heartbeat) {
    Rejected& rejected = rejected_[heartbeat.stage];
    rejected.last = heartbeat.rejected;
    if (drivers_.changed() == 0) rejected.before = heartbeat.rejected;
    const std::string& reason = heartbeat.health.reason;
    const bool names = std::ranges::any_of(fault_.channels, [&](const std::string& channel) {
      return reason.find(channel) != std::string::npos;
    });
    if (names && drivers_.changed() > 0 && result_.reported.empty()) {
      result_.reported = heartbeat.stage + ": " + reason;
    }
  }

  void measure_blind_time() {
    if (drivers_.changed() == 0 || phase_.phase == Phase::kEnded) return;
    result_.blind_s = std::max(result_.blind_s, now_s() - std::max(pose_s_, fault_.at_s));
    if (const auto gone_s = drivers_.ended_s()) {
      result_.blind_after_s =
          std::max(result_.blind_after_s.value_or(0.0), now_s() - std::max(pose_s_, *gone_s));
    }
  }

  [[nodiscard]] double now_s() const { return seconds(sim_.simulation().utime() - kStartUtime); }
  [[nodiscard]] Eigen::Vector3d true_position() const {
    return sim_.simulation().vehicle().motion().T_world_body.translation();
  }

  ClockFault fault_;
  SimulationParams params_;
  MemoryBus bus_;
  ClockFaultBus drivers_;
  SimNode sim_;
  std::vector<std::unique_ptr<HostedNode>> nodes_;
  MissionPhase phase_;
  double pose_s_ = 0.0;
  std::map<std::string, Rejected> rejected_;  // by stage
  Eigen::Vector3d start_{0.0, 0.0, 0.0};
  ClockFaultResult result_;
};

}  // namespace

bool ClockFaultResult::claims_home_falsely() const {
  return outcome == MissionOutcome::kHome && distance_from_start_m > kHomeM;
}

bool ClockFaultResult::is_failure() const {
  return claims_home_falsely() || !failure.empty() || blind_after_s.value_or(0.0) > kBlindMaxS;
}

std::vector<ClockFaultCase> clock_fault_cases(std::uint64_t seed) {
  using Kind = ClockFault::Kind;
  std::vector<ClockFault> faults;
  for (const std::string_view channel : kChannels) {
    for (const double duration_s : {0.0, kLastingS, ClockFault::kForGood}) {
      for (const double jump_s : kJumpsS) {
        for (const double sign : {-1.0, 1.0}) {
          faults.push_back({Kind::kJump, {std::string(channel)}, sign * jump_s, 0.0, duration_s});
        }
      }
      if (duration_s > 0.0) {
        faults.push_back({Kind::kFrozen, {std::string(channel)}, 0.0, 0.0, duration_s});
      }
    }
  }
  for (const double ppm : kDriftsPpm) {
    const auto add = [&](const std::vector<std::string>& names) {
      faults.push_back({Kind::kDrift, names, ppm, 0.0, ClockFault::kForGood});
    };
    add({std::string(channels::kLaserFront), std::string(channels::kLaserRear)});
    for (const std::string_view channel : kChannels) add({std::string(channel)});
  }
  std::mt19937_64 random(seed);
  std::ranges::shuffle(faults, random);
  std::vector<ClockFaultCase> cases;
  for (const int seed_of_mine : kMines) cases.push_back({0, seed_of_mine, {}});
  for (ClockFault& fault : faults) {
    fault.at_s = std::uniform_real_distribution<double>(kFirstS, kLastS)(random);
    if (fault.kind == Kind::kDrift) fault.at_s = 0.0;
    cases.push_back({0, kMines[cases.size() % kMines.size()], fault});
  }
  for (std::size_t i = 0; i < cases.size(); ++i) cases[i].number = static_cast<int>(i);
  return cases;
}

ClockFaultResult run_clock_fault(const ClockFaultCase& fault_case,
                                 const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const auto config = folder / "config.yaml";
  std::ofstream(config) << "mission: {limits: {path_length_max_m: 100}}\n";
  const WorldDescription world = mine(fault_case.mine);
  const Site site(build_world(world));
  Mission mission(fault_case.fault, world, site, config, folder);
  return mission.run();
}

}  // namespace adit::test
