// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <set>
#include <string>

namespace adit::test {

/// What a log says where a person reads it, that is no harm in a page.
inline constexpr const char* kHtmlInjection = "<script>alert(\"x\")</script> & 'more'";

inline constexpr std::int64_t kMissionUtime = 1'600'000'000'000'000;
inline constexpr double kMissionS = 50.0;

struct MissionLogOptions {
  std::set<std::string, std::less<>> omitted_channels;  ///< channels
  double from_s = 0.0;
  double to_s = std::numeric_limits<double>::infinity();
};

/// Writes the log of a small mission, made by hand: 10 m down a drift 4 m wide, a 3D scan ahead
/// with a path and one behind with none, and home. One closure of two is taken back, one opening of
/// three is open, the guard stops once, planning starts again once.
void write_mission_log(const std::filesystem::path& path, const MissionLogOptions& options = {});

}  // namespace adit::test
