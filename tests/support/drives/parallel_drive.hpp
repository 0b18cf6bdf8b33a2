// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "procs/mapping/mapping.hpp"
#include "tools/eval/path_error.hpp"
#include "tools/sim/sample_run.hpp"

namespace adit::test {

/// The drive of figure 4 of the paper, one local map at a time: through two parallel tunnels,
/// around a long loop and back into the first tunnel (world `parallel`). Poses are wheel odometry
/// with a yaw bias, so that the other tunnel may match the estimated pose.
class ParallelDrive {
 public:
  explicit ParallelDrive(double yaw_bias_deg_per_m,
                         const DisplacementErrorParams& assumed_error = drifting_odometry_error());

  /// An odometry error with which both tunnels are likely: 10° (1 σ) over the loop.
  static DisplacementErrorParams drifting_odometry_error();

  /// Drives to the end of the next local map. Nothing at the end of the drive.
  std::optional<MapUpdate> next();

  /// Restarts mapping from a stored map. The odometry continues.
  void restart(StoredMap stored);

  [[nodiscard]] const Mapping& mapping() const { return *mapping_; }

  /// Position error of the newest local map relative to the first one [m].
  [[nodiscard]] double newest_error_m() const;
  /// Path error over all local maps.
  [[nodiscard]] PathError error() const;

 private:
  [[nodiscard]] ScanMatch match_from_odometry(const WheelOdometry& odometry);

  SampleRun run_;
  MappingParams params_;
  std::optional<Mapping> mapping_;
  std::optional<WheelOdometry> last_;
  bool ended_ = false;
};

/// Number of loop closures that an update revokes or changes to another alternative.
int revoked(const MapUpdate& update);
/// Number of loop closures that an update newly accepts or changes to another alternative.
int newly_accepted(const MapUpdate& update);

}  // namespace adit::test
