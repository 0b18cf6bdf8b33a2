// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/messages/codec.hpp"
#include "common/messages/procman.hpp"  // declares from_message of its namespace for the templates
#include "tests/support/scratch_folder.hpp"

namespace adit::test {

/// Golden bytes: tests/unit/common/messages/golden/TYPE.hex, one file for each type, written once
/// by the encoder that lcm-gen generates. After an intended change of a type, run test_messages
/// with ADIT_WRITE_GOLDEN=1 and review the difference.
inline std::filesystem::path golden_folder() {
  return std::filesystem::path(ADIT_SOURCE_DIR) / "tests/unit/common/messages/golden";
}

/// Hexadecimal, 32 bytes in a line.
inline std::string hex(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    text += fmt::format("{:02x}", bytes[i]);
    if (i % 32 == 31 || i + 1 == bytes.size()) text += '\n';
  }
  return text;
}

template <class Msg>
void expect_golden_bytes(const Msg& message) {
  const auto path = golden_folder() / fmt::format("{}.hex", Msg::getTypeName());
  if (std::getenv("ADIT_WRITE_GOLDEN") != nullptr) std::ofstream(path) << hex(encode(message));
  EXPECT_EQ(hex(encode(message)), contents(path)) << path;
}

/// Expects that `message`, which the test has filled field by field with distinct values, has the
/// golden bytes, that `value` converts to it, and that it converts to `value`. A round trip alone
/// would not detect two fields that both conversions swap.
template <class Msg, class Value>
void expect_golden(const Msg& message, const Value& value) {
  expect_golden_bytes(message);
  EXPECT_EQ(hex(encode(to_message(value))), hex(encode(message))) << Msg::getTypeName();
  const auto converted = from_message(message);
  ASSERT_TRUE(converted) << Msg::getTypeName() << ": " << converted.rejection();
  EXPECT_EQ(hex(encode(to_message(*converted))), hex(encode(message))) << Msg::getTypeName();
  if constexpr (std::equality_comparable<Value>) {
    EXPECT_TRUE(*converted == value) << Msg::getTypeName();
  }
}

}  // namespace adit::test
