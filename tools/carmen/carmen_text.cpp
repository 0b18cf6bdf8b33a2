// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/carmen/carmen_text.hpp"

#include <cstdio>

namespace adit {
namespace {

void append(std::string& line, const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof(text), format, value);
  line += text;
}

void append(std::string& line, const Pose2& pose) {
  for (const double value : {pose.x, pose.y, pose.theta}) append(line, " %.6f", value);
}

}  // namespace

std::string flaser_line(const CarmenScan& scan) {
  std::string line = "FLASER " + std::to_string(scan.scan.ranges_m.size());
  for (const float range : scan.scan.ranges_m) append(line, " %.2f", range);
  append(line, scan.T_log_laser);
  append(line, scan.odometry.T_wheel_body);
  const double seconds = static_cast<double>(scan.scan.utime) * 1e-6;
  append(line, " %.6f adit", seconds);
  append(line, " %.6f", seconds);
  return line;
}

}  // namespace adit
