// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/management/stop_sequence.hpp"

#include <algorithm>

namespace adit {

void StopSequence::add(const ListedCommand& command, bool and_start, std::int64_t now_us) {
  remove(command.id);
  entries_.push_back({{command.id, and_start}, command.depends_on, now_us, false});
}

void StopSequence::remove(const std::string& id) {
  std::erase_if(entries_, [&](const Entry& entry) { return entry.stop.id == id; });
}

bool StopSequence::is_pending(const std::string& id) const {
  return std::ranges::any_of(
      entries_, [&](const Entry& entry) { return entry.stop.id == id && !entry.issued; });
}

std::vector<StopSequence::Stop> StopSequence::take_due(
    std::int64_t now_us, const std::function<bool(const std::string&)>& is_ending) {
  std::erase_if(entries_,
                [&](const Entry& entry) { return entry.issued && !is_ending(entry.stop.id); });
  std::vector<Entry*> due;
  for (Entry& entry : entries_) {
    const bool within_timeout = now_us - entry.since_us < kTimeoutUs;
    if (!entry.issued && (!within_timeout || !has_dependents(entry.stop.id))) due.push_back(&entry);
  }
  std::vector<Stop> stops;
  for (Entry* const entry : due) {
    entry->issued = true;
    stops.push_back(entry->stop);
  }
  return stops;
}

bool StopSequence::has_dependents(const std::string& id) const {
  return std::ranges::any_of(entries_, [&](const Entry& entry) {
    return std::ranges::find(entry.depends_on, id) != entry.depends_on.end();
  });
}

}  // namespace adit
