// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "common/bus/log/event_source.hpp"
#include "tools/log_times/time_choice.hpp"

namespace adit {

/// Whether an event is a reading that scan matching uses: of a planar laser, wheels or IMU.
bool is_reading(const LogEventView& event);

/// Both times of a reading: of its message, 0 if it cannot be decoded, and of the event.
RecordedTimes recorded_times(const LogEventView& reading);

/// Adds the times of an event to those that are judged, if it is a reading.
void add_times(const LogEventView& event, TimeJudge& judge);

/// The events of a log in which the message of each reading has the time of its event.
class RestampedEvents final : public EventSource {
 public:
  explicit RestampedEvents(std::unique_ptr<EventSource> source) : source_(std::move(source)) {}

  std::optional<LogEventView> next() override;
  [[nodiscard]] std::size_t size() const override { return source_->size(); }

 private:
  std::unique_ptr<EventSource> source_;
  std::vector<std::uint8_t> bytes_;  // of the last reading
};

}  // namespace adit
