// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tools/carmen/carmen_line.hpp"
#include "tools/carmen/gzip_line_reader.hpp"

namespace adit {

/// A record of a log, in the order of its lines.
using CarmenRecord = std::variant<WheelOdometry, CarmenScan>;

/// Statistics of a log up to the current line. Rejected lines are grouped by reason, so that the
/// report of a damaged log stays short.
struct CarmenReport {
  struct Rejected {
    std::string_view reason;
    std::size_t count = 0;
    std::vector<std::size_t> first_lines;  ///< numbers of the first lines, from 1
  };

  std::size_t lines = 0;
  std::size_t scans = 0;
  std::size_t odometry_lines = 0;
  std::vector<Rejected> rejected;  ///< in the order of first occurrence

  [[nodiscard]] std::size_t rejected_lines() const;
  /// One text per reason: "lines 155, 177, 196 and 858 more: timestamp not positive".
  [[nodiscard]] std::vector<std::string> messages() const;
};

/// Rejects timestamps that are out of order. A timestamp may be up to one second older than the
/// newest one. An older timestamp is rejected as corrupt, unless the following one agrees with it:
/// then the clock was set back, and the log continues from there.
class TimestampFilter {
 public:
  bool accept(std::int64_t utime);

 private:
  std::optional<std::int64_t> latest_;
  std::optional<std::int64_t> outlier_;
};

/// Reads a CARMEN log, plain or gzip, line by line in constant memory. The odometry in the line of
/// a scan precedes the scan. Malformed lines and the damaged part of a gzip file are skipped and
/// reported. Throws std::runtime_error if the file cannot be opened.
class CarmenReader {
 public:
  explicit CarmenReader(const std::filesystem::path& path);

  /// The next record, or nothing at the end of the log.
  std::optional<CarmenRecord> next();

  [[nodiscard]] const CarmenReport& report() const { return report_; }
  /// Fraction of the file that has been read, 0 to 1.
  [[nodiscard]] double fraction_read() const { return source_.fraction_read(); }

 private:
  std::optional<CarmenRecord> accept(CarmenLine line);
  std::optional<CarmenRecord> accept_odometry(const WheelOdometry& odometry);
  std::optional<CarmenRecord> accept_scan(CarmenScan scan);
  void reject(std::string_view reason);

  GzipLineReader source_;
  TimestampFilter timestamps_;
  CarmenReport report_;
  std::optional<CarmenScan> pending_;  // follows its odometry
};

}  // namespace adit
