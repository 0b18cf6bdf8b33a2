// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/records/play_logs.hpp"

#include <cstddef>

#include "common/bus/log/event_source.hpp"
#include "common/bus/log/lcm_log.hpp"

namespace adit {
namespace {

constexpr std::size_t kEventsPerProgress = 10'000;

}  // namespace

void play_logs(const std::vector<std::filesystem::path>& logs, const ChannelSet& selected,
               MemoryBus& bus, const std::function<void(double)>& progress,
               const std::function<void()>& after_event) {
  for (std::size_t i = 0; i < logs.size(); ++i) {
    LogReader reader(logs[i]);
    std::size_t events = 0;
    while (const auto event = reader.next()) {
      if (selected.contains(event->channel) && is_playable_after(event->utime, bus.now_utime())) {
        bus.inject(event->utime, event->channel, event->data);
        after_event();
      }
      if (++events % kEventsPerProgress != 0) continue;
      progress((static_cast<double>(i) + reader.fraction_read()) /
               static_cast<double>(logs.size()));
    }
  }
}

}  // namespace adit
