// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/receive_loss.hpp"

#include <cstdlib>
#include <stdexcept>

#include <gtest/gtest.h>

namespace adit {
namespace {

class ReceiveLoss : public testing::Test {
 protected:
  ReceiveLoss() { unsetenv(kVariable); }
  ~ReceiveLoss() override { unsetenv(kVariable); }

  static constexpr const char* kVariable = "ADIT_RECEIVE_LOSS";
};

TEST_F(ReceiveLoss, IsNoneWhereNobodyAsksForIt) { EXPECT_EQ(receive_loss_share(), 0.0); }

TEST_F(ReceiveLoss, IsWhatTheEnvironmentSays) {
  setenv(kVariable, "0.05", 1);
  EXPECT_EQ(receive_loss_share(), 0.05);
}

TEST_F(ReceiveLoss, IsRejectedWhereItIsNoShare) {
  for (const char* text : {"", "5%", "1", "-0.1", "nan"}) {
    setenv(kVariable, text, 1);
    EXPECT_THROW(receive_loss_share(), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace adit
