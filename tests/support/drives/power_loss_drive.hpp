// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "common/bus/memory_bus.hpp"
#include "common/geometry/pose2.hpp"
#include "procs/volume_map/volume_map.hpp"
#include "sim/drive/waypoint_driver.hpp"
#include "sim/sim_node.hpp"
#include "sim/world/world.hpp"

namespace adit::test {

/// What a power cut leaves on the disk.
enum class DiskAfterPowerLoss {
  kIntact,
  kTruncated,       ///< the last records of the map and of the volume have lost their ends
  kBeforeLastScan,  ///< the volume was not written since the last scan began
};

/// How the computer of a robot was cut off, and what it knew when it was on again.
struct PowerLoss {
  double distance_travelled_m = 0.0;  ///< driven until then
  bool in_motion = false;             ///< else at rest, or in a sweep
  bool truncated = false;             ///< the last record of each journal lost its end
  int maps = 0;                       ///< local maps that had been announced
  int maps_lost = 0;                  ///< of these
  int scans = 0;                      ///< 3D scans that had been taken
  int scans_lost = 0;
  /// Seconds from the first scan to the first correction; nothing where none came.
  std::optional<double> localized_after_s;
  /// Of the pose in map, against the truth, over the time of the cut.
  double error_m = 0.0;
  double error_rad = 0.0;
  double sd_m = 0.0;  ///< that the correction states, of the worst direction
  double sd_rad = 0.0;
  double error_after_driving_m = 0.0;  ///< the same error, when it has driven on
  double sd_after_driving_m = 0.0;
};

/// A simulated robot on a drive, whose computer is cut off at any moment: all stages are destroyed
/// and made anew over the same journals, while the world goes on.
class PowerLossDrive {
 public:
  PowerLossDrive(World world, std::vector<Waypoint> waypoints, std::filesystem::path folder);
  ~PowerLossDrive();

  /// So far on. False at the end of the way, or where it fails.
  bool drive(double distance_travelled_m);
  /// Takes a 3D scan, or begins one and drives no more.
  void sweep(double seconds = 10.0);
  /// Cuts off, and waits standing for the first correction.
  PowerLoss lose_power(DiskAfterPowerLoss disk, std::mt19937& random);
  /// Stands for so long.
  void wait(double seconds);
  /// Fills in what is known later.
  void evaluate_later(PowerLoss& lose_power) const;

  [[nodiscard]] double distance_travelled_m() const { return driver_.progress_m(); }
  /// As the stage has it now.
  [[nodiscard]] const VolumeMap& volume() const;

 private:
  class Computer;

  void run(double seconds);
  void step();
  void start_computer();
  void truncate_journal(const std::filesystem::path& journal, std::mt19937& random) const;
  [[nodiscard]] Pose2 T_world_body() const;

  std::filesystem::path folder_;
  Site site_;
  MemoryBus bus_;
  SimNode sim_;
  WaypointDriver driver_;
  bool driving_ = false;
  std::int32_t sweeps_ = 0;
  std::uintmax_t volume_bytes_ = 0;  ///< of its journal, before the last sweep
  std::unique_ptr<Computer> computer_;
  Pose2 T_world_start_;
  /// Before the last cut: where the robot truly was, and where it believed to be.
  Pose2 T_world_before_loss_;
  Pose2 T_map_before_loss_;
};

}  // namespace adit::test
