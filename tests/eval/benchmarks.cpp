// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/eval/benchmarks.hpp"

#include <variant>

#include "tools/carmen/carmen_reader.hpp"

namespace adit {

Trajectory poses_of(const std::filesystem::path& log) {
  Trajectory poses;
  CarmenReader reader(log);
  while (const auto record = reader.next()) {
    const auto* scan = std::get_if<CarmenScan>(&*record);
    if (scan == nullptr) continue;
    if (!poses.empty() && scan->scan.utime <= poses.back().utime) continue;
    poses.push_back({scan->scan.utime, scan->T_log_laser});
  }
  return poses;
}

}  // namespace adit
