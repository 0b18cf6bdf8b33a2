// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/zstd_stream.hpp"

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <zstd.h>

namespace adit {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kPortion = 50'000;

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Text that compresses to about a third.
std::string content(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::string text;
  while (text.size() < size) text += std::to_string(random() % 1'000'000) + " m, 90 degrees; ";
  text.resize(size);
  return text;
}

struct Decoded {
  std::string content;
  ZstdDecoder::Damage damage;
};

Decoded decode(const std::string& compressed) {
  ZstdDecoder decoder(bytes_of(compressed));
  Bytes content;
  while (decoder.read(content)) {
  }
  return {std::string(content.begin(), content.end()), decoder.damage()};
}

/// Encoder output, with the end of each portion in it.
struct Encoded {
  std::string compressed;
  std::vector<std::size_t> portion_ends;
};

Encoded encode(const std::string& content) {
  ZstdEncoder encoder;
  Encoded encoded;
  for (std::size_t at = 0; at < content.size(); at += kPortion) {
    encoded.compressed += encoder.add(std::string_view(content).substr(at, kPortion));
    encoded.portion_ends.push_back(encoded.compressed.size());
  }
  encoded.compressed += encoder.end_frame();
  return encoded;
}

void expect_intact(const ZstdDecoder::Damage& damage) {
  EXPECT_EQ(damage.corrupt_bytes, 0U);
  EXPECT_EQ(damage.corrupt_regions, 0U);
  EXPECT_EQ(damage.truncated_bytes, 0U);
}

TEST(ZstdStream, ReturnsWhatWasCompressed) {
  const std::string text = content(10'000'000, 1);  // of three frames
  const Encoded encoded = encode(text);
  EXPECT_TRUE(is_zstd(bytes_of(encoded.compressed)));
  EXPECT_LT(encoded.compressed.size(), text.size() / 2);
  const Decoded decoded = decode(encoded.compressed);
  EXPECT_TRUE(decoded.content == text);
  expect_intact(decoded.damage);
}

TEST(ZstdStream, ReadsWhatOtherProgramsCompress) {
  const std::string text = content(3'000'000, 2);
  EXPECT_TRUE(decode(zstd_frame(text)).content == text);
  std::string one(ZSTD_compressBound(text.size()), '\0');
  one.resize(ZSTD_compress(one.data(), one.size(), text.data(), text.size(), 19));
  const Decoded decoded = decode(one + one);
  EXPECT_TRUE(decoded.content == text + text);
  expect_intact(decoded.damage);
}

/// A process that is killed leaves a frame without its end.
TEST(ZstdStream, IsReadableUpToTheLastPortion) {
  const std::string text = content(1'000'000, 3);
  const Encoded encoded = encode(text);
  for (const std::size_t portions : {1U, 7U, 20U}) {
    const Decoded decoded =
        decode(encoded.compressed.substr(0, encoded.portion_ends[portions - 1]));
    EXPECT_TRUE(decoded.content == text.substr(0, portions * kPortion)) << portions;
    expect_intact(decoded.damage);
  }
}

TEST(ZstdStream, SaysWhatATruncatedFileLost) {
  const std::string text = content(1'000'000, 4);
  const Encoded encoded = encode(text);
  const std::size_t cut = encoded.portion_ends[6] - 100;
  const Decoded decoded = decode(encoded.compressed.substr(0, cut));
  EXPECT_GE(decoded.content.size(), 6 * kPortion);
  EXPECT_TRUE(text.starts_with(decoded.content));
  EXPECT_GT(decoded.damage.truncated_bytes, 0U);
  EXPECT_LE(decoded.damage.truncated_bytes, cut - encoded.portion_ends[5]);
}

TEST(ZstdStream, ContinuesBehindADamagedFrame) {
  const std::string text = content(10'000'000, 5);
  Encoded encoded = encode(text);
  const std::size_t at = encoded.portion_ends[3] + 1000;
  for (std::size_t i = 0; i < 200; ++i) encoded.compressed[at + i] = static_cast<char>(i * 37);
  const Decoded decoded = decode(encoded.compressed);
  EXPECT_GE(decoded.damage.corrupt_regions, 1U);
  EXPECT_GT(decoded.damage.corrupt_bytes, 0U);
  EXPECT_EQ(decoded.content.compare(0, 4 * kPortion, text, 0, 4 * kPortion), 0);
  EXPECT_TRUE(decoded.content.ends_with(std::string_view(text).substr(text.size() - 5'000'000)));
}

TEST(ZstdStream, SurvivesAnyBytes) {
  std::mt19937 random(6);
  const Encoded encoded = encode(content(300'000, 6));
  for (int i = 0; i < 300; ++i) {
    std::string damaged = encoded.compressed;
    for (int k = 0; k < 4; ++k) damaged[random() % damaged.size()] = static_cast<char>(random());
    damaged.resize(damaged.size() - random() % 1000);
    const Decoded decoded = decode(damaged);
    EXPECT_LE(decoded.damage.corrupt_bytes + decoded.damage.truncated_bytes, damaged.size());
  }
}

TEST(ZstdStream, ContinuesInANewFrameAfterALostPortion) {
  const std::string text = content(4 * kPortion, 7);
  const std::string_view view(text);
  ZstdEncoder encoder;
  std::string compressed = encoder.add(view.substr(0, kPortion));
  encoder.add(view.substr(kPortion, kPortion));  // not written
  encoder.restart();
  compressed += encoder.add(view.substr(2 * kPortion, kPortion));
  compressed += encoder.end_frame();
  const Decoded decoded = decode(compressed);
  EXPECT_TRUE(decoded.content == text.substr(0, kPortion) + text.substr(2 * kPortion, kPortion));
}

}  // namespace
}  // namespace adit
