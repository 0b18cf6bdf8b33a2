// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "drivers/laser/laser_device.hpp"
#include "drivers/sick_lms2xx/session.hpp"
#include "drivers/sick_lms2xx/settings.hpp"
#include "drivers/timing/scan_counter.hpp"

#include "common/sensing/laser_scan.hpp"

namespace adit {

/// One SICK LMS-200, 211, 221 or 291 without its port: bytes in, scans and requests out. A scan is
/// stamped with the time of its first beam, which follows from the rate of the scans and not from
/// its arrival (ScanCounter).
class SickLms2xx final : public LaserDevice {
 public:
  using Params = SickLms2xxParams;

  /// Throws std::invalid_argument, with the remedy, for what no LMS can be set to, and for a
  /// `range_max_m` of the configuration at which a reading without return would be a wall.
  SickLms2xx(const SickLms2xxParams& params, LaserId laser);

  void start(std::int64_t now_us) override;
  std::vector<LaserScan> receive(std::span<const std::uint8_t> bytes, std::int64_t now_us) override;
  void tick(std::int64_t now_us) override { session_.tick(now_us); }
  std::vector<PortRequest> take_requests() override { return session_.take_requests(); }
  [[nodiscard]] bool is_streaming() const override { return session_.is_streaming(); }
  [[nodiscard]] std::string problem() const override;
  [[nodiscard]] LineCounts line_counts() const override;

  /// Scans that could not be told from the one before by their time of arrival.
  [[nodiscard]] std::int64_t untimed() const { return untimed_; }
  [[nodiscard]] const LmsSession& session() const { return session_; }
  /// Between two scans by the clock of the computer [µs].
  [[nodiscard]] double scan_period_us() const { return counter_.period_us(); }

 private:
  [[nodiscard]] std::vector<std::int64_t> arrivals(
      const std::vector<LmsSession::Scan>& scans) const;
  [[nodiscard]] LaserScan laser_scan(const LmsMeasuredValues& values, std::int64_t utime) const;

  SickLms2xxParams params_;
  LmsSession session_;
  ScanCounter counter_;
  std::int64_t scans_min_;  ///< periods between two scans on the line, at least
  std::int64_t untimed_ = 0;
  std::uint8_t status_ = 0;  ///< of the last scan
};

}  // namespace adit
