// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/keeping/list_change.hpp"

#include <gtest/gtest.h>

#include "common/process_list/parser.hpp"

namespace adit {
namespace {

const char* const kList = R"(
cmd "a" { exec = "one"; } cmd "b" { exec = "two"; } cmd "c" { exec = "three"; }
script "go" { start cmd "a"; })";

ListChange change_to(const std::string& text) {
  return change_between(parse_process_list(kList, "before"), parse_process_list(text, "after"));
}

TEST(ListChange, SaysWhatIsChangedNewAndGone) {
  const ListChange change = change_to(R"(
cmd "d" { exec = "four"; } cmd "b" { exec = "two"; } cmd "a" { exec = "one"; stop_signal = 9; }
script "go" { start cmd "a"; })");
  EXPECT_EQ(text_of(change), "changed: a\nnew: d\ngone: c\n");
}

TEST(ListChange, SaysThatThereIsNone) {
  EXPECT_EQ(text_of(change_to(kList)), "nothing has changed\n");
}

TEST(ListChange, SeesScripts) {
  const ListChange change = change_to(R"(
cmd "a" { exec = "one"; } cmd "b" { exec = "two"; } cmd "c" { exec = "three"; })");
  EXPECT_EQ(text_of(change), "scripts have changed\n");
}

}  // namespace
}  // namespace adit
