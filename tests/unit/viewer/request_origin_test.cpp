// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/server/request_origin.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(RequestOrigin, AcceptsHostsThatNeedNoNameServer) {
  for (const char* host :
       {"localhost", "localhost:8765", "127.0.0.1:8765", "192.168.1.7", "[::1]:8765"}) {
    EXPECT_TRUE(is_own_host(host)) << host;
  }
}

TEST(RequestOrigin, RejectsHostsThatANameServerCanMakePointHere) {
  for (const char* host : {"", "example.org", "example.org:8765", "127.0.0.1.example.org", "["}) {
    EXPECT_FALSE(is_own_host(host)) << host;
  }
}

TEST(RequestOrigin, AllowsTheOwnPageAndThoseNamed) {
  EXPECT_TRUE(is_allowed_origin("", "127.0.0.1:8765", {}));
  EXPECT_TRUE(is_allowed_origin("http://127.0.0.1:8765", "127.0.0.1:8765", {}));
  EXPECT_TRUE(is_allowed_origin("https://app.foxglove.dev", "localhost:8765",
                                {"https://app.foxglove.dev"}));
  EXPECT_FALSE(is_allowed_origin("https://app.foxglove.dev", "localhost:8765", {}));
  EXPECT_FALSE(is_allowed_origin("http://127.0.0.1:9", "127.0.0.1:8765", {}));
  EXPECT_FALSE(is_allowed_origin("http://example.org", "example.org", {})) << "DNS rebinding";
  EXPECT_FALSE(is_allowed_origin("null", "127.0.0.1:8765", {}));
}

}  // namespace
}  // namespace adit
