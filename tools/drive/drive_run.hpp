// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/live/world_choice.hpp"

namespace adit {

/// A drive through a mine in one process, as fast as it goes.
struct DriveRunOptions {
  WorldChoice world;
  std::filesystem::path waypoints;  ///< as read_waypoints takes it
  std::filesystem::path log;        ///< everything on the bus; an LCM log
  std::filesystem::path truth;      ///< the true path in the TUM format; empty: not written
  std::filesystem::path config;     ///< section `sim`; empty: defaults
  std::vector<std::string> faults;  ///< as parse_fault takes them
};

struct DriveRunResult {
  double simulated_s = 0.0;
  double wall_s = 0.0;  ///< of the drive, without building the mine
  double distance_travelled_m = 0.0;
  std::int64_t messages = 0;
  std::string failure;  ///< why it ended before its end; empty if it did not
};

/// When every such drive begins: 2003-05-30 00:00:00 UTC, the day Groundhog went into the Mathies
/// mine.
inline constexpr std::int64_t kDriveStartUtime = 1'054'252'800'000'000;

/// Called with the share of the way that is done, 0 to 1.
using DriveProgress = std::function<void(double)>;

/// Drives along the waypoints to their end, or until the run fails; the log is complete until then.
/// The same options give the same bytes. Throws for what cannot be read, built or written.
DriveRunResult run_drive(const DriveRunOptions& options, const DriveProgress& progress = {});

}  // namespace adit
