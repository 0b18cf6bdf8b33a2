// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace adit {

/// What a device wants of its port, in this order.
struct PortRequest {
  std::optional<int> baud;  ///< new baud rate; what was received before is dropped
  std::vector<std::uint8_t> bytes;
};

/// The protocol of one device, without port, bus or clock. All times are those of a clock that does
/// not jump [µs].
class DeviceProtocol {
 public:
  virtual ~DeviceProtocol() = default;

  /// The port was opened, or opened again.
  virtual void start(std::int64_t now_us) = 0;

  /// To be called at a fixed period (50 ms unless the device says otherwise), for timeouts and for
  /// what is sent regularly.
  virtual void tick(std::int64_t now_us) = 0;

  virtual std::vector<PortRequest> take_requests() = 0;

  /// Whether the device measures and sends.
  [[nodiscard]] virtual bool is_streaming() const = 0;

  /// What prevents that readings are as they should be, one clause; empty if nothing does.
  [[nodiscard]] virtual std::string problem() const = 0;

  /// Messages of the device since the start, and those of them that were damaged on the line.
  struct LineCounts {
    std::int64_t messages = 0;
    std::int64_t corrupt = 0;
  };
  [[nodiscard]] virtual LineCounts line_counts() const = 0;
};

/// A protocol with one kind of reading.
template <class Reading>
class ReadingDevice : public DeviceProtocol {
 public:
  /// Bytes that were read at this time. Returns the readings that are complete with them, in order
  /// of time, each stamped with the time of measurement by the clock of `now_us`.
  virtual std::vector<Reading> receive(std::span<const std::uint8_t> bytes,
                                       std::int64_t now_us) = 0;
};

}  // namespace adit
