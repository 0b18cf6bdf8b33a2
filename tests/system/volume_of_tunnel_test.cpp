// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// A simulated robot makes a 3D scan of a tunnel, and a volume is built from it: all nodes from the
// laser to VOLUME on one bus, and `adit volume` on the log of that bus.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/mapping/volume.hpp"
#include "common/messages/sensing.hpp"
#include "common/volume/volume.hpp"
#include "procs/scan_assembly/scan_assembly_node.hpp"
#include "procs/volume_map/volume_map_node.hpp"
#include "tests/support/robots/simulated_robot.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/worlds/box_tunnel.hpp"
#include "tools/volume/volume_run.hpp"

namespace adit {
namespace {

class ScanningRobot {
 public:
  explicit ScanningRobot(const std::filesystem::path& log) : log_(log) {
    for (const auto channel : {channels::kCloud, channels::kPoseGraph, channels::kMapCorrection}) {
      bus_.subscribe(channel, Delivery::queued(1000), [this](const ReceivedMessage& received) {
        log_.write({received.utime,
                    std::string(received.channel),
                    {received.bytes.begin(), received.bytes.end()}});
        return std::string_view{};
      });
    }
    subscribe<volume_t>(bus_, channels::kVolume, Delivery::queued(1000),
                        [this](const VolumeFragment& fragment) {
                          if (is_pose_only(fragment)) {
                            volume_.T_map_volume = fragment.part.T_map_volume;
                          } else if (const auto volume = assembler_.add(fragment)) {
                            volume_ = *volume;
                          }
                        });
  }

  void place_in_map(std::int64_t revision, const Pose2& T_map_odom) {
    const MapGraph graph{bus_.now_utime(), revision, {T_map_odom}, {}};
    for (const PoseGraphFragment& fragment : split(graph)) {
      publish(bus_, channels::kPoseGraph, to_message(fragment));
    }
    publish(bus_, channels::kMapCorrection,
            to_message(MapCorrection{bus_.now_utime(), revision, 0, 0, T_map_odom, {}}));
  }

  /// Makes a 3D scan; the sweep takes eight seconds.
  void scan_around() {
    robot_.run(1.5);
    publish(bus_, channels::kScanRequest,
            to_message(ScanRequest{bus_.now_utime(), 1, LaserId::kFront}));
    robot_.run(10.0);
  }

  /// The newest volume with its newest pose.
  [[nodiscard]] const Volume& volume() const { return volume_; }
  void close_log() { log_.close(); }

 private:
  LogWriter log_;
  GroundTruthRobot robot_{box_tunnel()};
  MemoryBus& bus_ = robot_.bus();
  ScanAssemblyNode scan_assembly_{bus_, with_groundhog_lasers<ScanAssemblyNodeParams>()};
  VolumeMapNode volume_map_{bus_, VolumeMapNodeParams{}};
  VolumeReassembler assembler_;
  Volume volume_;
};

/// Distance from the nearest surface of the tunnel [m]; negative in the rock.
double distance_to_surface_m(const Eigen::Vector3d& p_world) {
  return std::min(
      {20.0 - std::abs(p_world.x()), 2.0 - std::abs(p_world.y()), p_world.z(), 2.0 - p_world.z()});
}

TEST(VolumeOfATunnel, HasAccurateWalls) {
  const test::ScratchFolder folder;
  ScanningRobot robot(folder / "run.lcmlog");
  robot.scan_around();
  robot.place_in_map(1, {});
  const Volume& volume = robot.volume();
  EXPECT_GT(volume.occupied, 3000);
  EXPECT_GT(volume.free, 30'000);
  const VoxelGrid grid(volume.cell_m);
  // Half a cell; noise, offset and resolution of the laser (20 + 15 + 5 mm); 1 mrad at 20 m.
  constexpr double kTolerance = 0.05 + 0.04 + 0.02;
  visit_leaves(volume.octree, [&](const CellRun& leaf) {
    for (VoxelCode cell = leaf.first; cell < leaf.end; ++cell) {
      const Eigen::Vector3d p = grid.centre_m(VoxelGrid::keys_at(cell));
      const Eigen::Vector2d p_map = volume.T_map_volume * Eigen::Vector2d(p.head<2>());
      const double distance_m = distance_to_surface_m({p_map.x(), p_map.y(), p.z()});
      EXPECT_GT(distance_m, -kTolerance);
      if (leaf.occupied) {
        EXPECT_LT(distance_m, kTolerance);
      }
    }
  });
}

TEST(VolumeOfATunnel, MovesWithThePoseGraphAndIsRebuiltFromTheLog) {
  const test::ScratchFolder folder;
  ScanningRobot robot(folder / "run.lcmlog");
  robot.place_in_map(1, {});
  robot.scan_around();
  const Pose2 before = robot.volume().T_map_volume;
  const Pose2 motion{3.0, -1.0, 0.5};
  robot.place_in_map(2, motion);
  const Pose2 expected = motion * before;
  EXPECT_NEAR(robot.volume().T_map_volume.x, expected.x, 1e-9);
  EXPECT_NEAR(robot.volume().T_map_volume.y, expected.y, 1e-9);
  EXPECT_NEAR(robot.volume().T_map_volume.theta, expected.theta, 1e-9);

  robot.close_log();
  const VolumeRunResult result = run_volume({folder / "run.lcmlog", folder / "out", {}});
  EXPECT_EQ(result.scans, 1);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_GT(result.points, 10'000U);
}

}  // namespace
}  // namespace adit
