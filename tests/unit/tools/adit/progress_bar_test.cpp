// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/adit/progress_bar.hpp"

#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace adit {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

constexpr std::chrono::milliseconds kNoDelay{0};

TEST(ProgressBar, ShowsTheCompletedFraction) {
  std::ostringstream out;
  ProgressBar bar("importing", &out, kNoDelay);
  bar.update(0.25);
  EXPECT_THAT(out.str(), HasSubstr("importing  [##########..............................]  25 %"));
}

TEST(ProgressBar, IsErasedAtTheEnd) {
  std::ostringstream out;
  { ProgressBar("importing", &out, kNoDelay).update(0.5); }
  EXPECT_THAT(out.str(), EndsWith("\r\033[K"));
}

TEST(ProgressBar, IsHiddenForShortWork) {
  std::ostringstream out;
  {
    ProgressBar bar("importing", &out, std::chrono::hours(1));
    for (int i = 0; i <= 100; ++i) bar.update(i / 100.0);
  }
  EXPECT_EQ(out.str(), "");
}

TEST(ProgressBar, LimitsTheRedrawRate) {
  std::ostringstream out;
  ProgressBar bar("importing", &out, kNoDelay);
  bar.update(0.1);
  const std::string first = out.str();
  bar.update(0.2);
  EXPECT_EQ(out.str(), first);
}

TEST(ProgressBar, DrawsNothingWithoutATerminal) { ProgressBar("", nullptr, kNoDelay).update(0.5); }

TEST(ProgressBar, ClampsInvalidFractions) {
  std::ostringstream out;
  { ProgressBar("importing", &out, kNoDelay).update(7.0); }
  { ProgressBar("importing", &out, kNoDelay).update(-7.0); }
  EXPECT_THAT(out.str(), HasSubstr("100 %"));
}

}  // namespace
}  // namespace adit
