// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/local_map_pieces.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/unit/common/messages/map_values.hpp"

namespace adit {
namespace {

using test::local_map;

constexpr int kScans = 200;  // of 181 beams: three pieces

std::optional<LocalMap> add_all(LocalMapAssembler& assembler,
                                const std::vector<LocalMapPiece>& pieces) {
  std::optional<LocalMap> last;
  for (const LocalMapPiece& piece : pieces) {
    EXPECT_FALSE(last);  // it is complete with the last piece, not before
    last = assembler.add(piece);
  }
  return last;
}

TEST(LocalMapPieces, AreSmallAndNoneIsSmallerThanItMustBe) {
  const auto pieces = divide(local_map(7, kScans));
  ASSERT_EQ(pieces.size(), 3U);
  for (const LocalMapPiece& piece : pieces) {
    const auto bytes = encode(to_message(piece)).size();
    EXPECT_LE(bytes, kPieceBytes);
    if (&piece != &pieces.back()) {
      EXPECT_GT(bytes, kPieceBytes - 1000);  // a scan takes less
    }
  }
}

TEST(LocalMapPieces, AreTheSameEachTime) {
  EXPECT_EQ(divide(local_map(7, kScans)), divide(local_map(7, kScans)));
}

TEST(LocalMapPieces, OfALocalMapWithoutScansIsOne) {
  LocalMap map = local_map(7, 1);
  map.scans.clear();
  LocalMapAssembler assembler;
  EXPECT_EQ(add_all(assembler, divide(map)), map);
}

TEST(LocalMapPieces, GiveAScanThatIsTooLargeAPieceOfItsOwn) {
  LocalMap map = local_map(7, 3);
  map.scans[1].scan.ranges_m.resize(20'000, 1.0F);
  map.scans[1].scan.angle_step_rad = 1e-4;
  const auto pieces = divide(map);
  EXPECT_EQ(pieces.size(), 3U);
  for (const LocalMapPiece& piece : pieces) EXPECT_TRUE(test::over_the_wire(piece));
}

TEST(LocalMapAssembler, JoinsPiecesInAnyOrder) {
  const LocalMap map = local_map(7, kScans);
  std::vector<LocalMapPiece> pieces = divide(map);
  std::vector<int> order = {0, 1, 2};
  do {
    LocalMapAssembler assembler;
    std::vector<LocalMapPiece> shuffled;
    for (const int i : order) shuffled.push_back(pieces[static_cast<std::size_t>(i)]);
    EXPECT_EQ(add_all(assembler, shuffled), map);
    EXPECT_EQ(assembler.incomplete(), 0U);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(LocalMapAssembler, JoinsSeveralLocalMapsAtOnce) {
  const auto a = divide(local_map(7, kScans));
  const auto b = divide(local_map(8, kScans));
  LocalMapAssembler assembler;
  for (std::size_t i : {0U, 1U}) {
    EXPECT_FALSE(assembler.add(a[i]));
    EXPECT_FALSE(assembler.add(b[i]));
  }
  EXPECT_EQ(assembler.add(b[2])->id, 8);
  EXPECT_EQ(assembler.add(a[2])->id, 7);
  EXPECT_EQ(assembler.counts().joined, 2);
}

TEST(LocalMapAssembler, CountsPiecesThatComeTwice) {
  const auto pieces = divide(local_map(7, kScans));
  LocalMapAssembler assembler;
  assembler.add(pieces[0]);
  EXPECT_FALSE(assembler.add(pieces[0]));
  EXPECT_EQ(assembler.counts().duplicates, 1);
  assembler.add(pieces[1]);
  EXPECT_TRUE(assembler.add(pieces[2]));
}

TEST(LocalMapAssembler, DropsWhatIsIncompleteForANewerRevision) {
  const auto older = divide(local_map(7, kScans));
  const LocalMap newer = local_map(7, kScans + 1);
  const auto pieces = divide(newer);
  LocalMapAssembler assembler;
  assembler.add(older[0]);
  assembler.add(pieces[0]);
  EXPECT_FALSE(assembler.add(older[1]));
  assembler.add(pieces[1]);
  EXPECT_EQ(assembler.add(pieces[2]), newer);
  EXPECT_EQ(assembler.counts().superseded, 1);
  EXPECT_EQ(assembler.counts().outdated, 1);
}

TEST(LocalMapAssembler, RefusesAPieceWithAnotherHead) {
  const LocalMap map = local_map(7, kScans);
  auto pieces = divide(map);
  LocalMapPiece other = pieces[1];
  other.part.T_odom_local.x += 1.0;
  LocalMapPiece of_more = pieces[1];
  of_more.n_pieces = 4;
  LocalMapAssembler assembler;
  assembler.add(pieces[0]);
  EXPECT_FALSE(assembler.add(other));
  EXPECT_FALSE(assembler.add(of_more));
  EXPECT_EQ(assembler.counts().contradictory, 2);
  assembler.add(pieces[1]);
  EXPECT_EQ(assembler.add(pieces[2]), map);
}

TEST(LocalMapAssembler, GivesUpTheOldestWhereTooManyAreIncomplete) {
  LocalMapAssembler assembler({2, 64'000'000});
  for (const int id : {1, 2, 3}) assembler.add(divide(local_map(id, kScans))[0]);
  EXPECT_EQ(assembler.incomplete(), 2U);
  EXPECT_EQ(assembler.counts().given_up, 1);
  const auto third = divide(local_map(3, kScans));
  assembler.add(third[1]);
  EXPECT_TRUE(assembler.add(third[2]));
}

TEST(LocalMapAssembler, HoldsNoMoreBytesThanItMay) {
  LocalMapAssembler assembler({100, 200'000});
  for (int id = 0; id < 100; ++id) assembler.add(divide(local_map(id, kScans))[0]);
  EXPECT_LE(assembler.incomplete(), 4U);  // of about 60 kB
  EXPECT_GE(assembler.incomplete(), 2U);
}

}  // namespace
}  // namespace adit
