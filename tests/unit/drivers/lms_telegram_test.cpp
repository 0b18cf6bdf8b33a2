// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/sick_lms2xx/measured_values.hpp"
#include "drivers/sick_lms2xx/telegram.hpp"

namespace adit {
namespace {

using Bytes = std::vector<std::uint8_t>;
using testing::ElementsAre;
using testing::ElementsAreArray;

/// Telegrams with their checksums from SICK's documents.
TEST(LmsTelegram, IsEncodedAsInTheListing) {
  EXPECT_THAT(encode_lms_telegram(Bytes{0x31}), ElementsAre(0x02, 0, 1, 0, 0x31, 0x15, 0x12));
  EXPECT_THAT(encode_lms_telegram(Bytes{0x20, 0x48}),
              ElementsAre(0x02, 0, 2, 0, 0x20, 0x48, 0x58, 0x08));
  EXPECT_THAT(encode_lms_telegram(Bytes{0x20, 0x24}),
              ElementsAre(0x02, 0, 2, 0, 0x20, 0x24, 0x34, 0x08));
  EXPECT_THAT(encode_lms_telegram(Bytes{0x20, 0x00, 'S', 'I', 'C', 'K', '_', 'L', 'M', 'S'}),
              ElementsAre(0x02, 0, 0x0A, 0, 0x20, 0, 0x53, 0x49, 0x43, 0x4B, 0x5F, 0x4C, 0x4D, 0x53,
                          0xBE, 0xC5));
}

/// A response with this content.
Bytes response(const Bytes& content) {
  Bytes bytes{0x02, 0x80, static_cast<std::uint8_t>(content.size() & 0xFF),
              static_cast<std::uint8_t>(content.size() >> 8)};
  bytes.insert(bytes.end(), content.begin(), content.end());
  const std::uint16_t sum = lms_checksum(bytes);
  bytes.push_back(static_cast<std::uint8_t>(sum & 0xFF));
  bytes.push_back(static_cast<std::uint8_t>(sum >> 8));
  return bytes;
}

TEST(LmsDecoder, FindsTelegramsThatArriveByteByByte) {
  LmsDecoder decoder;
  Bytes line{0x06};
  const Bytes telegram = response({0xA0, 0x00, 0x10});
  line.insert(line.end(), telegram.begin(), telegram.end());
  int found = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    decoder.add(std::span(line).subspan(i, 1), static_cast<std::int64_t>(1000 * i), 260.0);
    while (const auto decoded = decoder.next()) {
      EXPECT_EQ(i + 1, line.size());
      EXPECT_EQ(decoded->command, 0xA0);
      EXPECT_THAT(decoded->data, ElementsAre(0x00, 0x10));
      EXPECT_EQ(decoded->end_us, static_cast<std::int64_t>(1000 * i));
      ++found;
    }
  }
  EXPECT_EQ(found, 1);
  EXPECT_EQ(decoder.counts().garbage_bytes, 0);
}

TEST(LmsDecoder, CountsGarbageAndContinuesBehindIt) {
  LmsDecoder decoder;
  Bytes line{0xFF, 0x02, 0x80, 0x05, 0x00, 0x55};  // begins like a telegram
  const Bytes first = response({0xB0, 1, 0, 7, 0, 0, 0x10});
  line.insert(line.end(), first.begin(), first.end());
  Bytes damaged = response({0xB0, 1, 0, 8, 0, 0, 0x10});
  damaged[6] ^= 0x40;
  line.insert(line.end(), damaged.begin(), damaged.end());
  const Bytes last = response({0xB0, 1, 0, 9, 0, 0, 0x10});
  line.insert(line.end(), last.begin(), last.end());
  decoder.add(line, 0, 0.0);
  std::vector<int> values;
  while (const auto decoded = decoder.next()) values.push_back(decoded->data[2]);
  EXPECT_THAT(values, ElementsAre(7, 9));
  EXPECT_EQ(decoder.counts().garbage_bytes, static_cast<std::int64_t>(6 + damaged.size()));
  EXPECT_GE(decoder.counts().corrupt, 1);
}

/// A telegram that is only recognised later, behind a wrong length, has the time of its last byte.
TEST(LmsDecoder, KeepsTheTimeOfArrivalOfWhatItDecodesLater) {
  LmsDecoder decoder;
  Bytes line{0x02, 0x80, 40, 0};
  const Bytes telegram = response({0xA0, 0x00, 0x10});
  line.insert(line.end(), telegram.begin(), telegram.end());
  line.push_back(0x06);  // behind it in the same read
  decoder.add(line, 5000, 100.0);
  EXPECT_FALSE(decoder.next());
  const Bytes later(60, 0xFF);
  decoder.add(later, 90'000, 100.0);
  const auto decoded = decoder.next();
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->end_us, 4900);
}

TEST(LmsDecoder, ReportsANack) {
  LmsDecoder decoder;
  decoder.add(Bytes{0x15}, 0, 0.0);
  EXPECT_FALSE(decoder.next());
  EXPECT_TRUE(decoder.take_nack());
  EXPECT_FALSE(decoder.take_nack());
}

/// Data of a response B0h: two readings, and the status.
Bytes two_readings(unsigned header, unsigned first, unsigned second) {
  Bytes data;
  for (const unsigned word : {header, first, second}) {
    data.push_back(static_cast<std::uint8_t>(word & 0xFF));
    data.push_back(static_cast<std::uint8_t>(word >> 8));
  }
  data.push_back(0x10);
  return data;
}

TEST(LmsMeasuredValues, AreDistancesOf13BitsInCentimetresOrMillimetres) {
  const auto in_cm = read_measured_values(two_readings(0x0002, 0x0123, 0xE456));
  ASSERT_TRUE(in_cm);
  EXPECT_THAT(in_cm->raw, ElementsAre(0x0123, 0x0456));  // without the bits of the fields
  EXPECT_FLOAT_EQ(in_cm->ranges_m()[0], 2.91F);
  const auto in_mm = read_measured_values(two_readings(0x4002, 0x0123, 0x0456));
  ASSERT_TRUE(in_mm);
  EXPECT_FLOAT_EQ(in_mm->ranges_m()[0], 0.291F);
}

TEST(LmsMeasuredValues, WithoutReturnReadTheMaximumAndDazzledOnesNothing) {
  const auto values = read_measured_values(two_readings(2, 0x1FFB, 0x1FFE));
  ASSERT_TRUE(values);
  EXPECT_FLOAT_EQ(values->ranges_m()[0], 81.91F);
  EXPECT_TRUE(std::isnan(values->ranges_m()[1]));
}

TEST(LmsMeasuredValues, OfAnotherFormAreRejected) {
  EXPECT_FALSE(read_measured_values(two_readings(0x8002, 1, 2)));  // unit of 10 cm
  EXPECT_FALSE(read_measured_values(two_readings(0x2002, 1, 2)));  // a part of a scan
  EXPECT_FALSE(read_measured_values(two_readings(5, 1, 2)));
  EXPECT_FALSE(read_measured_values(two_readings(0, 1, 2)));
  EXPECT_FALSE(read_measured_values(Bytes{}));
}

}  // namespace
}  // namespace adit
