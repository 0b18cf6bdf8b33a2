// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/log/event_source.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace adit {
namespace {

constexpr std::size_t kReleasedBytes = std::size_t{16} << 20U;

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

std::optional<LogEventView> LogReader::next() {
  const auto event = parser_.next();
  if (event) release_before(*event);
  return event;
}

double LogReader::fraction_read() const {
  if (empty()) return 1.0;
  return static_cast<double>(parser_.position()) / static_cast<double>(file_.bytes().size());
}

void LogReader::release_before(const LogEventView& event) {
  const auto* const at = reinterpret_cast<const std::uint8_t*>(event.channel.data());
  const auto offset = static_cast<std::size_t>(at - file_.bytes().data());
  if (offset < released_) released_ = 0;  // read from the start again
  if (offset < released_ + kReleasedBytes) return;
  file_.release(released_, offset);
  released_ = offset;
}

LogFile::LogFile(const std::filesystem::path& path, const TimeOf& time_of) : reader_(path) {
  while (auto event = reader_.next()) {
    if (time_of) event->utime = time_of(*event);
    events_.push_back(*event);
  }
  if (events_.empty() && !reader_.empty()) {
    throw std::runtime_error(path.string() + ": not an LCM log");
  }
  sort_by_time(events_);
}

std::optional<LogEventView> LogFile::next() {
  if (next_ == events_.size()) return std::nullopt;
  reader_.release_before(events_[next_]);
  return events_[next_++];
}

}  // namespace adit
