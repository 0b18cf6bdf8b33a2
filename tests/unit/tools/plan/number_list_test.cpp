// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plan/number_list.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(NumberList, TakesNumbersBetweenCommas) {
  EXPECT_EQ(parse_number_list("--goal", "1.5,-2", 2, 3), (std::vector<double>{1.5, -2.0}));
  EXPECT_EQ(parse_number_list("--goal", "1,2,3e1", 2, 3), (std::vector<double>{1.0, 2.0, 30.0}));
}

TEST(NumberList, RejectsAnythingElse) {
  for (const char* text : {"", "1", "1,2,3,4", "1,", ",1", "1,x", "1, 2", "1,nan", "1,inf"}) {
    EXPECT_THROW(parse_number_list("--goal", text, 2, 3), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace adit
