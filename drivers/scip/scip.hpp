// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/laser/laser_device.hpp"
#include "drivers/scip/session.hpp"
#include "drivers/timing/device_clock.hpp"

#include "common/sensing/laser_scan.hpp"

namespace adit {

/// One laser with SCIP 2.0 (Hokuyo URG and UTM) without its port: bytes in, scans and requests out.
/// The stamps of the laser are mapped to the clock of the computer by DeviceClock.
class Scip final : public LaserDevice {
 public:
  using Params = ScipParams;

  /// A reading where nothing returned [m]: farther than any `range_max_m`.
  static constexpr float kNoReturnM = 100.0F;

  /// Throws std::invalid_argument, with the remedy, for parameters that contradict each other.
  Scip(const ScipParams& params, LaserId laser);

  void start(std::int64_t now_us) override;
  std::vector<LaserScan> receive(std::span<const std::uint8_t> bytes, std::int64_t now_us) override;
  void tick(std::int64_t now_us) override { session_.tick(now_us); }
  std::vector<PortRequest> take_requests() override { return session_.take_requests(); }
  [[nodiscard]] bool is_streaming() const override { return session_.is_streaming(); }
  [[nodiscard]] std::string problem() const override;
  [[nodiscard]] LineCounts line_counts() const override;

  [[nodiscard]] const DeviceClock& clock() const { return clock_; }

 private:
  [[nodiscard]] std::int64_t device_us(std::uint32_t time_ms) const;
  bool accept_stamp(std::int64_t at_us, std::int64_t arrival_us);
  [[nodiscard]] std::optional<LaserScan> laser_scan(const ScipSession::Scan& scan);
  [[nodiscard]] float range_m(std::uint32_t raw_mm) const;

  ScipParams params_;
  double range_max_m_;  ///< of the configuration
  ScipSession session_;
  DeviceClock clock_;
  std::optional<std::int64_t> last_us_;  ///< stamp of the last scan by the laser,
  std::int64_t last_arrival_us_ = 0;     ///< and its arrival
  int implausible_ = 0;                  ///< stamps, one after the other
};

}  // namespace adit
