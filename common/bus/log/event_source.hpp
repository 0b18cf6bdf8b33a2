// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "common/bus/log/lcm_log.hpp"
#include "common/files/mapped_file.hpp"
#include "common/files/zstd_stream.hpp"

namespace adit {

/// Events in order of time; events of equal time in order of recording.
class EventSource {
 public:
  virtual ~EventSource() = default;

  /// The next event, or nothing at the end. The view is valid until the next call.
  virtual std::optional<LogEventView> next() = 0;

  [[nodiscard]] virtual std::size_t size() const = 0;
};

/// Events in memory.
class EventList final : public EventSource {
 public:
  explicit EventList(std::vector<LogEvent> events);

  std::optional<LogEventView> next() override;
  [[nodiscard]] std::size_t size() const override { return events_.size(); }

 private:
  std::vector<LogEvent> events_;
  std::size_t next_ = 0;
};

/// The bytes of an LCM log: the mapped file, or, of a compressed one, a temporary file beside it
/// into which it is unpacked. Throws FileError.
class LogBytes {
 public:
  explicit LogBytes(const std::filesystem::path& path);

  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return plain().bytes(); }
  /// Tells that the bytes up to this one are not needed in memory for now.
  void release_before(const void* byte);
  /// Of the compression.
  [[nodiscard]] const ZstdDecoder::Damage& damage() const { return damage_; }
  /// Of the file and what it is unpacked into.
  [[nodiscard]] std::size_t unreadable_bytes() const {
    return file_.unreadable_bytes() + (unpacked_ ? unpacked_->unreadable_bytes() : 0);
  }
  /// The file that holds `bytes`.
  [[nodiscard]] const MappedFile& plain() const { return unpacked_ ? *unpacked_ : file_; }

 private:
  MappedFile file_;
  std::optional<MappedFile> unpacked_;
  ZstdDecoder::Damage damage_;
  std::size_t released_ = 0;
};

/// Reads the events of a file, plain or compressed with zstd, in their order. Memory does not grow
/// with the file. An event is valid until the next call; the file must not be truncated meanwhile.
/// Throws std::runtime_error if the file cannot be read.
class LogReader {
 public:
  explicit LogReader(const std::filesystem::path& path);

  std::optional<LogEventView> next();
  /// With the damage of the compression, in bytes of the compressed file.
  [[nodiscard]] LogHealth health() const;
  /// Fraction of the file that has been read, 0 to 1.
  [[nodiscard]] double fraction_read() const;
  [[nodiscard]] bool empty() const { return file_.bytes().empty(); }

 private:
  void unpack_more();

  MappedFile file_;
  std::optional<ZstdDecoder> decoder_;  ///< of a compressed file
  std::vector<std::uint8_t> window_;    ///< of its content
  bool unpacked_ = true;                ///< the window has the end of the content
  LogHealth before_;                    ///< of the windows before, and of unreadable events
  LogParser parser_;                    ///< of the file, or of the window
  std::size_t released_ = 0;
};

/// Events of an LCM log that is in order of time already, read in constant memory. `size` is their
/// number.
class LogStream final : public EventSource {
 public:
  LogStream(const std::filesystem::path& path, std::size_t size) : reader_(path), size_(size) {}

  std::optional<LogEventView> next() override { return reader_.next(); }
  [[nodiscard]] std::size_t size() const override { return size_; }

 private:
  LogReader reader_;
  std::size_t size_;
};

/// Events of an LCM log, plain or compressed. The constructor scans the file once to find and sort
/// them, and keeps their places (48 bytes per event). Views are valid for the lifetime of this
/// object; the file must not be truncated during it. Throws std::runtime_error if the file cannot
/// be read or is not empty and holds no event.
class LogFile final : public EventSource {
 public:
  /// The time of an event for replay; called in the order of the file.
  using TimeOf = std::function<std::int64_t(const LogEventView&)>;

  /// Events have their time of recording, or that of `time_of`.
  explicit LogFile(const std::filesystem::path& path, const TimeOf& time_of = {});

  std::optional<LogEventView> next() override;
  [[nodiscard]] std::size_t size() const override { return events_.size(); }
  [[nodiscard]] const LogHealth& health() const { return health_; }
  /// All events, independent of the position of `next`.
  [[nodiscard]] std::span<const LogEventView> events() const { return events_; }

 private:
  LogBytes bytes_;
  LogHealth health_;
  std::vector<LogEventView> events_;
  std::size_t next_ = 0;
};

/// Whether an event can be played after one of `before_utime`, 0 before the first. After a gap of a
/// day its time is damaged, and a bus would run its timers over the gap.
bool is_playable_after(std::int64_t utime, std::int64_t before_utime);

/// The logs by the time of their first event, whatever their names: `lcm-logger --rotate` gives the
/// newest one the first name. Logs without an event come last. Throws std::runtime_error for a log
/// that cannot be read.
std::vector<std::filesystem::path> in_order_of_time(std::vector<std::filesystem::path> logs);

}  // namespace adit
