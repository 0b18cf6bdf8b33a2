// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/fields/fields.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/messages/fields/quantities.hpp"
#include "tests/support/message_fields.hpp"
#include "tests/support/message_types.hpp"

namespace adit {
namespace {

TEST(Fields, CoverEveryByteOfEveryMessageInOrder) {
  for (const MessageType& type : message_types()) {
    const FieldLayout layout = type.layout(type.sample);
    EXPECT_EQ(layout.end(), type.sample.size()) << type.name;
    for (const FieldPlace& place : layout.places()) {
      if (place.kind == FieldPlace::Kind::kText) continue;
      const double encoded = number_of(place, read_bits(type.sample, place));
      const bool unsigned_byte = place.bytes == 1 && encoded < 0.0;
      EXPECT_TRUE(encoded == place.value || (std::isnan(encoded) && std::isnan(place.value)) ||
                  (unsigned_byte && encoded + 256.0 == place.value))
          << type.name << "." << place.name << ": " << encoded << ", not " << place.value;
    }
  }
}

TEST(Fields, AreRejectedOutsideTheirRange) {
  int rejected = 0;
  for (const MessageType& type : message_types()) {
    const FieldLayout layout = type.layout(type.sample);
    for (const FieldPlace& place : layout.places()) {
      if (place.kind == FieldPlace::Kind::kText) continue;
      for (const std::uint64_t bits : extreme_bits(place)) {
        const double number = number_of(place, bits);
        if (place.quantity.contains(number)) continue;
        std::vector<std::uint8_t> message = type.sample;
        write_bits(place, bits, message);
        EXPECT_NE(type.process(message), "") << type.name << "." << place.name << " = " << number;
        ++rejected;
      }
    }
  }
  EXPECT_GT(rejected, 5000);
}

/// Values that are not absurd reach the stages: the table must not be too narrow.
TEST(Fields, ContainTheirEnds) {
  for (const MessageType& type : message_types()) {
    EXPECT_EQ(type.process(type.sample), "") << type.name;
    const FieldLayout layout = type.layout(type.sample);
    for (const FieldPlace& place : layout.places()) {
      EXPECT_LE(place.quantity.min, place.quantity.max) << type.name << "." << place.name;
      EXPECT_TRUE(place.quantity.contains(place.value)) << type.name << "." << place.name;
    }
  }
}

using Rows = double[3][3];

TEST(MatrixLimit, AcceptsACovariance) {
  const Rows zero = {};
  const Rows tunnel = {{1e4, 0.999, 0.0}, {0.999, 1e-4, 0.0}, {0.0, 0.0, 1e-6}};
  EXPECT_TRUE(is_plausible(zero, kCovariance));
  EXPECT_TRUE(is_plausible(tunnel, kCovariance));
}

TEST(MatrixLimit, RejectsWhatIsNotPositiveSemidefinite) {
  // Each pair of its directions can be correlated like this, not all three.
  const Rows three = {{1.0, 0.9, -0.9}, {0.9, 1.0, 0.9}, {-0.9, 0.9, 1.0}};
  const Rows pair = {{1.0, 2.0, 0.0}, {2.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  const Rows negative = {{-1e-9, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  const Rows beside_zero = {{0.0, 1e-9, 0.0}, {1e-9, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  const Rows asymmetric = {{1.0, 0.5, 0.0}, {0.4, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  for (const Rows* rows : {&three, &pair, &negative, &beside_zero, &asymmetric}) {
    EXPECT_FALSE(is_plausible(*rows, kCovariance)) << (*rows)[0][0] << ", " << (*rows)[0][1];
  }
}

TEST(MatrixLimit, RejectsAbsurdMagnitudes) {
  for (const double number : {1e300, -1e300, 1e9, std::nan(""), HUGE_VAL}) {
    const Rows rows = {{number, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    EXPECT_FALSE(is_plausible(rows, kCovariance)) << number;
  }
}

}  // namespace
}  // namespace adit
