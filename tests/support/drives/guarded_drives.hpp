// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/types/driving_state.hpp"
#include "common/types/planned_path.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// A drift of about 45 m that bends by up to 0.5 rad every few metres, 2.9 to 4.2 m wide between
/// rough walls, with posts, falls of rock and rails. Beside each obstacle at least `lane_m` are
/// left of the drift as planned, to the other side. The same for the same seed.
WorldDescription random_tunnel(int seed, double lane_m = 2.2);

/// A time in which the guard let the vehicle stand, between two moments at which it drove.
struct GuardStop {
  std::string reason;                ///< the first that it told
  double seconds = 0.0;              ///< until it was released, or the drive was given up
  double free_m = 0.0;               ///< of the path, with the guard's margins; 0.6 at most
  double at_m = 0.0;                 ///< progress on the path
  double clearance_m = 0.0;          ///< least that the path says of there and half a metre on
  double cross_track_error_m = 0.0;  ///< of the true body beside the path
};

/// A look, a plan and the drive along it.
struct GuardedDrive {
  PlanOutcome outcome = PlanOutcome::kBlocked;
  std::string reason;  ///< of the plan
  DrivingState state;  ///< at last
  double path_m = 0.0;
  double seconds = 0.0;
  std::vector<double> cross_track_error_m;  ///< of the true body beside the path, each 0.1 s
  std::vector<GuardStop> guard_stops;
  std::string failure;  ///< of the run: a collision, for one

  [[nodiscard]] bool arrived() const { return state.kind == DrivingState::Kind::kArrived; }
};

/// A robot that starts in a mine of one drift looks ahead, plans down the drift for `distance_m` at
/// most, and drives, so many times: all nodes from the lasers by scan matching to the wheels on one
/// bus, with a guard. A drive ends where driving says so, or after 120 s; the last one of a mine
/// where no path is found, or the run has failed.
std::vector<GuardedDrive> drive_guarded(const WorldDescription& mine, int scans,
                                        double distance_m = 8.0);

}  // namespace adit
