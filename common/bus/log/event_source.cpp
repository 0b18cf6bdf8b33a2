// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/log/event_source.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace adit {
namespace {

template <class Event>
void sort_by_time(std::vector<Event>& events) {
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.utime < b.utime; });
}

}  // namespace

EventList::EventList(std::vector<LogEvent> events) : events_(std::move(events)) {
  sort_by_time(events_);
}

std::optional<LogEventView> EventList::next() {
  if (next_ == events_.size()) return std::nullopt;
  const LogEvent& event = events_[next_++];
  return LogEventView{event.utime, event.channel, event.data};
}

LogFile::LogFile(const std::filesystem::path& path) : file_(path) {
  LogParser parser(file_.bytes());
  while (const auto event = parser.next()) events_.push_back(*event);
  health_ = parser.health();
  if (events_.empty() && !file_.bytes().empty()) {
    throw std::runtime_error(path.string() + ": not an LCM log");
  }
  sort_by_time(events_);
}

std::optional<LogEventView> LogFile::next() {
  if (next_ == events_.size()) return std::nullopt;
  return events_[next_++];
}

}  // namespace adit
