// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace adit {

/// Options of driving a vehicle on LCM.
struct LiveDriveOptions {
  std::filesystem::path waypoints;  ///< for read_waypoints(), used by drive_by_waypoints()
  std::filesystem::path config;     ///< section `vehicle`; empty: defaults
  std::string lcm_url;
  std::string key;  ///< file of the key that seals the commands; empty: not sealed
};

/// Drives by the keys of the terminal, with 20 commands per second, until q, SIGINT or SIGTERM;
/// then stops the vehicle. Commands are stamped with simulated time if there is SIM_TIME. Throws if
/// standard input is not a terminal.
void drive_by_keys(const LiveDriveOptions& options);

/// Drives along waypoints by TRUTH to their end. A simulator may wait for it by the name `drive`;
/// that simulator halts when the drive ends. Throws std::runtime_error with the reason if the run
/// fails or the driver aborts.
void drive_by_waypoints(const LiveDriveOptions& options);

}  // namespace adit
