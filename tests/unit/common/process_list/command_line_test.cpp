// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_list/command_line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace adit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

std::vector<std::string> words(std::string_view text) {
  const auto line = parse_command_line(text);
  return line ? line->arguments
              : std::vector<std::string>{"refused", std::string(line.rejection())};
}

TEST(CommandLine, DividesAtBlanks) {
  EXPECT_THAT(words("  adit-mapping\t--sim-time \n x "),
              ElementsAre("adit-mapping", "--sim-time", "x"));
}

TEST(CommandLine, KeepsTogetherWhatIsQuoted) {
  EXPECT_THAT(words(R"(a "b c" 'd "e' f\ g h"i"'j' "" '')"),
              ElementsAre("a", "b c", "d \"e", "f g", "hij", "", ""));
}

TEST(CommandLine, EscapesAsAShellDoes) {
  EXPECT_THAT(words(R"(a "\"b\\" '\' "c\d" \")"), ElementsAre("a", "\"b\\", "\\", "c\\d", "\""));
}

TEST(CommandLine, IsNotForAShell) {
  EXPECT_THAT(words("a $HOME; rm -rf * | `b` > c && d"),
              ElementsAre("a", "$HOME;", "rm", "-rf", "*", "|", "`b`", ">", "c", "&&", "d"));
}

TEST(CommandLine, PutsAssignmentsBeforeTheProgramIntoItsEnvironment) {
  const auto line = parse_command_line("A=B _C1='d e' EMPTY= prog X=Y");
  ASSERT_TRUE(line);
  EXPECT_THAT(line->environment,
              ElementsAre(Pair("A", "B"), Pair("_C1", "d e"), Pair("EMPTY", "")));
  EXPECT_THAT(line->arguments, ElementsAre("prog", "X=Y"));
}

TEST(CommandLine, KnowsWhatIsNoAssignment) {
  for (const char* text : {"'A'=B", "=B", "1A=B", "a-b=c", "\"A=B\""}) {
    const auto line = parse_command_line(text);
    ASSERT_TRUE(line) << text;
    EXPECT_THAT(line->environment, IsEmpty()) << text;
  }
}

TEST(CommandLine, RejectsWhatHasNoEndAndWhatRunsNothing) {
  EXPECT_THAT(words("a 'b"), ElementsAre("refused", "a quote that does not end"));
  EXPECT_THAT(words("a \"b\\\""), ElementsAre("refused", "a quote that does not end"));
  EXPECT_THAT(words("a \\"), ElementsAre("refused", "a backslash at the end"));
  EXPECT_THAT(words(""), ElementsAre("refused", "no program to run"));
  EXPECT_THAT(words("A=B"), ElementsAre("refused", "no program to run"));
  EXPECT_THAT(words("'' x"), ElementsAre("refused", "no program to run"));
  EXPECT_THAT(words(std::string_view("a\0b", 3)),
              ElementsAre("refused", "a NUL in the command line"));
}

}  // namespace
}  // namespace adit
