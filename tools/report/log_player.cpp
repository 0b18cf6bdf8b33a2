// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/log_player.hpp"

#include <cstddef>

#include "common/bus/log_parser.hpp"
#include "common/files/mapped_file.hpp"
#include "common/messages/checks.hpp"

namespace adit {
namespace {

constexpr std::size_t kEventsPerProgress = 10'000;

/// A log that says it stopped for longer is another log: timers need not make up for that.
constexpr std::int64_t kGapMaxUs = 24LL * 3600 * 1'000'000;

bool is_of_its_time(std::int64_t utime, const MemoryBus& bus) {
  if (!is_plausible_utime(utime)) return false;
  return bus.now_utime() == 0 || utime - bus.now_utime() < kGapMaxUs;
}

}  // namespace

void play_logs(const std::vector<std::filesystem::path>& logs,
               const std::set<std::string, std::less<>>& wanted, MemoryBus& bus,
               const std::function<void(double)>& progress) {
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const MappedFile file(logs[i]);
    LogParser parser(file.bytes());
    std::size_t events = 0;
    while (const auto event = parser.next()) {
      if (wanted.contains(event->channel) && is_of_its_time(event->utime, bus)) {
        bus.inject(event->utime, event->channel, event->data);
      }
      if (++events % kEventsPerProgress != 0) continue;
      const double share =
          static_cast<double>(parser.position()) / static_cast<double>(file.bytes().size());
      progress((static_cast<double>(i) + share) / static_cast<double>(logs.size()));
    }
  }
}

}  // namespace adit
