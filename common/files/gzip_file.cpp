// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/gzip_file.hpp"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>
#include <zlib.h>

#include "common/files/file_error.hpp"

namespace adit {
namespace {

constexpr std::size_t kInputBytes = std::size_t{1} << 16;
constexpr int kGzipOnly = 15 + 16;  // window bits of inflateInit2()

bool is_gzip(std::span<const char> bytes) {
  return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b';
}

}  // namespace

void GzipFile::End::operator()(z_stream_s* stream) const {
  inflateEnd(stream);
  delete stream;
}

GzipFile::GzipFile(const std::filesystem::path& path) : path_(path) {
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) file_.open(path, std::ios::binary);
  if (!file_.is_open()) throw FileError("cannot read " + path.string());
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (!error) size_bytes_ = bytes;
  fill();
  if (!is_gzip(input_)) return;
  stream_.reset(new z_stream_s{});
  if (inflateInit2(stream_.get(), kGzipOnly) != Z_OK) throw std::bad_alloc();
  in_member_ = true;
}

GzipFile::~GzipFile() = default;
GzipFile::GzipFile(GzipFile&&) noexcept = default;
GzipFile& GzipFile::operator=(GzipFile&&) noexcept = default;

/// Keeps the input that is not used and appends the next chunk; false at the end of the file.
bool GzipFile::fill() {
  input_.erase(input_.begin(), input_.begin() + static_cast<std::ptrdiff_t>(input_at_));
  input_at_ = 0;
  const std::size_t kept = input_.size();
  input_.resize(kept + kInputBytes);
  file_.read(input_.data() + kept, kInputBytes);
  if (file_.bad()) throw FileError(path_.string() + ": the disk cannot read it to its end");
  const auto got = static_cast<std::size_t>(file_.gcount());
  input_.resize(kept + got);
  bytes_read_ += got;
  return got > 0;
}

std::size_t GzipFile::bytes_used() const { return bytes_read_ - (input_.size() - input_at_); }

double GzipFile::fraction_read() const {
  if (size_bytes_ == 0) return 1.0;
  const double fraction = static_cast<double>(bytes_used()) / static_cast<double>(size_bytes_);
  return std::clamp(fraction, 0.0, 1.0);
}

std::size_t GzipFile::read(std::span<char> out) {
  std::size_t got = 0;
  while (got == 0 && !ended_) {
    if (stream_) {
      got = inflate_into(out);
    } else if (input_at_ < input_.size() || fill()) {
      got = std::min(out.size(), input_.size() - input_at_);
      std::copy_n(input_.begin() + static_cast<std::ptrdiff_t>(input_at_), got, out.begin());
      input_at_ += got;
    } else {
      ended_ = true;
    }
  }
  return got;
}

/// Whether another member follows; zeros after the last one are padding.
bool GzipFile::begin_member() {
  while (input_.size() - input_at_ < 2 && fill()) {
  }
  const auto rest = std::span<const char>(input_).subspan(input_at_);
  in_member_ = is_gzip(rest);
  if (in_member_) {
    inflateReset(stream_.get());
  } else if (std::all_of(rest.begin(), rest.end(), [](char c) { return c == 0; })) {
    input_at_ = input_.size();
    if (fill()) return begin_member();
    ended_ = true;
  } else {
    fail();
  }
  return in_member_;
}

std::size_t GzipFile::inflate_into(std::span<char> out) {
  if (!in_member_ && !begin_member()) return 0;
  if (input_at_ == input_.size() && !fill()) {
    fail();  // the file ends within a member
    return 0;
  }
  stream_->next_in = reinterpret_cast<Bytef*>(input_.data() + input_at_);
  stream_->avail_in = static_cast<uInt>(input_.size() - input_at_);
  stream_->next_out = reinterpret_cast<Bytef*>(out.data());
  stream_->avail_out = static_cast<uInt>(std::min<std::size_t>(out.size(), kInputBytes));
  const std::size_t room = stream_->avail_out;
  const int result = inflate(stream_.get(), Z_NO_FLUSH);
  input_at_ = input_.size() - stream_->avail_in;
  if (result == Z_STREAM_END) {
    in_member_ = false;
  } else if (result != Z_OK && result != Z_BUF_ERROR) {
    fail();
  }
  return room - stream_->avail_out;
}

/// The damage may lie before the place where it shows: the checksum covers a complete member.
void GzipFile::fail() {
  ended_ = true;
  const std::size_t bytes = std::max(size_bytes_, bytes_read_);
  damage_ = fmt::format(
      "the last {} of {} bytes of the compressed file, which is damaged (what was read before them "
      "may be wrong)",
      bytes - bytes_used(), bytes);
}

}  // namespace adit
