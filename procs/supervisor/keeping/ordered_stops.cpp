// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/keeping/ordered_stops.hpp"

#include <algorithm>

namespace adit {

void OrderedStops::add(const ListedCommand& command, bool and_start, std::int64_t now_us) {
  forget(command.id);
  entries_.push_back({{command.id, and_start}, command.depends_on, now_us, false});
}

void OrderedStops::forget(const std::string& id) {
  std::erase_if(entries_, [&](const Entry& entry) { return entry.stop.id == id; });
}

bool OrderedStops::waits(const std::string& id) const {
  return std::ranges::any_of(
      entries_, [&](const Entry& entry) { return entry.stop.id == id && !entry.handed_out; });
}

std::vector<OrderedStops::Stop> OrderedStops::take_due(
    std::int64_t now_us, const std::function<bool(const std::string&)>& is_ending) {
  std::erase_if(entries_,
                [&](const Entry& entry) { return entry.handed_out && !is_ending(entry.stop.id); });
  std::vector<Entry*> due;
  for (Entry& entry : entries_) {
    const bool patient = now_us - entry.since_us < kPatienceUs;
    if (!entry.handed_out && (!patient || !is_needed(entry.stop.id))) due.push_back(&entry);
  }
  std::vector<Stop> stops;
  for (Entry* const entry : due) {
    entry->handed_out = true;
    stops.push_back(entry->stop);
  }
  return stops;
}

bool OrderedStops::is_needed(const std::string& id) const {
  return std::ranges::any_of(entries_, [&](const Entry& entry) {
    return std::ranges::find(entry.depends_on, id) != entry.depends_on.end();
  });
}

}  // namespace adit
