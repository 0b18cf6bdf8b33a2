// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/lcm_url.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>  // setenv, which is of POSIX

namespace adit {
namespace {

class LcmUrl : public testing::Test {
 protected:
  LcmUrl() { unsetenv("LCM_DEFAULT_URL"); }
  ~LcmUrl() override { unsetenv("LCM_DEFAULT_URL"); }
};

TEST_F(LcmUrl, AsksForALargeReceiveBuffer) {
  EXPECT_EQ(complete_lcm_url("udpm://239.255.76.67:7667?ttl=1"),
            "udpm://239.255.76.67:7667?ttl=1&recv_buf_size=4194304");
  EXPECT_EQ(complete_lcm_url("udpm://239.255.76.67:7667"),
            "udpm://239.255.76.67:7667?recv_buf_size=4194304");
}

TEST_F(LcmUrl, KeepsToTheSizeThatWasAskedFor) {
  EXPECT_EQ(complete_lcm_url("udpm://239.255.76.67:7667?recv_buf_size=9"),
            "udpm://239.255.76.67:7667?recv_buf_size=9");
}

TEST_F(LcmUrl, LeavesOtherTransportsAlone) {
  EXPECT_EQ(complete_lcm_url("memq://"), "memq://");
  EXPECT_EQ(complete_lcm_url("nonsense"), "nonsense");
}

TEST_F(LcmUrl, AnEmptyOneIsWhatTheEnvironmentSays) {
  EXPECT_EQ(complete_lcm_url(""), "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304");
  setenv("LCM_DEFAULT_URL", "memq://", 1);
  EXPECT_EQ(complete_lcm_url(""), "memq://");
  EXPECT_EQ(complete_lcm_url("udpm://"), "udpm://?recv_buf_size=4194304");
}

}  // namespace
}  // namespace adit
