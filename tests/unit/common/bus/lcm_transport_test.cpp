// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/lcm_transport.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>  // setenv, which is of POSIX

namespace adit {
namespace {

class LcmUrl : public testing::Test {
 protected:
  LcmUrl() { unsetenv("LCM_DEFAULT_URL"); }
  ~LcmUrl() override { unsetenv("LCM_DEFAULT_URL"); }
};

TEST_F(LcmUrl, RequestsALargeReceiveBuffer) {
  EXPECT_EQ(complete_lcm_url("udpm://239.255.76.67:7667?ttl=1"),
            "udpm://239.255.76.67:7667?ttl=1&recv_buf_size=4194304");
  EXPECT_EQ(complete_lcm_url("udpm://239.255.76.67:7667"),
            "udpm://239.255.76.67:7667?recv_buf_size=4194304");
}

TEST_F(LcmUrl, KeepsAnExplicitBufferSize) {
  EXPECT_EQ(complete_lcm_url("udpm://239.255.76.67:7667?recv_buf_size=9"),
            "udpm://239.255.76.67:7667?recv_buf_size=9");
}

TEST_F(LcmUrl, DoesNotChangeOtherTransports) {
  EXPECT_EQ(complete_lcm_url("memq://"), "memq://");
  EXPECT_EQ(complete_lcm_url("nonsense"), "nonsense");
}

TEST_F(LcmUrl, IsThatOfTheEnvironmentIfEmpty) {
  EXPECT_EQ(complete_lcm_url(""), "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304");
  setenv("LCM_DEFAULT_URL", "memq://", 1);
  EXPECT_EQ(complete_lcm_url(""), "memq://");
  EXPECT_EQ(complete_lcm_url("udpm://"), "udpm://?recv_buf_size=4194304");
}

constexpr const char* kHeadings = "Iface\tDestination\tGateway\tFlags\tRefCnt\tUse\tMetric\tMask\n";

TEST(TransportCheck, FindsAMulticastRoute) {
  EXPECT_TRUE(has_multicast_route(std::string(kHeadings) + "lo\t000000E0\t00000000\t0001\n"));
}

TEST(TransportCheck, FindsADefaultRoute) {
  EXPECT_TRUE(has_multicast_route(std::string(kHeadings) + "eth0\t00000000\t010011AC\t0003\n"));
}

TEST(TransportCheck, FindsNoRoute) {
  EXPECT_FALSE(has_multicast_route(kHeadings));
  EXPECT_FALSE(has_multicast_route(std::string(kHeadings) + "eth0\t000011AC\t00000000\t0001\n"));
  EXPECT_FALSE(has_multicast_route(""));
}

TEST(TransportCheck, NamesAnInvalidUrl) {
  EXPECT_EQ(lcm_failure_reason("nonsense://"),
            "cannot open LCM on nonsense://: check the URL, e.g. udpm://239.255.76.67:7667?ttl=0");
}

TEST(TransportCheck, GivesNoBufferAdviceWithoutMulticast) {
  EXPECT_FALSE(receive_buffer_advice("memq://"));
}

}  // namespace
}  // namespace adit
