// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/adit/progress_bar.hpp"

#include <chrono>
#include <csignal>
#include <sstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/adit/run_progress.hpp"

namespace adit {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

using Form = ProgressBar::Form;

constexpr std::chrono::milliseconds kNoDelay{0};

TEST(ProgressBar, ShowsTheCompletedFraction) {
  std::ostringstream out;
  ProgressBar bar("importing", out, Form::kBar, kNoDelay);
  bar.update(0.25);
  EXPECT_THAT(out.str(), HasSubstr("importing  [##########..............................]  25 %"));
}

TEST(ProgressBar, IsErasedAtTheEnd) {
  std::ostringstream out;
  { ProgressBar("importing", out, Form::kBar, kNoDelay).update(0.5); }
  EXPECT_THAT(out.str(), EndsWith("\r\033[K"));
}

TEST(ProgressBar, IsHiddenForShortWork) {
  std::ostringstream out;
  {
    ProgressBar bar("importing", out, Form::kBar, std::chrono::hours(1));
    for (int i = 0; i <= 100; ++i) bar.update(i / 100.0);
  }
  EXPECT_EQ(out.str(), "");
}

TEST(ProgressBar, LimitsTheRedrawRate) {
  std::ostringstream out;
  ProgressBar bar("importing", out, Form::kBar, kNoDelay);
  bar.update(0.1);
  const std::string first = out.str();
  bar.update(0.2);
  EXPECT_EQ(out.str(), first);
}

TEST(ProgressBar, PrintsLinesWithoutATerminal) {
  std::ostringstream out;
  {
    ProgressBar bar("mapping", out, Form::kLines, kNoDelay);
    bar.update(0.0);
    bar.update(0.5);  // within ten seconds
  }
  EXPECT_EQ(out.str(), "mapping: 0 %\n");
}

TEST(RunProgress, SaysThatAnInterruptedRunHasWrittenNothing) {
  RunProgress progress("out");
  progress.update("mapping", 0.5);
  std::raise(SIGINT);
  try {
    progress.update("mapping", 0.6);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "interrupted; nothing was written to out");
  }
}

TEST(ProgressBar, ClampsInvalidFractions) {
  std::ostringstream out;
  { ProgressBar("importing", out, Form::kBar, kNoDelay).update(7.0); }
  { ProgressBar("importing", out, Form::kBar, kNoDelay).update(-7.0); }
  EXPECT_THAT(out.str(), HasSubstr("100 %"));
}

}  // namespace
}  // namespace adit
