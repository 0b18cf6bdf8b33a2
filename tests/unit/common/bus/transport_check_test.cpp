// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/transport_check.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr const char* kHeadings = "Iface\tDestination\tGateway\tFlags\tRefCnt\tUse\tMetric\tMask\n";

TEST(TransportCheck, SeesARouteForMulticast) {
  EXPECT_TRUE(routes_multicast(std::string(kHeadings) + "lo\t000000E0\t00000000\t0001\n"));
}

TEST(TransportCheck, SeesADefaultRoute) {
  EXPECT_TRUE(routes_multicast(std::string(kHeadings) + "eth0\t00000000\t010011AC\t0003\n"));
}

TEST(TransportCheck, SeesThatThereIsNone) {
  EXPECT_FALSE(routes_multicast(kHeadings));
  EXPECT_FALSE(routes_multicast(std::string(kHeadings) + "eth0\t000011AC\t00000000\t0001\n"));
  EXPECT_FALSE(routes_multicast(""));
}

TEST(TransportCheck, NamesTheUrlThatIsNone) {
  EXPECT_EQ(why_no_lcm("nonsense://"),
            "no LCM on nonsense://: check the URL, it looks like udpm://239.255.76.67:7667?ttl=0");
}

TEST(TransportCheck, HasNoAdviceOnBuffersWithoutMulticast) {
  EXPECT_FALSE(buffer_advice("memq://"));
}

}  // namespace
}  // namespace adit
