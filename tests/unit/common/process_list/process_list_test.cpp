// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_list/process_list.hpp"

#include <gtest/gtest.h>

#include "common/process_list/parser.hpp"

namespace adit {
namespace {

const char* const kList = R"(
cmd "a" { exec = "one"; } cmd "b" { exec = "two"; } cmd "c" { exec = "three"; }
script "go" { start cmd "a"; })";

ProcessListDiff change_to(const std::string& text) {
  return diff(parse_process_list(kList, "before"), parse_process_list(text, "after"));
}

TEST(ProcessListDiff, SaysWhatIsChangedNewAndGone) {
  const ProcessListDiff change = change_to(R"(
cmd "d" { exec = "four"; } cmd "b" { exec = "two"; } cmd "a" { exec = "one"; stop_signal = 9; }
script "go" { start cmd "a"; })");
  EXPECT_EQ(text_of(change), "changed: a\nnew: d\ngone: c\n");
}

TEST(ProcessListDiff, SaysThatThereIsNone) {
  EXPECT_EQ(text_of(change_to(kList)), "nothing has changed\n");
}

TEST(ProcessListDiff, SeesScripts) {
  const ProcessListDiff change = change_to(R"(
cmd "a" { exec = "one"; } cmd "b" { exec = "two"; } cmd "c" { exec = "three"; })");
  EXPECT_EQ(text_of(change), "scripts have changed\n");
}

}  // namespace
}  // namespace adit
