// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/carmen/gzip_line_reader.hpp"

#include <span>
#include <utility>

namespace adit {
namespace {

constexpr std::size_t kChunkBytes = 1 << 16;
constexpr std::size_t kLineBytesMax = 1 << 20;  // 361 beams take about 2 kB

constexpr std::string_view kTooLong = "line longer than 1 MiB";

}  // namespace

GzipLineReader::GzipLineReader(const std::filesystem::path& path) : file_(path) {}

std::optional<GzipLineReader::Line> GzipLineReader::next() {
  std::size_t searched = start_;
  while (true) {
    const std::size_t end = buffer_.find('\n', searched);
    if (end != std::string::npos) return take(end - start_, 1);
    if (buffer_.size() - start_ > kLineBytesMax) {
      too_long_ = true;
      start_ = buffer_.size();
    }
    searched = buffer_.size() - start_;
    if (!fill()) break;
  }
  if (too_long_ || start_ < buffer_.size()) return take(buffer_.size() - start_, 0);
  return std::nullopt;
}

/// Removes consumed lines from the buffer and appends a chunk; false at the end of the file.
bool GzipLineReader::fill() {
  if (ended_) return false;
  buffer_.erase(0, std::exchange(start_, 0));
  const std::size_t old_size = buffer_.size();
  buffer_.resize(old_size + kChunkBytes);
  const std::size_t got = file_.read(std::span(buffer_).subspan(old_size));
  buffer_.resize(old_size + got);
  ended_ = got == 0;
  return !ended_;
}

GzipLineReader::Line GzipLineReader::take(std::size_t length, std::size_t separator) {
  const std::string_view text = std::string_view(buffer_).substr(start_, length);
  start_ += length + separator;
  if (std::exchange(too_long_, false)) return {{}, kTooLong};
  return {text, {}};
}

}  // namespace adit
