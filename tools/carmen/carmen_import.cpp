// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/carmen/carmen_import.hpp"

#include <stdexcept>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/sensing.hpp"
#include "tools/log_times/reorder_buffer.hpp"

namespace adit {
namespace {

struct ReadingWriter {
  LogWriter& log;

  void operator()(const WheelOdometry& odometry) const { write_reading(log, odometry); }
  void operator()(const CarmenScan& scan) const { write_reading(log, scan.scan); }
};

std::int64_t utime_of(const CarmenRecord& record) {
  if (const auto* scan = std::get_if<CarmenScan>(&record)) return scan->scan.utime;
  return std::get<WheelOdometry>(record).utime;
}

/// The first pass, which judges the times, takes this share of the progress.
constexpr double kJudgedShare = 0.4;

void copy_readings(CarmenReader& reader, const std::filesystem::path& lcm_log,
                   const std::function<void(double)>& progress) {
  LogWriter log(lcm_log, LogWriter::Name::kWhenClosed);
  ReorderBuffer<CarmenRecord> in_order(
      [&](const CarmenRecord& record) { std::visit(ReadingWriter{log}, record); });
  while (auto record = reader.next()) {
    const std::int64_t utime = utime_of(*record);
    in_order.add(utime, std::move(*record));
    progress(kJudgedShare + (1.0 - kJudgedShare) * reader.fraction_read());
  }
  in_order.flush();
  const CarmenReport& report = reader.report();
  if (report.scans + report.odometry_lines > 0) log.close();
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
  CarmenReader reader(carmen_log, [&](double read) { progress(kJudgedShare * read); });
  copy_readings(reader, lcm_log, progress);
  const CarmenReport& report = reader.report();
  if (report.scans + report.odometry_lines == 0) {
    throw std::runtime_error(
        fmt::format("no valid FLASER, ROBOTLASER1 or ODOM line in {}", carmen_log.string()));
  }
  return report;
}

}  // namespace adit
