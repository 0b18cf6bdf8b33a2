// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mapping/local_map.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include <gtest/gtest.h>

#include "common/messages/fields/quantities.hpp"
#include "common/messages/planar_geometry.hpp"
#include "tests/unit/common/messages/map_values.hpp"

namespace adit {
namespace {

using test::kNaN;
using test::kUtime;
using test::local_map;
using test::round_trip;

LocalMapFragment fragment() { return {test::local_map(7, 3), 4, 1}; }

std::string_view rejection_after(const std::function<void(local_map_t&)>& change) {
  local_map_t message = to_message(fragment());
  change(message);
  return from_message(message).rejection();
}

TEST(LocalMapMessage, SurvivesARoundTrip) { EXPECT_EQ(*round_trip(fragment()), fragment()); }

TEST(LocalMapMessage, KeepsTheUnconfirmedBeamsOfEachScan) {
  LocalMapFragment strange = fragment();
  strange.part.scans[0].unconfirmed_beams = {0, 7, 180};
  strange.part.scans[2].unconfirmed_beams = {90};
  EXPECT_EQ(*round_trip(strange), strange);
  EXPECT_EQ(to_message(strange).scans[0].n_unconfirmed_beams, 3);
}

TEST(LocalMapMessage, MayHaveNoScans) {
  const LocalMapFragment empty{test::local_map(0, 1), 1, 0};
  EXPECT_EQ(*round_trip(empty), empty);
}

TEST(LocalMapMessage, PreservesNanReadings) {
  LocalMapFragment strange = fragment();
  strange.part.scans[0].scan.ranges_m[1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isnan(round_trip(strange)->part.scans[0].scan.ranges_m[1]));
}

TEST(LocalMapMessage, StoresItsInformationRowByRow) {
  EXPECT_EQ(to_message(fragment()).information[0][2], 5.0);
  EXPECT_EQ(to_message(fragment()).information[1][2], -7.0);
}

TEST(LocalMapMessage, IsRejectedWithInvalidTimes) {
  EXPECT_EQ(rejection_after([](local_map_t& map) { map.utime = -1; }), kImplausibleTime);
  EXPECT_EQ(rejection_after([](local_map_t& map) { map.end_utime = INT64_MAX; }), kImplausibleTime);
  EXPECT_EQ(rejection_after([](local_map_t& map) { map.end_utime = map.utime - 1; }),
            "end time before start time");
}

TEST(LocalMapMessage, IsRejectedWithInvalidNumbers) {
  EXPECT_EQ(rejection_after([](local_map_t& map) { map.id = -1; }), "negative id or session");
  EXPECT_EQ(rejection_after([](local_map_t& map) { map.session = -1; }), "negative id or session");
  EXPECT_EQ(rejection_after([](local_map_t& map) { map.T_odom_local[1] = kNaN; }),
            kImplausiblePosition);
  EXPECT_EQ(rejection_after([](local_map_t& map) { map.T_previous_local[2] = kNaN; }),
            kImplausibleHeading);
}

TEST(LocalMapMessage, IsRejectedWithInvalidInformation) {
  EXPECT_EQ(rejection_after([](local_map_t& map) { map.information[2][2] = -1.0; }),
            kInvalidInformation);
  EXPECT_EQ(rejection_after([](local_map_t& map) { map.information[0][1] = 25.0; }),
            kInvalidInformation);
  EXPECT_EQ(rejection_after([](local_map_t& map) { map.information[1][0] = kNaN; }),
            kInvalidInformation);
  EXPECT_EQ(rejection_after([](local_map_t& map) {
              map.information[0][1] = map.information[1][0] = 350.0;  // more than sqrt(400 * 300)
            }),
            kInvalidInformation);
}

TEST(LocalMapMessage, IsRejectedWithAnInvalidFragmentIndex) {
  EXPECT_EQ(rejection_after([](local_map_t& map) { map.n_fragments = 0; }), "no fragments");
  EXPECT_EQ(rejection_after([](local_map_t& map) { map.n_fragments = 1'000'000; }),
            "implausible number of fragments");
  EXPECT_EQ(rejection_after([](local_map_t& map) { map.fragment = 4; }),
            "fragment index out of range");
  EXPECT_EQ(rejection_after([](local_map_t& map) { map.fragment = -1; }),
            "fragment index out of range");
}

TEST(LocalMapMessage, IsRejectedIfTooLarge) {
  EXPECT_EQ(round_trip(LocalMapFragment{test::local_map(7, 1500), 1, 0}).rejection(),
            "fragment too large");
}

TEST(LocalMapMessage, IsRejectedWithInvalidScans) {
  EXPECT_EQ(rejection_after([](local_map_t& map) { map.scans[1].angle_step_rad = 0.0; }),
            "bearings do not increase");
  EXPECT_EQ(rejection_after([](local_map_t& map) { map.scans[1].angle_min_rad = kNaN; }),
            "implausible first bearing");
  EXPECT_EQ(rejection_after([](local_map_t& map) { map.scans[1].T_local_body[0] = kNaN; }),
            kImplausiblePosition);
  EXPECT_EQ(rejection_after([](local_map_t& map) { map.scans[1].utime = kUtime - 1; }),
            "scan outside the time range of its local map");
}

constexpr int kScans = 200;  // of 181 beams: three fragments

std::optional<LocalMap> add_all(LocalMapReassembler& reassembler,
                                const std::vector<LocalMapFragment>& fragments) {
  std::optional<LocalMap> last;
  for (const LocalMapFragment& fragment : fragments) {
    EXPECT_FALSE(last);  // complete only with the last fragment
    last = reassembler.add(fragment);
  }
  return last;
}

TEST(LocalMapFragments, FillTheSizeLimit) {
  const auto fragments = split(local_map(7, kScans));
  ASSERT_EQ(fragments.size(), 3U);
  for (const LocalMapFragment& fragment : fragments) {
    const auto bytes = encode(to_message(fragment)).size();
    EXPECT_LE(bytes, kFragmentBytes);
    if (&fragment != &fragments.back()) {
      EXPECT_GT(bytes, kFragmentBytes - 1000);  // size of a scan
    }
  }
}

TEST(LocalMapFragments, FillTheSizeLimitWithUnconfirmedBeamsToo) {
  LocalMap map = local_map(7, kScans);
  for (LocalScan& local : map.scans) {
    local.unconfirmed_beams.resize(local.scan.ranges_m.size());
    std::iota(local.unconfirmed_beams.begin(), local.unconfirmed_beams.end(), 0);
  }
  const auto fragments = split(map);
  EXPECT_GT(fragments.size(), split(local_map(7, kScans)).size());
  LocalMapReassembler reassembler;
  for (const LocalMapFragment& fragment : fragments) {
    const auto bytes = encode(to_message(fragment)).size();
    EXPECT_LE(bytes, kFragmentBytes);
    if (&fragment == &fragments.back()) {
      EXPECT_EQ(reassembler.add(fragment), map);
    } else {
      EXPECT_GT(bytes, kFragmentBytes - 1300);  // size of a scan
      EXPECT_FALSE(reassembler.add(fragment));
    }
  }
}

TEST(LocalMapFragments, AreReproducible) {
  EXPECT_EQ(split(local_map(7, kScans)), split(local_map(7, kScans)));
}

TEST(LocalMapFragments, AreOneForALocalMapWithoutScans) {
  LocalMap map = local_map(7, 1);
  map.scans.clear();
  LocalMapReassembler reassembler;
  EXPECT_EQ(add_all(reassembler, split(map)), map);
}

TEST(LocalMapFragments, GiveAnOversizedScanItsOwnFragment) {
  LocalMap map = local_map(7, 3);
  map.scans[1].scan.ranges_m.resize(20'000, 1.0F);
  map.scans[1].scan.angle_step_rad = 1e-4;
  const auto fragments = split(map);
  EXPECT_EQ(fragments.size(), 3U);
  for (const LocalMapFragment& fragment : fragments) EXPECT_TRUE(test::round_trip(fragment));
}

TEST(LocalMapReassembler, ReassemblesFragmentsInAnyOrder) {
  const LocalMap map = local_map(7, kScans);
  std::vector<LocalMapFragment> fragments = split(map);
  std::vector<int> order = {0, 1, 2};
  do {
    LocalMapReassembler reassembler;
    std::vector<LocalMapFragment> shuffled;
    for (const int i : order) shuffled.push_back(fragments[static_cast<std::size_t>(i)]);
    EXPECT_EQ(add_all(reassembler, shuffled), map);
    EXPECT_EQ(reassembler.incomplete(), 0U);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(LocalMapReassembler, ReassemblesSeveralIdsInParallel) {
  const auto a = split(local_map(7, kScans));
  const auto b = split(local_map(8, kScans));
  LocalMapReassembler reassembler;
  for (std::size_t i : {0U, 1U}) {
    EXPECT_FALSE(reassembler.add(a[i]));
    EXPECT_FALSE(reassembler.add(b[i]));
  }
  EXPECT_EQ(reassembler.add(b[2])->id, 8);
  EXPECT_EQ(reassembler.add(a[2])->id, 7);
  EXPECT_EQ(reassembler.counts().reassembled, 2);
}

TEST(LocalMapReassembler, CountsDuplicates) {
  const auto fragments = split(local_map(7, kScans));
  LocalMapReassembler reassembler;
  reassembler.add(fragments[0]);
  EXPECT_FALSE(reassembler.add(fragments[0]));
  EXPECT_EQ(reassembler.counts().duplicates, 1);
  reassembler.add(fragments[1]);
  EXPECT_TRUE(reassembler.add(fragments[2]));
}

TEST(LocalMapReassembler, ReplacesAnIncompleteMapByANewerRevision) {
  const auto older = split(local_map(7, kScans));
  const LocalMap newer = local_map(7, kScans + 1);
  const auto fragments = split(newer);
  LocalMapReassembler reassembler;
  reassembler.add(older[0]);
  reassembler.add(fragments[0]);
  EXPECT_FALSE(reassembler.add(older[1]));
  reassembler.add(fragments[1]);
  EXPECT_EQ(reassembler.add(fragments[2]), newer);
  EXPECT_EQ(reassembler.counts().superseded, 1);
  EXPECT_EQ(reassembler.counts().outdated, 1);
}

TEST(LocalMapReassembler, RejectsAFragmentWithAnotherHeader) {
  const LocalMap map = local_map(7, kScans);
  auto fragments = split(map);
  LocalMapFragment other = fragments[1];
  other.part.T_odom_local.x += 1.0;
  LocalMapFragment of_more = fragments[1];
  of_more.n_fragments = 4;
  LocalMapReassembler reassembler;
  reassembler.add(fragments[0]);
  EXPECT_FALSE(reassembler.add(other));
  EXPECT_FALSE(reassembler.add(of_more));
  EXPECT_EQ(reassembler.counts().contradictory, 2);
  reassembler.add(fragments[1]);
  EXPECT_EQ(reassembler.add(fragments[2]), map);
}

TEST(LocalMapReassembler, AbandonsTheOldestBeyondTheLimit) {
  LocalMapReassembler reassembler({2, 64'000'000});
  for (const int id : {1, 2, 3}) reassembler.add(split(local_map(id, kScans))[0]);
  EXPECT_EQ(reassembler.incomplete(), 2U);
  EXPECT_EQ(reassembler.counts().abandoned, 1);
  const auto third = split(local_map(3, kScans));
  reassembler.add(third[1]);
  EXPECT_TRUE(reassembler.add(third[2]));
}

TEST(LocalMapReassembler, RespectsTheByteLimit) {
  LocalMapReassembler reassembler({100, 200'000});
  for (int id = 0; id < 100; ++id) reassembler.add(split(local_map(id, kScans))[0]);
  EXPECT_LE(reassembler.incomplete(), 4U);  // of about 60 kB
  EXPECT_GE(reassembler.incomplete(), 2U);
}

}  // namespace
}  // namespace adit
