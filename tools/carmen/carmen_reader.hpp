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

/// What a log yields, in the order of its lines.
using CarmenRecord = std::variant<WheelOdometry, CarmenScan>;

/// What was found in a log so far. The lines that were refused are kept by reason, so that a log
/// full of errors still makes a short report.
struct CarmenReport {
  struct Rejected {
    std::string_view reason;
    std::size_t count = 0;
    std::vector<std::size_t> first_lines;  ///< numbers of the first few, from 1
  };

  std::size_t lines = 0;
  std::size_t scans = 0;
  std::size_t odometry_lines = 0;
  std::vector<Rejected> rejected;  ///< in the order of first occurrence

  [[nodiscard]] std::size_t rejected_lines() const;
  /// One sentence for each reason: "lines 155, 177, 196 and 858 more: a time that …".
  [[nodiscard]] std::vector<std::string> sentences() const;
};

/// Tells stamps that fell out of the log's order from those that carry it on. Neighbouring lines
/// may come a little late; a line from long before its neighbours has a garbled stamp, unless the
/// next line agrees with it: then the clock was set back, and the log goes on from there.
class StampOrder {
 public:
  bool accepts(std::int64_t utime);

 private:
  std::optional<std::int64_t> latest_;
  std::optional<std::int64_t> outlier_;
};

/// Reads a CARMEN log, plain or gzip, line by line in constant memory. A scan comes after the
/// odometry that its own line holds. Bad lines, and the break in a damaged gzip file, go into the
/// report and are skipped; a file that cannot be opened throws std::runtime_error.
class CarmenReader {
 public:
  explicit CarmenReader(const std::filesystem::path& path);

  /// The next record, or nothing at the end of the log.
  std::optional<CarmenRecord> next();

  [[nodiscard]] const CarmenReport& report() const { return report_; }
  /// How much of the file has been read, 0 to 1.
  [[nodiscard]] double fraction_read() const { return source_.fraction_read(); }

 private:
  std::optional<CarmenRecord> accept(CarmenLine line);
  std::optional<CarmenRecord> accept_odometry(const WheelOdometry& odometry);
  std::optional<CarmenRecord> accept_scan(CarmenScan scan);
  void reject(std::string_view reason);

  GzipLineReader source_;
  StampOrder order_;
  CarmenReport report_;
  std::optional<CarmenScan> pending_;  // waits behind its own odometry
};

}  // namespace adit
