// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace adit {

/// Drives whatever vehicle is on LCM.
struct LiveDriveOptions {
  std::filesystem::path waypoints;  ///< as read_waypoints takes it; for drive_by_waypoints
  std::filesystem::path config;     ///< section `vehicle`; empty: defaults
  std::string lcm_url;
};

/// By the keys of the terminal, 20 times a second, until q, SIGINT or SIGTERM; then stands. Times
/// of commands are those of a simulator where one says them. Throws where standard input is no
/// terminal.
void drive_by_keys(const LiveDriveOptions& options);

/// Along waypoints by TRUTH, to their end. A simulator may wait for it by the name `drive`. Throws
/// std::runtime_error with the reason where the run fails or the driver gives up. A simulator that
/// waits for it stands still once it has ended.
void drive_by_waypoints(const LiveDriveOptions& options);

}  // namespace adit
