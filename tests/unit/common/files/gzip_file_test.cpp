// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/gzip_file.hpp"

#include <array>
#include <fstream>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "common/files/file_utils.hpp"
#include "common/files/gzip_encoder.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

std::string numbers(int from, int to) {
  std::string text;
  for (int i = from; i < to; ++i) text += std::to_string(i * i) + "\n";
  return text;
}

class GzipFileTest : public testing::Test {
 protected:
  /// One member of a gzip file.
  [[nodiscard]] std::string compressed(const std::string& text) const {
    const auto path = folder_ / "member.gz";
    gzFile file = gzopen(path.c_str(), "wb");
    gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
    gzclose(file);
    return test::contents(path);
  }

  struct Content {
    std::string text;
    std::string damage;
  };
  [[nodiscard]] Content read(const std::string& bytes) const {
    std::ofstream(folder_ / "x.gz", std::ios::binary) << bytes;
    GzipFile file(folder_ / "x.gz");
    Content content;
    std::array<char, 1000> chunk{};
    while (const std::size_t got = file.read(chunk)) content.text.append(chunk.data(), got);
    EXPECT_LE(file.fraction_read(), 1.0);
    content.damage = file.damage();
    return content;
  }

  test::ScratchFolder folder_;
};

TEST_F(GzipFileTest, ReadsPlainAndCompressedFiles) {
  const std::string text = numbers(0, 50'000);
  const std::string half = compressed(text);
  for (const std::string& bytes :
       {text, half, compressed(numbers(0, 100)) + compressed(numbers(100, 50'000)),
        half + std::string(100'000, '\0')}) {
    const Content content = read(bytes);
    EXPECT_EQ(content.text, text);
    EXPECT_THAT(content.damage, IsEmpty());
  }
  EXPECT_EQ(read("").text, "");
  EXPECT_EQ(read("x").text, "x");
}

TEST_F(GzipFileTest, ReportsATruncatedFile) {
  const std::string bytes = compressed(numbers(0, 50'000));
  for (const std::size_t length :
       {std::size_t{3}, std::size_t{12}, bytes.size() / 2, bytes.size() - 1}) {
    const Content content = read(bytes.substr(0, length));
    EXPECT_THAT(numbers(0, 50'000), StartsWith(content.text));
    EXPECT_THAT(content.damage, HasSubstr("damaged")) << length;
  }
}

/// zlib's gzread takes this for garbage after the end.
TEST_F(GzipFileTest, ReportsADamagedMember) {
  const std::string first = compressed(numbers(0, 1000));
  std::string second = compressed(numbers(1000, 2000));
  const std::size_t lost = second.size();
  second[0] = 'x';
  const Content content = read(first + second);
  EXPECT_EQ(content.text, numbers(0, 1000));
  EXPECT_THAT(content.damage, StartsWith("the last " + std::to_string(lost) + " of "));
}

TEST_F(GzipFileTest, KeepsTheTextBeforeAWrongChecksum) {
  std::string bytes = compressed(numbers(0, 50'000));
  bytes[bytes.size() - 5] ^= 1;
  const Content content = read(bytes);
  EXPECT_EQ(content.text, numbers(0, 50'000));
  EXPECT_THAT(content.damage, HasSubstr("may be wrong"));
}

TEST_F(GzipFileTest, ReportsEveryFlippedBit) {
  const std::string text = numbers(0, 20'000);
  const std::string intact = compressed(text);
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    std::string bytes = intact;
    const auto at = std::uniform_int_distribution<std::size_t>(10, bytes.size() - 1)(random);
    bytes[at] =
        static_cast<char>(bytes[at] ^ (1 << std::uniform_int_distribution<int>(0, 7)(random)));
    const Content content = read(bytes);
    EXPECT_TRUE(!content.damage.empty() || content.text == text) << at;
  }
}

TEST_F(GzipFileTest, DamageIsAnErrorOfAFileReadAsAWhole) {
  const std::string bytes = compressed(numbers(0, 1000));
  std::ofstream(folder_ / "x.gz", std::ios::binary) << bytes << "garbage";
  EXPECT_THROW(read_gzip_file(folder_ / "x.gz"), std::runtime_error);
  std::ofstream(folder_ / "x.gz", std::ios::binary) << bytes;
  EXPECT_EQ(read_gzip_file(folder_ / "x.gz"), numbers(0, 1000));
  EXPECT_THROW(read_gzip_file(folder_ / "x.gz", 1000), std::runtime_error);  // a small bomb
}

TEST_F(GzipFileTest, ReadsWhatTheEncoderWrites) {
  GzipEncoder encoder;
  for (int i = 0; i < 50'000; i += 1000) encoder.add(numbers(i, i + 1000));
  std::ofstream(folder_ / "parts.gz", std::ios::binary) << encoder.finish();
  EXPECT_TRUE(read_gzip_file(folder_ / "parts.gz") == numbers(0, 50'000));
  GzipEncoder empty;
  std::ofstream(folder_ / "empty.gz", std::ios::binary) << empty.finish();
  EXPECT_EQ(read_gzip_file(folder_ / "empty.gz"), "");
}

}  // namespace
}  // namespace adit
