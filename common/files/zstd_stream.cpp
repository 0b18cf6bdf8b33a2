// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/zstd_stream.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <stdexcept>

#include <zstd.h>

namespace adit {
namespace {

constexpr std::array<std::uint8_t, 4> kMagic{0x28, 0xB5, 0x2F, 0xFD};
constexpr std::size_t kFrameBytes = std::size_t{4} << 20;  // damage costs so much at most
// Of the log of a mission 6 % less than the default of zstd, in twice its time: 12 ms for a MB.
constexpr int kLevel = 5;
constexpr std::size_t kBlockHeaderBytes = 3;
constexpr std::size_t kFrameBeginBytes = 5;  // magic number and the byte that says what follows

}  // namespace

bool is_zstd(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), bytes.begin());
}

std::string zstd_frame(std::string_view content) {
  std::string frame(ZSTD_compressBound(content.size()), '\0');
  const std::size_t size = ZSTD_compress(frame.data(), frame.size(), content.data(), content.size(),
                                         ZSTD_CLEVEL_DEFAULT);
  if (ZSTD_isError(size) != 0) throw std::runtime_error(ZSTD_getErrorName(size));
  frame.resize(size);
  return frame;
}

void ZstdDecoder::Free::operator()(ZSTD_DCtx_s* context) const { ZSTD_freeDCtx(context); }

ZstdDecoder::ZstdDecoder(std::span<const std::uint8_t> compressed)
    : compressed_(compressed), context_(ZSTD_createDCtx()) {
  if (!context_) throw std::bad_alloc();
}

ZstdDecoder::~ZstdDecoder() = default;

/// Reads block by block, without the header of the next one that zstd wants with each, so that an
/// error costs no block before it.
bool ZstdDecoder::read(std::vector<std::uint8_t>& content) {
  const std::size_t before = content.size();
  content.resize(before + ZSTD_DStreamOutSize());
  ZSTD_outBuffer out{content.data() + before, ZSTD_DStreamOutSize(), 0};
  while (out.pos == 0 && position_ < compressed_.size()) {
    if (wanted_ == 0) frame_begin_ = position_;
    const std::size_t size = wanted_ == 0                  ? kFrameBeginBytes
                             : wanted_ > kBlockHeaderBytes ? wanted_ - kBlockHeaderBytes
                                                           : wanted_;
    ZSTD_inBuffer in{compressed_.data() + position_, std::min(size, compressed_.size() - position_),
                     0};
    const std::size_t wanted = ZSTD_decompressStream(context_.get(), &out, &in);
    if (ZSTD_isError(wanted) != 0) {
      skip_to_next_frame();
      continue;
    }
    position_ += in.pos;
    wanted_ = wanted;
    if (out.pos > 0 || wanted == 0) intact_end_ = position_;
  }
  content.resize(before + out.pos);
  if (out.pos > 0) return true;
  if (wanted_ > kBlockHeaderBytes) damage_.truncated_bytes = compressed_.size() - intact_end_;
  return false;
}

/// The damage is behind the last block that was decompressed, where a frame may follow one without
/// end. What pretends to be a frame within the damage fails in turn.
void ZstdDecoder::skip_to_next_frame() {
  const auto from = compressed_.begin() + static_cast<std::ptrdiff_t>(intact_end_);
  const std::ptrdiff_t failed = intact_end_ == frame_begin_ ? 1 : 0;
  const auto next = std::search(from + failed, compressed_.end(), kMagic.begin(), kMagic.end());
  ++damage_.corrupt_regions;
  damage_.corrupt_bytes += static_cast<std::size_t>(next - from);
  position_ = intact_end_ = static_cast<std::size_t>(next - compressed_.begin());
  wanted_ = 0;
  ZSTD_DCtx_reset(context_.get(), ZSTD_reset_session_only);
}

void ZstdEncoder::Free::operator()(ZSTD_CCtx_s* context) const { ZSTD_freeCCtx(context); }

ZstdEncoder::ZstdEncoder() : context_(ZSTD_createCCtx()) {
  if (!context_) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_checksumFlag, 1);
  ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_compressionLevel, kLevel);
}

ZstdEncoder::~ZstdEncoder() = default;

std::string ZstdEncoder::add(std::string_view portion) {
  frame_bytes_ += portion.size();
  const bool last = frame_bytes_ >= kFrameBytes;
  if (last) frame_bytes_ = 0;
  return compress(portion, last);
}

std::string ZstdEncoder::end_frame() {
  if (frame_bytes_ == 0) return {};
  frame_bytes_ = 0;
  return compress({}, true);
}

void ZstdEncoder::restart() {
  frame_bytes_ = 0;
  ZSTD_CCtx_reset(context_.get(), ZSTD_reset_session_only);
}

std::string ZstdEncoder::compress(std::string_view portion, bool last) {
  std::string compressed;
  ZSTD_inBuffer in{portion.data(), portion.size(), 0};
  std::size_t left = 1;
  while (left != 0) {
    const std::size_t before = compressed.size();
    compressed.resize(before + ZSTD_CStreamOutSize());
    ZSTD_outBuffer out{compressed.data() + before, ZSTD_CStreamOutSize(), 0};
    left = ZSTD_compressStream2(context_.get(), &out, &in, last ? ZSTD_e_end : ZSTD_e_flush);
    if (ZSTD_isError(left) != 0) throw std::runtime_error(ZSTD_getErrorName(left));
    compressed.resize(before + out.pos);
  }
  return compressed;
}

}  // namespace adit
