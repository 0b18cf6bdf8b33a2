// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/bus/log_event.hpp"

namespace adit {

/// What a log looked like, apart from its events.
struct LogHealth {
  std::size_t events = 0;
  std::size_t corrupt_bytes = 0;      ///< skipped, in all stretches
  std::size_t corrupt_stretches = 0;  ///< places where the reader had to look for the next event
  std::size_t truncated_bytes = 0;    ///< of an event that the end of the file cut off
};

/// Reads the events of an LCM log out of its bytes, whatever these are, in the order of the file.
/// Where no event is, it looks for the next one. An event whose length leads elsewhere than to an
/// event is taken for corrupt if another event begins inside of it. Linear in the bytes.
class LogParser {
 public:
  explicit LogParser(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  /// Nothing at the end.
  std::optional<LogEventView> next();

  /// Complete when `next` has given nothing.
  [[nodiscard]] const LogHealth& health() const { return health_; }

  /// Bytes read so far.
  [[nodiscard]] std::size_t position() const { return position_; }

 private:
  struct Extent;

  [[nodiscard]] std::optional<Extent> event_at(std::size_t at) const;
  [[nodiscard]] bool leads_to_an_event(std::size_t end) const;
  [[nodiscard]] std::size_t find_event(std::size_t from, std::size_t to) const;
  void skip_to(std::size_t at);

  std::span<const std::uint8_t> bytes_;
  std::size_t position_ = 0;
  LogHealth health_;
};

}  // namespace adit
