// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/log/event_source.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include "common/files/output_file.hpp"
#include "common/files/temporary_file.hpp"
#include "common/messages/fields/quantities.hpp"

namespace adit {
namespace {

constexpr std::size_t kReleasedBytes = std::size_t{16} << 20U;
constexpr std::size_t kWindowBytes = std::size_t{1} << 20U;
// An event that would be longer is a corrupt one in a compressed log.
constexpr std::size_t kEventBytesMax = std::size_t{64} << 20U;

template <class Event>
void sort_by_time(std::vector<Event>& events) {
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.utime < b.utime; });
}

/// Drops the resident pages of a file before an offset, now and then.
void release(const MappedFile& file, std::size_t before, std::size_t& released) {
  if (before < released) released = 0;  // read from the start again
  if (before < released + kReleasedBytes) return;
  file.release(released, before);
  released = before;
}

/// The damage of the compression.
LogHealth health_of(const ZstdDecoder::Damage& damage) {
  return {0, damage.corrupt_bytes, damage.corrupt_regions, damage.truncated_bytes};
}

/// Whether the disk can read an event of a file; one that it cannot read becomes a corrupt region.
bool is_readable(const LogEventView& event, const MappedFile& file, LogHealth& health) {
  const auto* const begin = reinterpret_cast<const std::uint8_t*>(event.channel.data());
  const auto bytes = static_cast<std::size_t>(event.data.data() + event.data.size() - begin);
  if (file.is_readable({begin, bytes})) return true;
  --health.events;
  ++health.corrupt_regions;
  health.corrupt_bytes += log_format::kHeaderBytes + bytes;
  return false;
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

LogBytes::LogBytes(const std::filesystem::path& path) : file_(path) {
  if (!is_zstd(file_.bytes())) return;
  const TemporaryFile temporary(path.parent_path());
  OutputFile output(temporary.path(), path.string() + ", unpacked");
  ZstdDecoder decoder(file_.bytes());
  std::vector<std::uint8_t> part;
  while (decoder.read(part)) {
    output.write({reinterpret_cast<const char*>(part.data()), part.size()});
    part.clear();
    release(file_, decoder.position(), released_);
  }
  output.close();
  damage_ = decoder.damage();
  released_ = 0;
  unpacked_.emplace(temporary.path());
}

void LogBytes::release_before(const void* byte) {
  const auto offset = static_cast<const std::uint8_t*>(byte) - bytes().data();
  release(plain(), static_cast<std::size_t>(offset), released_);
}

LogReader::LogReader(const std::filesystem::path& path) : file_(path), parser_(file_.bytes()) {
  if (!is_zstd(file_.bytes())) return;
  decoder_.emplace(file_.bytes());
  parser_ = LogParser({});
  unpacked_ = false;
}

std::optional<LogEventView> LogReader::next() {
  const std::size_t event_begin = parser_.position();
  auto event = parser_.next();
  while (!event && !unpacked_) {
    unpack_more();
    event = parser_.next();
  }
  while (event && !decoder_ && !is_readable(*event, file_, before_)) event = parser_.next();
  release(file_, decoder_ ? decoder_->position() : event_begin, released_);
  return event;
}

/// Moves the window on. It keeps what the parser cannot decide yet, and then at least doubles, so
/// that a long event is not parsed again and again.
void LogReader::unpack_more() {
  before_ += parser_.health();
  window_.erase(window_.begin(), window_.begin() + static_cast<std::ptrdiff_t>(parser_.position()));
  const std::size_t size = std::max(kWindowBytes, 2 * window_.size());
  while (window_.size() < size && !unpacked_) unpacked_ = !decoder_->read(window_);
  const bool decide_all = unpacked_ || window_.size() > kEventBytesMax;
  parser_ = LogParser(window_, decide_all ? LogParser::End::kOfLog : LogParser::End::kOfPart);
}

LogHealth LogReader::health() const {
  LogHealth health = before_;
  health += parser_.health();
  if (decoder_) health += health_of(decoder_->damage());
  health.unreadable_bytes = file_.unreadable_bytes();
  return health;
}

double LogReader::fraction_read() const {
  if (empty()) return 1.0;
  const std::size_t read = decoder_ ? decoder_->position() : parser_.position();
  return static_cast<double>(read) / static_cast<double>(file_.bytes().size());
}

LogFile::LogFile(const std::filesystem::path& path, const TimeOf& time_of) : bytes_(path) {
  LogParser parser(bytes_.bytes());
  while (auto event = parser.next()) {
    bytes_.release_before(event->channel.data());
    if (!is_readable(*event, bytes_.plain(), health_)) continue;
    if (time_of) event->utime = time_of(*event);
    events_.push_back(*event);
  }
  health_ += parser.health();
  health_ += health_of(bytes_.damage());
  health_.unreadable_bytes = bytes_.unreadable_bytes();
  if (events_.empty() && !bytes_.bytes().empty()) {
    bytes_.plain().require_readable();
    throw std::runtime_error(path.string() + ": not an LCM log");
  }
  sort_by_time(events_);
}

std::optional<LogEventView> LogFile::next() {
  if (next_ == events_.size()) return std::nullopt;
  bytes_.release_before(events_[next_].channel.data());
  return events_[next_++];
}

bool is_playable_after(std::int64_t utime, std::int64_t before_utime) {
  constexpr std::int64_t kDayUs = 24LL * 3600 * 1'000'000;
  if (!is_plausible_utime(utime)) return false;
  return before_utime == 0 || utime - before_utime < kDayUs;
}

namespace {

/// The time of the first event with a plausible one; the largest number without any.
std::int64_t begin_utime(const std::filesystem::path& log) {
  LogReader reader(log);
  while (const auto event = reader.next()) {
    if (is_plausible_utime(event->utime)) return event->utime;
  }
  return std::numeric_limits<std::int64_t>::max();
}

}  // namespace

std::vector<std::filesystem::path> in_order_of_time(std::vector<std::filesystem::path> logs) {
  if (logs.size() < 2) return logs;
  std::vector<std::pair<std::int64_t, std::filesystem::path>> by_time;
  for (std::filesystem::path& log : logs) {
    const std::int64_t begin = begin_utime(log);
    by_time.emplace_back(begin, std::move(log));
  }
  std::stable_sort(by_time.begin(), by_time.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < logs.size(); ++i) logs[i] = std::move(by_time[i].second);
  return logs;
}

}  // namespace adit
