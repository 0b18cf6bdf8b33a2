// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/types/driving_state.hpp"
#include "common/types/planned_path.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// A tunnel of about 45 m that bends by up to 0.5 rad every few metres, 2.9 to 4.2 m wide between
/// rough walls, with posts, rock falls and rails. Each obstacle leaves at least `lane_m` of the
/// planned width free on one side. Deterministic for a seed.
WorldDescription random_tunnel(int seed, double lane_m = 2.2);

/// A period in which the guard stopped the vehicle.
struct GuardStop {
  std::string reason;                ///< the first of the stop orders
  double seconds = 0.0;              ///< until the release or the end of the drive
  double free_m = 0.0;               ///< free path ahead with the guard's margins, at most 0.6 m
  double at_m = 0.0;                 ///< progress on the path
  double clearance_m = 0.0;          ///< least clearance in the path over the next half metre
  double cross_track_error_m = 0.0;  ///< of the true pose
};

/// One cycle: a 3D scan, a plan and the drive along it.
struct GuardedDrive {
  PlanOutcome outcome = PlanOutcome::kBlocked;
  std::string reason;  ///< of the plan
  DrivingState state;  ///< at the end
  double path_m = 0.0;
  double seconds = 0.0;
  std::vector<double> cross_track_error_m;  ///< of the true pose, every 0.1 s
  std::vector<GuardStop> guard_stops;
  std::string failure;  ///< of the simulated run, such as a collision; empty if none

  [[nodiscard]] bool arrived() const { return state.kind == DrivingState::Kind::kArrived; }
};

/// Runs up to `scans` cycles in a mine of one tunnel: the robot scans ahead, plans at most
/// `distance_m` along the tunnel and drives. All nodes run on one bus: scan matching, scan
/// assembly, terrain, planning, driving and guard. A drive ends when driving arrives or fails, or
/// after 120 s. The first cycle without a path or with a failed run is the last one.
std::vector<GuardedDrive> drive_guarded(const WorldDescription& mine, int scans,
                                        double distance_m = 8.0);

}  // namespace adit
