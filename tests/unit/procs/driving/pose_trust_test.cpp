// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/pose_trust.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

using Status = ScanMatch::Status;

constexpr std::int64_t kNow = 1'600'000'000'000'000;

TEST(PoseTrust, DoubtsPosesThatAreTooOldOrYetToCome) {
  const PoseTrust trust({0.25, 0.5});
  EXPECT_EQ(trust.doubt(kNow, std::nullopt), "no pose has come yet");
  EXPECT_FALSE(trust.doubt(kNow, kNow - 250'000));
  EXPECT_EQ(trust.doubt(kNow, kNow - 250'001), "the newest pose is too old");
  EXPECT_FALSE(trust.doubt(kNow, kNow + 250'000));
  EXPECT_EQ(trust.doubt(kNow, kNow + 250'001), "the newest pose is of a time to come");
}

TEST(PoseTrust, CountsFromTheFirstOfManyLostMatches) {
  PoseTrust trust({0.25, 0.5});
  for (std::int64_t after : {0, 200'000, 400'000}) trust.add_match(kNow + after, Status::kLost);
  EXPECT_FALSE(trust.doubt(kNow + 500'000, kNow + 500'000));
  EXPECT_EQ(trust.doubt(kNow + 500'001, kNow + 500'001), "scan matching is lost");
  trust.add_match(kNow + 600'000, Status::kMatched);
  EXPECT_FALSE(trust.doubt(kNow + 600'000, kNow + 600'000));
  trust.add_match(kNow + 700'000, Status::kLost);
  EXPECT_FALSE(trust.doubt(kNow + 1'200'000, kNow + 1'200'000));
}

TEST(PoseTrust, DoubtsALossOfAnotherTime) {
  PoseTrust trust({0.25, 0.5});
  trust.add_match(kNow, Status::kLost);
  EXPECT_TRUE(trust.doubt(kNow - 3'600'000'000, kNow - 3'600'000'000));
}

}  // namespace
}  // namespace adit
