// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <set>
#include <string>

namespace adit::test {

/// A text in the log that must be escaped in the page.
inline constexpr const char* kHtmlInjection = "<script>alert(\"x\")</script> & 'more'";

inline constexpr std::int64_t kMissionUtime = 1'600'000'000'000'000;
inline constexpr double kMissionS = 50.0;

struct MissionLogOptions {
  std::set<std::string, std::less<>> omitted_channels;
  double from_s = 0.0;
  double to_s = std::numeric_limits<double>::infinity();
};

/// Writes the log of a small synthetic mission: 10 m into a tunnel 4 m wide, a 3D scan to the front
/// with a path and one to the rear without, and back. One loop closure of two is revoked, one
/// frontier of three is open, the guard stops once, planning restarts once.
void write_mission_log(const std::filesystem::path& path, const MissionLogOptions& options = {});

}  // namespace adit::test
