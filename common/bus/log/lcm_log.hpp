// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/files/new_file.hpp"
#include "common/files/output_file.hpp"
#include "common/files/zstd_stream.hpp"

namespace adit {

/// One message of a log.
struct LogEvent {
  std::int64_t utime = 0;  ///< time of recording [µs since the epoch]
  std::string channel;
  std::vector<std::uint8_t> data;

  friend bool operator==(const LogEvent&, const LogEvent&) = default;
};

/// A message in place: valid as long as the bytes it refers to.
struct LogEventView {
  std::int64_t utime = 0;
  std::string_view channel;
  std::span<const std::uint8_t> data;
};

}  // namespace adit

/// LCM's event log: a sequence of events, each a header, the channel and the data. Numbers are
/// big-endian. Header: sync word, event number (8), time [µs] (8), length of the channel, length of
/// the data (4 each).
namespace adit::log_format {

inline constexpr std::uint32_t kSync = 0xEDA1DA01;
inline constexpr std::size_t kHeaderBytes = 28;
inline constexpr std::size_t kChannelLengthMax = 63;

}  // namespace adit::log_format

namespace adit {

/// Integrity of a log.
struct LogHealth {
  std::size_t events = 0;
  std::size_t corrupt_bytes = 0;     ///< skipped, in all corrupt regions
  std::size_t corrupt_regions = 0;   ///< times that the reader searched for the next event
  std::size_t truncated_bytes = 0;   ///< of an incomplete event at the end of the file
  std::size_t unreadable_bytes = 0;  ///< in pages that the disk could not read

  LogHealth& operator+=(const LogHealth& part);
};

/// What is wrong with a log, for a person; one clause each.
std::vector<std::string> damage_warnings(const LogHealth& health, const std::string& file);

/// Parses the events of an LCM log from arbitrary bytes, in the order of the file. Where no event
/// begins, the parser searches for the next one. An event is corrupt if no event follows at its end
/// and another event begins inside it. Linear in the number of bytes.
class LogParser {
 public:
  /// What the bytes end with.
  enum class End {
    kOfLog,
    kOfPart,  ///< more bytes follow, to be parsed from `position` on
  };

  explicit LogParser(std::span<const std::uint8_t> bytes, End end = End::kOfLog)
      : bytes_(bytes), end_(end) {}

  /// The next event, or nothing at the end. Of a part that is before the first event that the bytes
  /// which follow may change.
  std::optional<LogEventView> next();

  /// Final after `next` has returned nothing.
  [[nodiscard]] const LogHealth& health() const { return health_; }

  /// Bytes read so far.
  [[nodiscard]] std::size_t position() const { return position_; }

 private:
  struct Extent;

  [[nodiscard]] std::optional<Extent> event_at(std::size_t at) const;
  [[nodiscard]] bool is_followed_by_event(std::size_t end) const;
  [[nodiscard]] std::size_t find_event(std::size_t from, std::size_t to) const;
  [[nodiscard]] bool depends_on_more() const;
  void skip_to(std::size_t at);

  std::span<const std::uint8_t> bytes_;
  End end_;
  std::size_t position_ = 0;
  LogHealth health_;
};

/// Writes an LCM log with events numbered from 0, compressed with zstd if the name ends with .zst:
/// frames of a few MB, each of whole events, each readable alone. Throws FileError with the path if
/// a write fails, after which the log ends with an earlier, whole event; buffered events are known
/// to be written only after `close`.
class LogWriter {
 public:
  enum class Name {
    kFromStart,  ///< a recording, of which the part until a power loss counts
    kWhenClosed  ///< a result, which exists as a whole or not at all (NewFile)
  };

  /// Of a compressed log.
  static constexpr const char* kCompressedExtension = ".zst";

  explicit LogWriter(const std::filesystem::path& path, Name name = Name::kFromStart);

  /// Writes what is buffered, as far as that is possible. Whoever must know calls `close`.
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  void write(const LogEventView& event);

  /// Flushes and closes the log.
  void close();

  [[nodiscard]] std::int64_t events() const { return events_; }

 private:
  void flush();

  std::optional<NewFile> new_file_;
  OutputFile file_;
  std::optional<ZstdEncoder> encoder_;
  std::string buffer_;  ///< whole events
  std::int64_t events_ = 0;
};

enum class LogForm { kPlain, kCompressed };

/// The name of the compressed form of a log.
std::filesystem::path compressed_name(std::filesystem::path log);

/// A log by its plain name: the compressed one if only that exists.
std::filesystem::path plain_or_compressed(const std::filesystem::path& log);

}  // namespace adit
