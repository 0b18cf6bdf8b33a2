// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "procs/mapping/mapping.hpp"
#include "tools/eval/path_error.hpp"
#include "tools/sim/sample_run.hpp"

namespace adit::test {

/// The drive of figure 4 of the paper, local map by local map: through two parallel drifts, round a
/// long loop and back into the first of them (parallel_mine). The poses come from the wheels alone,
/// whose heading turns away from the truth, so that the robot may believe itself in the other one.
class ParallelDrive {
 public:
  explicit ParallelDrive(double yaw_bias_deg_per_m,
                         const DisplacementErrorParams& assumed_error = drifting_odometry_error());

  /// The error that makes either corridor likely: 10° over the loop, one standard deviation.
  static DisplacementErrorParams drifting_odometry_error();

  /// Drives on to the end of a local map. Nothing at the end of the way.
  std::optional<MapUpdate> next();

  /// Lets the mapping begin again with what it had stored. The odometry goes on.
  void restart(StoredMap stored);

  [[nodiscard]] const Mapping& mapping() const { return *mapping_; }

  /// How far the newest local map is from where it truly was, seen from the first. [m]
  [[nodiscard]] double newest_error_m() const;
  /// Of all local maps.
  [[nodiscard]] PathError error() const;

 private:
  [[nodiscard]] ScanMatch match_from_odometry(const WheelOdometry& odometry);

  SampleRun run_;
  MappingParams params_;
  std::optional<Mapping> mapping_;
  std::optional<WheelOdometry> last_;
  bool ended_ = false;
};

/// How many decisions of an update are these.
int revoked(const MapUpdate& update);         ///< closures that were in force and are so no more
int newly_accepted(const MapUpdate& update);  ///< closures that are in force and were not

}  // namespace adit::test
