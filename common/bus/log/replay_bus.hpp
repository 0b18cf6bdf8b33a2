// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <set>
#include <string>

#include "common/bus/log/event_source.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/memory_bus.hpp"

namespace adit {

struct ReplayOptions {
  /// Channels of the log that are left out, because the stages on this bus publish them anew.
  std::set<std::string, std::less<>> excluded_channels;
  std::size_t max_message_bytes = Dispatcher::kDefaultMaxMessageBytes;
};

/// Plays events to the stages on it, in order of time and as fast as they take them. Everything on
/// the bus, inputs and outputs, goes to `output` (may be null) with the bus time of the input that
/// caused it; the same events and stages give the same bytes.
class ReplayBus final : public MemoryBus {
 public:
  /// Called with the share of the events that are done, 0 to 1.
  using Progress = std::function<void(double)>;

  /// `source` and `output` must outlive this.
  ReplayBus(EventSource& source, LogWriter* output, ReplayOptions options = {});

  /// Plays all events. What a handler throws, ends it.
  void run(const Progress& progress = {});

  /// Events of times that cannot be, which were left out.
  [[nodiscard]] std::size_t rejected_events() const { return rejected_events_; }

 private:
  EventSource& source_;
  ReplayOptions options_;
  std::size_t rejected_events_ = 0;
};

}  // namespace adit
