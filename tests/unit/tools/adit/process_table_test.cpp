// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "tools/adit/adit_app.hpp"

namespace adit {
namespace {

TEST(ProcessTableText, HasAHeadingAndARowPerProcess) {
  EXPECT_EQ(
      process_table_text("mapping\trobot\tslam\trunning\t4711\t0.5\t40000000\t2\tended with 1\n"
                         "x\tfar\t\tstopped\t0\t0\t0\t0\t\n"),
      "NAME     COMPUTER  GROUP  STATE     PID  CPU %    MB  RESTARTS\n"
      "mapping  robot     slam   running  4711   50.0  40.0         2  ended with 1\n"
      "x        far              stopped     -      -     -         0\n");
}

TEST(ProcessTableText, OmitsAnEmptyGroupColumn) {
  EXPECT_EQ(process_table_text("x\tfar\t\tstopped\t0\t0\t0\t0\t\n"),
            "NAME  COMPUTER  STATE    PID  CPU %  MB  RESTARTS\n"
            "x     far       stopped    -      -   -         0\n");
}

TEST(ProcessTableText, ShowsNoControlCharacters) {
  EXPECT_EQ(process_table_text("x\x1b[2J\tfar\t\tstopped\t0\t0\t0\t3 (1)\t\n"),
            "NAME      COMPUTER  STATE    PID  CPU %  MB  RESTARTS\n"
            "x\\x1b[2J  far       stopped    -      -   -     3 (1)\n");
}

TEST(ProcessTableText, WithoutProcessesIsTheHeading) {
  EXPECT_EQ(process_table_text(""), "NAME  COMPUTER  STATE  PID  CPU %  MB  RESTARTS\n");
}

}  // namespace
}  // namespace adit
