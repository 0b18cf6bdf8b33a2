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

/// Events in order of time; those of one time in the order in which they were recorded.
class EventSource {
 public:
  virtual ~EventSource() = default;

  /// Nothing at the end. Valid until the source goes.
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

/// Events of an LCM log. The file is gone through once to find and sort them; it must not be
/// shortened while this lives. Throws std::runtime_error where it cannot be read or holds bytes
/// but not one event.
class LogFile final : public EventSource {
 public:
  explicit LogFile(const std::filesystem::path& path);

  std::optional<LogEventView> next() override;
  [[nodiscard]] std::size_t size() const override { return events_.size(); }
  [[nodiscard]] const LogHealth& health() const { return health_; }
  /// All of them, whatever `next` has given already.
  [[nodiscard]] std::span<const LogEventView> events() const { return events_; }

 private:
  MappedFile file_;
  LogHealth health_;
  std::vector<LogEventView> events_;
  std::size_t next_ = 0;
};

}  // namespace adit
