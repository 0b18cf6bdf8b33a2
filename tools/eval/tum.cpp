// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/tum.hpp"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <istream>
#include <ostream>
#include <sstream>

#include <fmt/format.h>

#include "common/files/file_utils.hpp"
#include "tools/eval/number_table.hpp"

namespace adit {
namespace {

constexpr std::int64_t kMicroseconds = 1'000'000;

double yaw(double qx, double qy, double qz, double qw) {
  return std::atan2(2.0 * (qw * qz + qx * qy), 1.0 - 2.0 * (qy * qy + qz * qz));
}

}  // namespace

void write_tum(std::ostream& out, const Trajectory& trajectory) {
  for (const auto& [utime, pose] : trajectory) {
    out << fmt::format("{}.{:06} {:.9f} {:.9f} 0 0 0 {:.12f} {:.12f}\n", utime / kMicroseconds,
                       utime % kMicroseconds, pose.x, pose.y, std::sin(pose.theta / 2.0),
                       std::cos(pose.theta / 2.0));
  }
}

void write_tum(const std::filesystem::path& path, const Trajectory& trajectory) {
  std::ostringstream text;
  write_tum(text, trajectory);
  write_text_file(text.str(), path);
}

Trajectory read_tum(std::istream& in, std::string_view name) {
  Trajectory trajectory;
  NumberTable table(in, name, 8);
  while (const auto row = table.next()) {
    const auto& v = *row;
    const double norm = std::hypot(std::hypot(v[4], v[5]), std::hypot(v[6], v[7]));
    if (std::abs(norm - 1.0) > 0.01) table.fail("the quaternion has no unit length");
    const std::int64_t utime = table.microseconds(v[0]);
    if (!trajectory.empty() && utime <= trajectory.back().utime) {
      table.fail("the time does not increase");
    }
    trajectory.push_back({utime, {v[1], v[2], yaw(v[4], v[5], v[6], v[7])}});
  }
  return trajectory;
}

Trajectory read_tum(const std::filesystem::path& path) {
  std::ifstream in = open_table(path);
  return read_tum(in, path.string());
}

}  // namespace adit
