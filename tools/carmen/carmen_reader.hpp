// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tools/carmen/carmen_line.hpp"
#include "tools/carmen/gzip_line_reader.hpp"
#include "tools/log_times/time_assignment.hpp"

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
  std::size_t rejected_scans = 0;  ///< FLASER and ROBOTLASER1 lines
  std::vector<Rejected> rejected;  ///< in the order of first occurrence
  TimeChoice times;                ///< the times that the readings have
  std::string damage;              ///< what is lost of a compressed file; empty if it is intact

  [[nodiscard]] std::size_t rejected_lines() const;
  /// What was skipped. One text per reason, "lines 155, 177, 196 and 858 more: timestamp not
  /// positive", and the damage.
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
/// reported. A first pass judges the times (TimeJudge); all readings have the chosen ones. Throws
/// std::runtime_error if the file cannot be opened.
class CarmenReader {
 public:
  /// `progress` is called in the first pass with the fraction of the file that has been read.
  explicit CarmenReader(const std::filesystem::path& path,
                        const std::function<void(double)>& progress = {});

  /// The next record, or nothing at the end of the log.
  std::optional<CarmenRecord> next();

  [[nodiscard]] const CarmenReport& report() const { return report_; }
  /// Fraction of the file that has been read, 0 to 1.
  [[nodiscard]] double fraction_read() const { return source_.fraction_read(); }

 private:
  std::optional<CarmenRecord> accept(CarmenLine line);
  std::optional<CarmenRecord> accept_odometry(CarmenOdometry line);
  std::optional<CarmenRecord> accept_scan(CarmenScan scan);
  bool accept_time(std::int64_t utime);
  void reject(std::string_view reason);

  GzipLineReader source_;
  TimeAssignment times_;
  TimestampFilter timestamps_;
  CarmenReport report_;
  std::optional<CarmenScan> pending_;  // follows its odometry
};

}  // namespace adit
