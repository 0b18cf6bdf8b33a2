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

/// State of the journals on disk after a power loss.
enum class DiskAfterPowerLoss {
  kIntact,
  kTruncated,       ///< the last records of the map and volume journals are truncated
  kBeforeLastScan,  ///< the volume journal ends before the last 3D scan
};

/// A power loss of the on-board computer, and the state after its restart.
struct PowerLoss {
  double distance_travelled_m = 0.0;  ///< before the power loss
  bool in_motion = false;             ///< false: at rest or in a sweep
  bool truncated = false;             ///< the last record of each journal is truncated
  int maps = 0;                       ///< local maps published before the power loss
  int maps_lost = 0;                  ///< of these
  int scans = 0;                      ///< 3D scans in the volume map before the power loss
  int scans_lost = 0;                 ///< of these
  /// Seconds from the restart to the first map correction; nothing if none was received.
  std::optional<double> localized_after_s;
  /// Error of the motion in map over the power loss, against ground truth.
  double error_m = 0.0;
  double error_rad = 0.0;
  double sd_m = 0.0;  ///< standard deviation of the correction in its least certain direction
  double sd_rad = 0.0;
  double error_after_driving_m = 0.0;  ///< `error_m` after more driving (evaluate_later)
  double sd_after_driving_m = 0.0;
};

/// A simulated robot on a drive whose on-board computer loses power at chosen moments: all stages
/// are destroyed and restarted from the same journals, while the simulation continues.
class PowerLossDrive {
 public:
  PowerLossDrive(World world, std::vector<Waypoint> waypoints, std::filesystem::path folder);
  ~PowerLossDrive();

  /// Drives this distance. False at the end of the waypoints or after a failure.
  bool drive(double distance_travelled_m);
  /// Stops, requests a 3D scan and waits. With a short time the scan stays unfinished.
  void sweep(double seconds = 10.0);
  /// Loses power, restarts and waits at rest for the first map correction.
  PowerLoss lose_power(DiskAfterPowerLoss disk, std::mt19937& random);
  /// Stands still.
  void wait(double seconds);
  /// Fills in the error after more driving.
  void evaluate_later(PowerLoss& loss) const;

  [[nodiscard]] double distance_travelled_m() const { return driver_.progress_m(); }
  /// The current map of the volume map stage.
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
  std::uintmax_t volume_bytes_ = 0;  ///< size of the volume journal before the last sweep
  std::unique_ptr<Computer> computer_;
  Pose2 T_world_start_;
  /// True and estimated pose before the last power loss.
  Pose2 T_world_before_loss_;
  Pose2 T_map_before_loss_;
};

}  // namespace adit::test
