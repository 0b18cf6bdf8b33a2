// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// A complete mission in one process in which sensor readings and messages between stages are lost.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/node/node_host.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mission.hpp"
#include "common/sensing/seconds.hpp"
#include "sim/live/sim_config.hpp"
#include "sim/live/world_choice.hpp"
#include "sim/sim_node.hpp"
#include "sim/world/build_world.hpp"
#include "tests/support/lossy_bus.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/mission/pipeline.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStartUtime = 1'600'000'000'000'000;
constexpr double kLossShare = 0.05;
constexpr double kTimeMaxS = 1200.0;  // simulated

/// The simulator on a bus, and each stage on its own lossy view of that bus.
class LossyMission {
 public:
  LossyMission(const std::filesystem::path& config, const WorldDescription& world, const Site& site,
               const std::filesystem::path& journals)
      : params_(load_simulation_params(config, {"packet_loss=0.05@5"})),
        sim_(bus_, site, params_, static_cast<std::uint64_t>(world.seed), kStartUtime) {
    subscribe<phase_t>(bus_, channels::kPhase, Delivery::queued(100),
                       [this](const MissionPhase& phase) { phase_ = phase; });
    bus_.tap([this](const ReceivedMessage& message) {
      clouds_resent_ += message.channel == channels::kCloudResend ? 1 : 0;
    });
    for (const ConfiguredNode& node :
         configure_pipeline(ConfigFile::load(config), params_.lasers, params_.vehicle, journals)) {
      lossy_.push_back(std::make_unique<test::LossyBus>(bus_, kLossShare, lossy_.size()));
      nodes_.push_back(std::make_unique<HostedNode>(*lossy_.back(), node));
    }
  }

  void run() {
    while (phase_.phase != Phase::kEnded && sim_.simulation().state().failure.empty() &&
           seconds(sim_.simulation().utime() - kStartUtime) < kTimeMaxS) {
      bus_.advance_to(sim_.next_utime());
      sim_.step();
    }
  }

  [[nodiscard]] const MissionPhase& phase() const { return phase_; }
  [[nodiscard]] std::string failure() const { return sim_.simulation().state().failure; }
  [[nodiscard]] int clouds_resent() const { return clouds_resent_; }

  [[nodiscard]] bool every_stage_lost_messages() const {
    return std::all_of(lossy_.begin(), lossy_.end(),
                       [](const auto& bus) { return bus->lost() > 0; });
  }

 private:
  SimulationParams params_;
  MemoryBus bus_;
  SimNode sim_;
  std::vector<std::unique_ptr<test::LossyBus>> lossy_;
  std::vector<std::unique_ptr<HostedNode>> nodes_;
  MissionPhase phase_;
  int clouds_resent_ = 0;
};

TEST(LossyMissionTest, ReturnsThoughATwentiethOfAllMessagesIsLost) {
  const test::ScratchFolder folder;
  const auto config = folder / "config.yaml";
  std::ofstream(config) << "mission: {limits: {path_length_max_m: 24}}\n";
  WorldChoice choice;
  choice.name = "random_level";
  choice.seed = 4;
  choice.length_m = 30.0;
  choice.topology = "branching";
  const WorldDescription world = describe(choice);
  const Site site(build_world(world));
  LossyMission mission(config, world, site, folder.path());
  mission.run();
  EXPECT_EQ(mission.failure(), "");
  EXPECT_EQ(mission.phase().outcome, MissionOutcome::kHome) << mission.phase().reason;
  EXPECT_GT(mission.phase().distance_travelled_m, 5.0);
  EXPECT_TRUE(mission.every_stage_lost_messages());
  EXPECT_GT(mission.clouds_resent(), 0) << "no lost 3D scan was requested again";
}

}  // namespace
}  // namespace adit
