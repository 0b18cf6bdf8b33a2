// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "procs/planning/planning_node.hpp"
#include "procs/scan_assembly/scan_assembly_node.hpp"
#include "procs/terrain/terrain_node.hpp"
#include "tests/support/robots/simulated_robot.hpp"

namespace adit {

/// A simulated robot with the stages from the 3D scan to the path. `Robot` has the interface of
/// GroundTruthRobot: constructor from a World, run() and bus().
template <class Robot>
class PlanningRobot {
 public:
  static constexpr int kGoal = 2;  ///< id of the goal

  explicit PlanningRobot(World world) : robot_(std::move(world)) {
    subscribe<planned_path_t>(bus(), channels::kPath, Delivery::latest(),
                              [this](const PlannedPath& path) { path_ = path; });
    subscribe<terrain_t>(bus(), channels::kTerrain, Delivery::queued(100),
                         [this](const TerrainFragment& tile) {
                           if (assembler_.add(tile)) ++terrain_count_;
                         });
  }

  /// Requests a 3D scan, runs ten seconds (the sweep takes eight), then publishes a goal straight
  /// ahead.
  void scan_and_plan(double distance_m) {
    run(1.5);
    publish(bus(), channels::kScanRequest,
            to_message(ScanRequest{bus().now_utime(), 1, LaserId::kFront}));
    run(10.0);
    publish(bus(), channels::kGoal,
            to_message(PlanGoal{bus().now_utime(), kGoal, PlanGoal::Kind::kAlong, {}, distance_m}));
  }

  /// Runs for a simulated time.
  void run(double seconds) { robot_.run(seconds); }

  [[nodiscard]] MemoryBus& bus() { return robot_.bus(); }
  [[nodiscard]] int terrain_count() const { return terrain_count_; }
  [[nodiscard]] const PlannedPath& path() const { return path_; }
  [[nodiscard]] Health terrain_health() const { return terrain_.health(); }

 private:
  Robot robot_;
  ScanAssemblyNode scan_assembly_{bus(), with_groundhog_lasers<ScanAssemblyNodeParams>()};
  TerrainNode terrain_{bus(), TerrainParams{}};
  PlanningNode planning_{bus(), PlanningParams{}};
  TerrainReassembler assembler_;
  int terrain_count_ = 0;
  PlannedPath path_;
};

}  // namespace adit
