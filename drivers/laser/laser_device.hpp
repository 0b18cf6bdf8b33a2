// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/sensing/laser_scan.hpp"
#include "common/sensing/spinning_lidar.hpp"

namespace adit {

/// What a device wants of its port, in this order.
struct PortRequest {
  std::optional<int> baud;  ///< new baud rate; what was received before is dropped
  std::vector<std::uint8_t> bytes;
};

/// The protocol of one laser, without port, bus or clock: bytes in, scans and requests out. All
/// times are those of a clock that does not jump [µs].
class LaserDevice {
 public:
  virtual ~LaserDevice() = default;

  /// The port was opened, or opened again.
  virtual void start(std::int64_t now_us) = 0;

  /// Bytes that were read at this time. Returns the scans that are complete with them, in order of
  /// time, each stamped with the time of its first beam.
  virtual std::vector<LaserScan> receive(std::span<const std::uint8_t> bytes,
                                         std::int64_t now_us) = 0;

  /// Revolutions of a spinning lidar that are to be published, in order of time; their level views
  /// are among the scans of the same call of receive().
  virtual std::vector<LidarRevolution> take_revolutions() { return {}; }

  /// To be called every 50 ms or so, for timeouts.
  virtual void tick(std::int64_t now_us) = 0;

  virtual std::vector<PortRequest> take_requests() = 0;

  /// Whether the laser measures and sends.
  [[nodiscard]] virtual bool is_streaming() const = 0;

  /// What prevents that scans are as they should be, one clause; empty if nothing does.
  [[nodiscard]] virtual std::string problem() const = 0;

  /// Messages of the laser since the start, and those of them that were damaged on the line.
  struct LineCounts {
    std::int64_t messages = 0;
    std::int64_t corrupt = 0;
  };
  [[nodiscard]] virtual LineCounts line_counts() const = 0;
};

}  // namespace adit
