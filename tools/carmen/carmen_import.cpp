// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/carmen/carmen_import.hpp"

#include <stdexcept>
#include <variant>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

struct ReadingWriter {
  LogWriter& log;

  void operator()(const WheelOdometry& odometry) const { write_reading(log, odometry); }
  void operator()(const CarmenScan& scan) const { write_reading(log, scan.scan); }
};

void copy_readings(CarmenReader& reader, const std::filesystem::path& lcm_log,
                   const std::function<void(double)>& progress) {
  LogWriter log(lcm_log);
  while (const auto record = reader.next()) {
    std::visit(ReadingWriter{log}, *record);
    progress(reader.fraction_read());
  }
  log.close();
}

}  // namespace

void write_reading(LogWriter& log, const LaserScan& scan) {
  const auto bytes = encode(to_message(scan));
  log.write({scan.utime, channels::kLaserFront, bytes});
}

void write_reading(LogWriter& log, const WheelOdometry& odometry) {
  const auto bytes = encode(to_message(odometry));
  log.write({odometry.utime, channels::kWheelOdometry, bytes});
}

CarmenReport import_carmen(const std::filesystem::path& carmen_log,
                           const std::filesystem::path& lcm_log,
                           const std::function<void(double)>& progress) {
  std::error_code ignored;
  if (std::filesystem::equivalent(carmen_log, lcm_log, ignored)) {
    throw std::runtime_error(
        fmt::format("input and output are the same file: {}", lcm_log.string()));
  }
  CarmenReader reader(carmen_log);
  copy_readings(reader, lcm_log, progress);
  const CarmenReport& report = reader.report();
  if (report.scans + report.odometry_lines == 0) {
    std::filesystem::remove(lcm_log);
    throw std::runtime_error(
        fmt::format("no valid FLASER, ROBOTLASER1 or ODOM line in {}", carmen_log.string()));
  }
  return report;
}

}  // namespace adit
