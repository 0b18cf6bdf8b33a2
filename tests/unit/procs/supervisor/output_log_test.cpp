// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/management/output_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace adit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::size_t kPlenty = 1'000'000;

TEST(OutputLog, JoinsFragmentsToLines) {
  OutputLog log;
  log.add("one\ntw");
  EXPECT_THAT(log.since(0, kPlenty).lines, ElementsAre("one"));
  log.add("o\r\n\nthree");
  EXPECT_THAT(log.since(0, kPlenty).lines, ElementsAre("one", "two", ""));
  log.end_line();
  log.end_line();
  EXPECT_THAT(log.since(0, kPlenty).lines, ElementsAre("one", "two", "", "three"));
}

TEST(OutputLog, ReturnsOnlyNewLines) {
  OutputLog log;
  log.add("1\n2\n");
  const OutputLines first = log.since(0, kPlenty);
  EXPECT_EQ(first.next, 2);
  log.add("3\n");
  const OutputLines second = log.since(first.next, kPlenty);
  EXPECT_THAT(second.lines, ElementsAre("3"));
  EXPECT_EQ(second.omitted, 0);
  EXPECT_THAT(log.since(second.next, kPlenty).lines, IsEmpty());
}

TEST(OutputLog, OmitsAndCountsTheOldestLinesBeyondTheLimit) {
  OutputLog log;
  log.add("11\n22\n33\n44\n");
  const OutputLines unread = log.since(0, 6);
  EXPECT_THAT(unread.lines, ElementsAre("33", "44"));
  EXPECT_EQ(text_of(unread), "(2 lines omitted)\n33\n44\n");
  EXPECT_EQ(unread.omitted, 2);
  EXPECT_EQ(unread.next, 4);
}

TEST(OutputLog, StoresTheLastThousandLines) {
  OutputLog log;
  for (int i = 0; i < 2500; ++i) log.add(std::to_string(i) + "\n");
  const OutputLines unread = log.since(500, kPlenty);
  EXPECT_EQ(unread.lines.size(), 1000U);
  EXPECT_EQ(unread.lines.front(), "1500");
  EXPECT_EQ(unread.omitted, 1000);
  EXPECT_EQ(unread.next, 2500);
}

TEST(OutputLog, SplitsLongLines) {
  OutputLog log;
  log.add(std::string(2500, 'x'));
  const OutputLines unread = log.since(0, kPlenty);
  ASSERT_EQ(unread.lines.size(), 2U);
  EXPECT_EQ(unread.lines[0].size(), 1000U);
}

TEST(OutputLog, ReplacesTerminalControlCharacters) {
  OutputLog log;
  log.add("\x1b[2J red\x07\tgr\xC3\xBCn \xFF\n");
  log.add(std::string_view("a\0b\n", 4));
  EXPECT_THAT(log.since(0, kPlenty).lines, ElementsAre("?[2J red?\tgr\xC3\xBCn ?", "a?b"));
}

}  // namespace
}  // namespace adit
