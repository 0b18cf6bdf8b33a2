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

/// Options of a simulated drive in one process, as fast as possible.
struct DriveRunOptions {
  WorldChoice world;
  std::filesystem::path waypoints;  ///< for read_waypoints()
  std::filesystem::path log;        ///< LCM log of all messages
  std::filesystem::path truth;      ///< the true path in the TUM format; empty: not written
  std::filesystem::path config;     ///< section `sim`; empty: defaults
  std::vector<std::string> faults;  ///< for parse_fault()
};

struct DriveRunResult {
  double simulated_s = 0.0;
  double wall_s = 0.0;  ///< of the drive, without building the world
  double distance_travelled_m = 0.0;
  std::int64_t messages = 0;
  std::string failure;  ///< why the drive failed; empty if it completed
};

/// Simulated time at the start of every drive: 2003-05-30 00:00:00 UTC, the day Groundhog went into
/// the Mathies mine.
inline constexpr std::int64_t kDriveStartUtime = 1'054'252'800'000'000;

/// Called with the completed fraction of the path, 0 to 1.
using DriveProgress = std::function<void(double)>;

/// Drives along the waypoints to their end, or until the run fails; the log is complete until then.
/// The same options give the same bytes. Throws for invalid options and on read and write errors.
DriveRunResult run_drive(const DriveRunOptions& options, const DriveProgress& progress = {});

}  // namespace adit
