// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/gzip_encoder.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <utility>

#include <zlib.h>

namespace adit {
namespace {

constexpr std::size_t kBufferBytes = 1U << 16U;
constexpr int kGzipWindow = 15 + 16;  // the largest window, with a header of gzip
constexpr int kMemoryLevel = 9;

}  // namespace

GzipEncoder::GzipEncoder() : stream_(std::make_unique<z_stream_s>()) {
  const int result = deflateInit2(stream_.get(), Z_BEST_COMPRESSION, Z_DEFLATED, kGzipWindow,
                                  kMemoryLevel, Z_DEFAULT_STRATEGY);
  if (result != Z_OK) throw std::bad_alloc();  // the parameters are constant
}

GzipEncoder::~GzipEncoder() { deflateEnd(stream_.get()); }

void GzipEncoder::add(std::string_view bytes) {
  constexpr std::size_t kPartMax = std::numeric_limits<std::uint32_t>::max() / 2;
  while (!bytes.empty()) {
    const std::string_view part = bytes.substr(0, kPartMax);
    deflate_all(part, false);
    bytes.remove_prefix(part.size());
  }
}

std::string GzipEncoder::finish() {
  deflate_all({}, true);
  return std::move(compressed_);
}

void GzipEncoder::deflate_all(std::string_view bytes, bool is_last) {
  std::array<std::uint8_t, kBufferBytes> buffer;
  // zlib does not write to its input.
  stream_->next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream_->avail_in = static_cast<uInt>(bytes.size());
  do {
    stream_->next_out = buffer.data();
    stream_->avail_out = static_cast<uInt>(buffer.size());
    deflate(stream_.get(), is_last ? Z_FINISH : Z_NO_FLUSH);
    const std::size_t written = buffer.size() - stream_->avail_out;
    compressed_.append(reinterpret_cast<const char*>(buffer.data()), written);
  } while (stream_->avail_out == 0);
}

}  // namespace adit
