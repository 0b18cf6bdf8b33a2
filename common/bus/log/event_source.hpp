// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
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

  /// The next event, or nothing at the end. The view is valid for the lifetime of the source.
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

/// Events of an LCM log. The constructor scans the file once to find and sort them; the file must
/// not be truncated during the lifetime of this object. Throws std::runtime_error if the file
/// cannot be read or is not empty and holds no event.
class LogFile final : public EventSource {
 public:
  explicit LogFile(const std::filesystem::path& path);

  std::optional<LogEventView> next() override;
  [[nodiscard]] std::size_t size() const override { return events_.size(); }
  [[nodiscard]] const LogHealth& health() const { return health_; }
  /// All events, independent of the position of `next`.
  [[nodiscard]] std::span<const LogEventView> events() const { return events_; }

 private:
  MappedFile file_;
  LogHealth health_;
  std::vector<LogEventView> events_;
  std::size_t next_ = 0;
};

}  // namespace adit
