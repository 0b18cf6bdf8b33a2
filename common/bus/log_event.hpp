// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace adit {

/// One message of a log.
struct LogEvent {
  std::int64_t utime = 0;  ///< when it was recorded [µs since the epoch]
  std::string channel;
  std::vector<std::uint8_t> data;

  friend bool operator==(const LogEvent&, const LogEvent&) = default;
};

/// The same, in place: valid as long as what it was read from.
struct LogEventView {
  std::int64_t utime = 0;
  std::string_view channel;
  std::span<const std::uint8_t> data;
};

}  // namespace adit
