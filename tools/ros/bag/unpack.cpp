// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ros/bag/unpack.hpp"

#include <algorithm>
#include <limits>

#include <bzlib.h>
#include <lz4frame.h>

#include "common/files/zstd_stream.hpp"

namespace adit {
namespace {

constexpr std::size_t kPartBytes = std::size_t{1} << 18U;

/// Output that grows with the content.
class Output {
 public:
  explicit Output(std::size_t size) : size_(size) {}

  /// Room for the next part; empty when there is all that the content may have.
  std::span<std::uint8_t> room() {
    bytes_.resize(std::min(size_, used_ + kPartBytes));
    return std::span(bytes_).subspan(used_);
  }
  void use(std::size_t bytes) { used_ += bytes; }

  Unpacked take(bool intact) {
    bytes_.resize(used_);
    return {std::move(bytes_), intact && used_ == size_};
  }

 private:
  std::size_t size_;
  std::size_t used_ = 0;
  std::vector<std::uint8_t> bytes_;
};

Unpacked unpack_bz2(std::span<const std::uint8_t> packed, std::size_t size) {
  Output output(size);
  bz_stream stream{};
  if (packed.size() > std::numeric_limits<unsigned>::max() ||
      BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) {
    return output.take(false);
  }
  // The library does not write to its input.
  stream.next_in = const_cast<char*>(reinterpret_cast<const char*>(packed.data()));
  stream.avail_in = static_cast<unsigned>(packed.size());
  int code = BZ_OK;
  while (code == BZ_OK) {
    const auto room = output.room();
    stream.next_out = reinterpret_cast<char*>(room.data());
    stream.avail_out = static_cast<unsigned>(room.size());
    const unsigned input = stream.avail_in;
    code = BZ2_bzDecompress(&stream);
    const std::size_t written = room.size() - stream.avail_out;
    output.use(written);
    if (written == 0 && stream.avail_in == input) break;  // truncated, or too long
  }
  BZ2_bzDecompressEnd(&stream);
  return output.take(code == BZ_STREAM_END);
}

Unpacked unpack_lz4(std::span<const std::uint8_t> packed, std::size_t size) {
  Output output(size);
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0U)
    return output.take(false);
  std::size_t code = 1;  // 0 at the end of the frame
  while (code != 0 && LZ4F_isError(code) == 0U) {
    const auto room = output.room();
    std::size_t written = room.size();
    std::size_t consumed = packed.size();
    code = LZ4F_decompress(context, room.data(), &written, packed.data(), &consumed, nullptr);
    output.use(written);
    packed = packed.subspan(consumed);
    if (written == 0 && consumed == 0) break;
  }
  LZ4F_freeDecompressionContext(context);
  return output.take(code == 0);
}

Unpacked unpack_zstd(std::span<const std::uint8_t> packed, std::size_t size) {
  ZstdDecoder decoder(packed);
  std::vector<std::uint8_t> bytes;
  while (bytes.size() <= size && decoder.read(bytes)) {
    if (decoder.damage().corrupt_regions > 0) break;
  }
  const ZstdDecoder::Damage& damage = decoder.damage();
  const bool intact = damage.corrupt_regions == 0 && damage.truncated_bytes == 0;
  const bool whole = intact && bytes.size() == size;
  bytes.resize(std::min(bytes.size(), size));
  return {std::move(bytes), whole};
}

}  // namespace

std::optional<Compression> compression_of(std::string_view name) {
  if (name.empty() || name == "none") return Compression::kNone;
  if (name == "bz2") return Compression::kBz2;
  if (name == "lz4") return Compression::kLz4;
  if (name == "zstd") return Compression::kZstd;
  return std::nullopt;
}

Unpacked unpack(Compression compression, std::span<const std::uint8_t> packed, std::size_t size) {
  if (compression == Compression::kBz2) return unpack_bz2(packed, size);
  if (compression == Compression::kLz4) return unpack_lz4(packed, size);
  if (compression == Compression::kZstd) return unpack_zstd(packed, size);
  const auto content = packed.first(std::min(size, packed.size()));
  return {{content.begin(), content.end()}, packed.size() == size};
}

}  // namespace adit
