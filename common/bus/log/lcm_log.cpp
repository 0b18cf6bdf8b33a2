// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/log/lcm_log.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "common/files/file_error.hpp"

namespace adit {

LogHealth& LogHealth::operator+=(const LogHealth& part) {
  events += part.events;
  corrupt_bytes += part.corrupt_bytes;
  corrupt_regions += part.corrupt_regions;
  truncated_bytes += part.truncated_bytes;
  unreadable_bytes += part.unreadable_bytes;
  return *this;
}

std::vector<std::string> damage_warnings(const LogHealth& health, const std::string& file) {
  std::vector<std::string> warnings;
  if (health.corrupt_bytes > 0)
    warnings.push_back(fmt::format("skipped {} corrupt bytes of {}", health.corrupt_bytes, file));
  if (health.unreadable_bytes > 0)
    warnings.push_back(
        fmt::format("the disk cannot read {} bytes of {}", health.unreadable_bytes, file));
  if (health.truncated_bytes > 0) warnings.push_back(file + " is truncated within an event");
  return warnings;
}

namespace {

using log_format::kHeaderBytes;

constexpr std::array<std::uint8_t, 4> kSyncBytes{0xED, 0xA1, 0xDA, 0x01};

std::uint64_t big_endian(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes) value = value << 8U | byte;
  return value;
}

bool is_printable(std::span<const std::uint8_t> channel) {
  return std::all_of(channel.begin(), channel.end(), [](auto c) { return c > 0x20 && c < 0x7F; });
}

bool is_sync(std::span<const std::uint8_t> bytes) {
  return std::equal(kSyncBytes.begin(), kSyncBytes.end(), bytes.begin());
}

}  // namespace

struct LogParser::Extent {
  LogEventView event;
  std::size_t end;  ///< beyond the end of the bytes if the event is incomplete
};

/// The event at this offset if its header is valid, complete or not.
std::optional<LogParser::Extent> LogParser::event_at(std::size_t at) const {
  if (bytes_.size() - at < kHeaderBytes) return std::nullopt;
  const auto header = bytes_.subspan(at, kHeaderBytes);
  const std::uint64_t channel_length = big_endian(header.subspan(20, 4));
  const std::uint64_t data_length = big_endian(header.subspan(24, 4));
  const bool valid = channel_length >= 1 && channel_length <= log_format::kChannelLengthMax &&
                     data_length <= INT32_MAX;
  if (!is_sync(header) || !valid) return std::nullopt;

  const std::size_t data_at = at + kHeaderBytes + channel_length;
  const std::size_t end = data_at + data_length;
  const auto utime = static_cast<std::int64_t>(big_endian(header.subspan(12, 8)));
  if (end > bytes_.size()) return Extent{{utime, {}, {}}, end};

  const auto channel = bytes_.subspan(at + kHeaderBytes, channel_length);
  if (!is_printable(channel)) return std::nullopt;
  const std::string_view name(reinterpret_cast<const char*>(channel.data()), channel.size());
  return Extent{{utime, name, bytes_.subspan(data_at, data_length)}, end};
}

/// True if an event may end here: at the end of the file, or at the sync word of the next event.
bool LogParser::is_followed_by_event(std::size_t end) const {
  const std::size_t left = bytes_.size() - end;
  return left < kSyncBytes.size() || is_sync(bytes_.subspan(end));
}

/// Offset in [from, to) of a complete event that is followed by another; `to` if there is none.
std::size_t LogParser::find_event(std::size_t from, std::size_t to) const {
  const auto end = bytes_.begin() + static_cast<std::ptrdiff_t>(to);
  auto at = bytes_.begin() + static_cast<std::ptrdiff_t>(from);
  while (true) {
    at = std::search(at, end, kSyncBytes.begin(), kSyncBytes.end());
    if (at == end) return to;
    const auto extent = event_at(static_cast<std::size_t>(at - bytes_.begin()));
    if (extent && extent->end <= bytes_.size() && is_followed_by_event(extent->end)) break;
    ++at;
  }
  return static_cast<std::size_t>(at - bytes_.begin());
}

/// An event must be complete, and a corrupt region end in one, to be told from what they are not.
bool LogParser::depends_on_more() const {
  const auto known = [&](const Extent& extent) {
    return extent.end + kSyncBytes.size() <= bytes_.size();
  };
  if (bytes_.size() - position_ < kHeaderBytes) return true;
  const auto extent = event_at(position_);
  if (extent) return !known(*extent);
  const std::size_t found = find_event(position_ + 1, bytes_.size());
  return found == bytes_.size() || !known(*event_at(found));
}

void LogParser::skip_to(std::size_t at) {
  health_.corrupt_bytes += at - position_;
  ++health_.corrupt_regions;
  position_ = at;
}

std::optional<LogEventView> LogParser::next() {
  while (position_ < bytes_.size()) {
    if (end_ == End::kOfPart && depends_on_more()) return std::nullopt;
    const auto extent = event_at(position_);
    const bool complete = extent && extent->end <= bytes_.size();
    if (complete && is_followed_by_event(extent->end)) {
      position_ = extent->end;
      ++health_.events;
      return extent->event;
    }
    const std::size_t search_end = complete ? extent->end : bytes_.size();
    const std::size_t found = find_event(position_ + 1, search_end);
    if (found < search_end) {
      skip_to(found);
    } else if (complete) {
      position_ = extent->end;
      ++health_.events;
      return extent->event;
    } else if (extent || bytes_.size() - position_ < kHeaderBytes) {
      health_.truncated_bytes = bytes_.size() - position_;
      position_ = bytes_.size();
    } else {
      skip_to(bytes_.size());
    }
  }
  return std::nullopt;
}

namespace {

// A killed process loses so much. Smaller portions compress worse.
constexpr std::size_t kBufferBytes = std::size_t{1} << 13;
constexpr std::size_t kCompressedBufferBytes = std::size_t{1} << 16;

void append_big_endian(std::uint64_t value, int bytes, std::string& header) {
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) {
    header.push_back(static_cast<char>(value >> static_cast<unsigned>(shift)));
  }
}

std::string header_of(const LogEventView& event, std::int64_t number) {
  std::string header;
  header.reserve(log_format::kHeaderBytes);
  append_big_endian(log_format::kSync, 4, header);
  append_big_endian(static_cast<std::uint64_t>(number), 8, header);
  append_big_endian(static_cast<std::uint64_t>(event.utime), 8, header);
  append_big_endian(event.channel.size(), 4, header);
  append_big_endian(event.data.size(), 4, header);
  return header;
}

}  // namespace

LogWriter::LogWriter(const std::filesystem::path& path, Name name)
    : new_file_(name == Name::kWhenClosed ? std::make_optional<NewFile>(path) : std::nullopt),
      file_(new_file_ ? new_file_->part() : path, path) {
  if (path.extension() == kCompressedExtension) encoder_.emplace();
}

LogWriter::~LogWriter() {
  try {
    flush();
    if (encoder_) file_.write(encoder_->end_frame());
  } catch (const FileError&) {  // NOLINT(bugprone-empty-catch): see close()
  }
}

void LogWriter::write(const LogEventView& event) {
  buffer_ += header_of(event, events_);
  buffer_ += event.channel;
  buffer_.append(reinterpret_cast<const char*>(event.data.data()), event.data.size());
  ++events_;
  if (buffer_.size() >= (encoder_ ? kCompressedBufferBytes : kBufferBytes)) flush();
}

/// What cannot be written is dropped, so that a later event does not follow a part of one.
void LogWriter::flush() {
  const std::string events = std::exchange(buffer_, {});
  if (!encoder_) return file_.write(events);
  const std::string compressed = events.empty() ? std::string() : encoder_->add(events);
  try {
    file_.write(compressed);
  } catch (const FileError&) {
    encoder_->restart();
    throw;
  }
}

void LogWriter::close() {
  flush();
  if (encoder_) file_.write(encoder_->end_frame());
  file_.close();
  if (new_file_) new_file_->publish();
}

std::filesystem::path compressed_name(std::filesystem::path log) {
  if (log.extension() != LogWriter::kCompressedExtension) log += LogWriter::kCompressedExtension;
  return log;
}

std::filesystem::path plain_or_compressed(const std::filesystem::path& log) {
  return !exists(log) && exists(compressed_name(log)) ? compressed_name(log) : log;
}

}  // namespace adit
