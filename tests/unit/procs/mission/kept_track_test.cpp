// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/kept_track.hpp"

#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::int64_t kOdom = 1'600'000'000'000'000;

TEST(KeptTrack, ComesBackFromItsBytes) {
  for (const KeptPlace& place : {KeptPlace{kOdom, {1.0, -2.0, 0.3}, {}, false},
                                 KeptPlace{kOdom, {1.0, -2.0, 0.3}, Pose2{4.0, 5.0, -3.0}, true}}) {
    const auto bytes = to_bytes(place);
    EXPECT_EQ(kept_place_from(bytes), place);
    EXPECT_FALSE(kept_place_from(std::span(bytes).first(bytes.size() - 1)));
  }
}

TEST(KeptTrack, IsTheOneThatWasDriven) {
  OwnTrack driven;
  std::vector<KeptPlace> kept;
  const auto drive = [&](double x, double y) {
    if (driven.add(0, {x, y, 0.0})) kept.push_back({kOdom, {x, y, 0.0}, {}, true});
  };
  for (int i = 0; i < 50; ++i) drive(0.1 * i, 0.0);
  for (int i = 0; i < 20; ++i) drive(5.0, 0.1 * i);
  for (int i = 20; i > 0; --i) drive(5.0, 0.1 * i);  // a side drift that it came back from
  OwnTrack again = track_of(kept);
  again.add(0, *driven.T_odom_body());
  EXPECT_EQ(again.back(100.0), driven.back(100.0));
  EXPECT_EQ(again.travelled_m(), driven.travelled_m());
}

TEST(KeptTrack, LeadsOverIntoTheOdomOfBefore) {
  std::vector<KeptPlace> kept;
  for (int i = 0; i < 10; ++i) kept.push_back({kOdom, {0.3 * i, 0.0, 0.0}, Pose2{}, true});
  const Pose2 T_map_odom{2.7, 0.0, 0.0};
  kept.push_back({kOdom + 1, {}, {}, false});
  EXPECT_EQ(track_of(kept).back(100.0).size(), 2U);  // the body, and where it stands
  kept.push_back({kOdom + 1, {0.3, 0.0, 0.0}, T_map_odom, true});
  const auto back = track_of(kept).back(100.0);
  EXPECT_NEAR(back.back().x, -2.7, 1e-9);
}

}  // namespace
}  // namespace adit
