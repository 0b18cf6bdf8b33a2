// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
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

/// LCM's event log: events one after the other, each a header, the channel, the data. Numbers are
/// big-endian. Header: sync word, event number (8), time [µs] (8), length of the channel, length of
/// the data (4 each).
namespace adit::log_format {

inline constexpr std::uint32_t kSync = 0xEDA1DA01;
inline constexpr std::size_t kHeaderBytes = 28;
inline constexpr std::size_t kChannelLengthMax = 63;

}  // namespace adit::log_format

namespace adit {

/// What a log looked like, apart from its events.
struct LogHealth {
  std::size_t events = 0;
  std::size_t corrupt_bytes = 0;    ///< skipped, in all stretches
  std::size_t corrupt_regions = 0;  ///< places where the reader had to look for the next event
  std::size_t truncated_bytes = 0;  ///< of an event that the end of the file cut off
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
  [[nodiscard]] bool is_followed_by_event(std::size_t end) const;
  [[nodiscard]] std::size_t find_event(std::size_t from, std::size_t to) const;
  void skip_to(std::size_t at);

  std::span<const std::uint8_t> bytes_;
  std::size_t position_ = 0;
  LogHealth health_;
};

/// Writes an LCM log, events numbered from 0. Throws std::runtime_error with the path where it
/// cannot write; what is still buffered is only known to be written after `close`.
class LogWriter {
 public:
  explicit LogWriter(const std::filesystem::path& path);

  void write(const LogEventView& event);

  /// Ends the log.
  void close();

  [[nodiscard]] std::int64_t events() const { return events_; }

 private:
  void require_good() const;

  std::string path_;
  std::ofstream file_;
  std::int64_t events_ = 0;
};

}  // namespace adit
