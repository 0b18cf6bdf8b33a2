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

TEST(ProcessListDiff, ListsChangedAddedAndRemovedCommands) {
  const ProcessListDiff change = change_to(R"(
cmd "d" { exec = "four"; } cmd "b" { exec = "two"; } cmd "a" { exec = "one"; stop_signal = 9; }
script "go" { start cmd "a"; })");
  EXPECT_EQ(text_of(change), "changed: a\nadded: d\nremoved: c\n");
}

TEST(ProcessListDiff, IsEmptyForEqualLists) {
  EXPECT_EQ(text_of(change_to(kList)), "no changes\n");
}

TEST(ProcessListDiff, DetectsChangedScripts) {
  const ProcessListDiff change = change_to(R"(
cmd "a" { exec = "one"; } cmd "b" { exec = "two"; } cmd "c" { exec = "three"; })");
  EXPECT_EQ(text_of(change), "scripts changed\n");
}

}  // namespace
}  // namespace adit
