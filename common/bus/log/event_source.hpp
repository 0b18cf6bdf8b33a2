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

/// Reads the events of a file in their order; the pages behind the reader are released, so that
/// memory does not grow with the file. Views are valid for the lifetime of this object; the file
/// must not be truncated during it. Throws std::runtime_error if the file cannot be read.
class LogReader {
 public:
  explicit LogReader(const std::filesystem::path& path) : file_(path), parser_(file_.bytes()) {}

  std::optional<LogEventView> next();
  [[nodiscard]] const LogHealth& health() const { return parser_.health(); }
  /// Fraction of the file that has been read, 0 to 1.
  [[nodiscard]] double fraction_read() const;
  [[nodiscard]] bool empty() const { return file_.bytes().empty(); }
  /// Tells that the events up to this one are not needed in memory for now.
  void release_before(const LogEventView& event);

 private:
  MappedFile file_;
  LogParser parser_;
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

/// Events of an LCM log. The constructor scans the file once to find and sort them, and keeps their
/// places (48 bytes per event). Throws std::runtime_error if the file cannot be read or is not
/// empty and holds no event.
class LogFile final : public EventSource {
 public:
  /// The time of an event for replay; called in the order of the file.
  using TimeOf = std::function<std::int64_t(const LogEventView&)>;

  /// Events have their time of recording, or that of `time_of`.
  explicit LogFile(const std::filesystem::path& path, const TimeOf& time_of = {});

  std::optional<LogEventView> next() override;
  [[nodiscard]] std::size_t size() const override { return events_.size(); }
  [[nodiscard]] const LogHealth& health() const { return reader_.health(); }
  /// All events, independent of the position of `next`.
  [[nodiscard]] std::span<const LogEventView> events() const { return events_; }

 private:
  LogReader reader_;
  std::vector<LogEventView> events_;
  std::size_t next_ = 0;
};

}  // namespace adit
