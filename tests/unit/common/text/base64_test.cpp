// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/text/base64.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(Base64, GivesTheBytesBack) {
  std::string bytes;
  for (int length = 0; length < 300; ++length) {
    const std::string text =
        base64(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
    EXPECT_EQ(bytes_of_base64(text), bytes) << length;
    bytes.push_back(static_cast<char>(length * 37));
  }
}

TEST(Base64, RejectsOtherText) {
  for (const char* text : {"Zg=", "Z", "Zm9v!mFy", "Zg==Zg==", "====", "Zm 9v"})
    EXPECT_FALSE(bytes_of_base64(text)) << text;
}

}  // namespace
}  // namespace adit
