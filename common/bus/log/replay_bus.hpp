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
  /// Channels of the log that are not replayed, because the stages on this bus publish them again.
  std::set<std::string, std::less<>> excluded_channels;
  std::size_t max_message_bytes = Dispatcher::kDefaultMaxMessageBytes;
};

/// Replays events to the stages on it, in order of time and as fast as they are handled. All
/// messages on the bus, inputs and outputs, are written to `output` (may be null) with the bus time
/// of the input that caused them; the same events and stages give the same bytes.
class ReplayBus final : public MemoryBus {
 public:
  /// Called with the share of replayed events, 0 to 1.
  using Progress = std::function<void(double)>;

  /// `source` and `output` must outlive this.
  ReplayBus(EventSource& source, LogWriter* output, ReplayOptions options = {});

  /// Replays all events. An exception thrown by a handler ends the replay.
  void run(const Progress& progress = {});

  /// Number of events with an implausible time; they are not replayed.
  [[nodiscard]] std::size_t rejected_events() const { return rejected_events_; }

 private:
  EventSource& source_;
  ReplayOptions options_;
  std::size_t rejected_events_ = 0;
};

}  // namespace adit
