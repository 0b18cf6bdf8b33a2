// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

struct ZSTD_CCtx_s;
struct ZSTD_DCtx_s;

namespace adit {

/// Whether bytes begin as a file that is compressed with zstd (RFC 8878).
bool is_zstd(std::span<const std::uint8_t> bytes);

/// Content as one frame, which states its size.
std::string zstd_frame(std::string_view content);

/// Decompresses zstd (RFC 8878) of any number of frames, part by part. After damage it continues
/// with the next frame; of a frame that is damaged or incomplete it returns what precedes that.
class ZstdDecoder {
 public:
  /// What could not be decompressed, in bytes of the compressed file.
  struct Damage {
    std::size_t corrupt_bytes = 0;    ///< skipped, in all corrupt regions
    std::size_t corrupt_regions = 0;  ///< also a frame whose checksum is wrong
    std::size_t truncated_bytes = 0;  ///< of an incomplete block at the end
  };

  /// `compressed` must outlive this.
  explicit ZstdDecoder(std::span<const std::uint8_t> compressed);
  ~ZstdDecoder();
  ZstdDecoder(const ZstdDecoder&) = delete;
  ZstdDecoder& operator=(const ZstdDecoder&) = delete;

  /// Appends the next part of the content; false at the end.
  bool read(std::vector<std::uint8_t>& content);

  /// Compressed bytes read so far.
  [[nodiscard]] std::size_t position() const { return position_; }
  /// Final after `read` has returned false.
  [[nodiscard]] const Damage& damage() const { return damage_; }

 private:
  struct Free {
    void operator()(ZSTD_DCtx_s* context) const;
  };

  void skip_to_next_frame();

  std::span<const std::uint8_t> compressed_;
  std::unique_ptr<ZSTD_DCtx_s, Free> context_;
  std::size_t position_ = 0;
  std::size_t wanted_ = 0;  ///< bytes up to the header behind the next block; 0 before a frame
  std::size_t frame_begin_ = 0;
  std::size_t intact_end_ = 0;  ///< behind the last block that was decompressed
  Damage damage_;
};

/// Compresses with zstd in frames that can be decompressed each alone, so that damage costs one.
/// The same bytes in the same portions give the same result.
class ZstdEncoder {
 public:
  ZstdEncoder();
  ~ZstdEncoder();
  ZstdEncoder(const ZstdEncoder&) = delete;
  ZstdEncoder& operator=(const ZstdEncoder&) = delete;

  /// Compresses a portion. What has been returned so far can be decompressed up to its end.
  std::string add(std::string_view portion);

  /// The end of the frame, if one has begun.
  std::string end_frame();

  /// Begins a new frame without the end of the last one, which was not written completely.
  void restart();

 private:
  struct Free {
    void operator()(ZSTD_CCtx_s* context) const;
  };

  std::string compress(std::string_view portion, bool last);

  std::unique_ptr<ZSTD_CCtx_s, Free> context_;
  std::size_t frame_bytes_ = 0;  ///< content of the frame that has begun
};

}  // namespace adit
