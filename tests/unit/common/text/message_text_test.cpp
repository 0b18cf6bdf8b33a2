// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/text/message_text.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/text/text_check.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

TEST(Quote, KeepsText) {
  EXPECT_EQ(quote("EDGE_SE3"), "'EDGE_SE3'");
  EXPECT_EQ(quote("Kümmerle €"), "'Kümmerle €'");
  EXPECT_EQ(quote(""), "''");
  EXPECT_EQ(quote("name", '"'), "\"name\"");
}

TEST(Quote, EscapesWhatActsOnATerminal) {
  EXPECT_EQ(quote("\x1b[2J"), "'\\x1b[2J'");
  EXPECT_EQ(quote("a\nb\tc\rd"), "'a\\nb\\tc\\x0dd'");
  EXPECT_EQ(quote("\x7f\x80\xff"), "'\\x7f\\x80\\xff'");
  EXPECT_EQ(quote("\xc2\x9b"), "'\\xc2\\x9b'");           // U+009B, the control sequence introducer
  EXPECT_EQ(quote("\xe2\x80\xae"), "'\\xe2\\x80\\xae'");  // U+202E, right to left
  EXPECT_EQ(quote("\xc3"), "'\\xc3'");                    // a truncated character
}

TEST(Quote, ShowsWhatFollowsANulByte) { EXPECT_EQ(quote(std::string("a\0b", 3)), "'a\\x00b'"); }

TEST(Quote, BoundsTheLengthWithoutCuttingACharacter) {
  const std::string text = quote(std::string(65536, 'x'));
  EXPECT_LT(text.size(), 120U);
  EXPECT_THAT(text, HasSubstr("..' (65536 bytes)"));
  std::string euros;
  for (int i = 0; i < 1000; ++i) euros += "€";
  EXPECT_EQ(find_non_text_byte(quote(euros)), std::nullopt);
}

TEST(MessageLine, IsOneLineOfBoundedLength) {
  EXPECT_EQ(message_line("cannot read a\x1b\nb"), "cannot read a\\x1b\\nb");
  EXPECT_LT(message_line(std::string(1'000'000, 'x')).size(), 2100U);
}

TEST(PrintableLines, KeepsLines) {
  EXPECT_EQ(printable_lines("one\n\ttwo\x1b[m\n"), "one\n\ttwo\\x1b[m\n");
  EXPECT_EQ(printable_lines(std::string(100'000, 'x')).size(), 100'000U);
}

TEST(PrintError, PrintsTheProgramAndOneLine) {
  testing::internal::CaptureStderr();
  print_error("adit", "a\nb");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "adit: a\\nb\n");
}

}  // namespace
}  // namespace adit
