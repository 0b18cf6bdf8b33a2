// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/carmen/gzip_line_reader.hpp"

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <zlib.h>

namespace adit {
namespace {

constexpr std::size_t kChunkBytes = 1 << 16;
constexpr std::size_t kLineBytesMax = 1 << 20;  // 361 beams take about 2 kB

constexpr std::string_view kDamaged = "compressed file damaged from this line on";
constexpr std::string_view kTooLong = "line longer than 1 MiB";

}  // namespace

void GzipLineReader::Close::operator()(gzFile_s* file) const { gzclose(file); }

GzipLineReader::GzipLineReader(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) file_.reset(gzopen(path.c_str(), "rb"));
  if (!file_) throw std::runtime_error(fmt::format("cannot read {}", path.string()));
  size_bytes_ = static_cast<double>(std::filesystem::file_size(path, error));
}

GzipLineReader::~GzipLineReader() = default;
GzipLineReader::GzipLineReader(GzipLineReader&&) noexcept = default;
GzipLineReader& GzipLineReader::operator=(GzipLineReader&&) noexcept = default;

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
  if (std::exchange(damaged_, false)) return Line{{}, kDamaged};
  return std::nullopt;
}

double GzipLineReader::fraction_read() const {
  const auto offset = static_cast<double>(gzoffset(file_.get()));
  return size_bytes_ > 0.0 ? std::clamp(offset / size_bytes_, 0.0, 1.0) : 1.0;
}

/// Removes consumed lines from the buffer and appends a chunk; false at the end of the file.
bool GzipLineReader::fill() {
  if (ended_) return false;
  buffer_.erase(0, std::exchange(start_, 0));
  const std::size_t old_size = buffer_.size();
  buffer_.resize(old_size + kChunkBytes);
  const int got = gzread(file_.get(), buffer_.data() + old_size, kChunkBytes);
  buffer_.resize(old_size + static_cast<std::size_t>(std::max(got, 0)));
  int code = Z_OK;
  gzerror(file_.get(), &code);
  damaged_ = got < 0 || code == Z_BUF_ERROR;
  ended_ = got <= 0;
  return !ended_;
}

GzipLineReader::Line GzipLineReader::take(std::size_t length, std::size_t separator) {
  const std::string_view text = std::string_view(buffer_).substr(start_, length);
  start_ += length + separator;
  if (std::exchange(too_long_, false)) return {{}, kTooLong};
  return {text, {}};
}

}  // namespace adit
