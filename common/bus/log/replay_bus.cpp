// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/log/replay_bus.hpp"

#include <utility>

#include "common/messages/fields/quantities.hpp"

namespace adit {

ReplayBus::ReplayBus(EventSource& source, LogWriter* output, ReplayOptions options)
    : MemoryBus(options.max_message_bytes), source_(source), options_(std::move(options)) {
  if (!output) return;
  tap([output](const ReceivedMessage& message) {
    output->write({message.utime, message.channel, message.bytes});
  });
}

void ReplayBus::run(const Progress& progress) {
  std::size_t done = 0;
  while (const auto event = source_.next()) {
    if (!is_plausible_utime(event->utime)) {
      ++rejected_events_;
    } else if (!options_.excluded_channels.contains(event->channel)) {
      inject(event->utime, event->channel, event->data);
    }
    ++done;
    if (progress) progress(static_cast<double>(done) / static_cast<double>(source_.size()));
  }
}

}  // namespace adit
