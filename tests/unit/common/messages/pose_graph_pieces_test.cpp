// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/pose_graph_pieces.hpp"

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "common/messages/planar.hpp"
#include "tests/unit/common/messages/map_values.hpp"

namespace adit {
namespace {

using test::information;
using test::kNaN;
using test::kUtime;

/// A way of so many local maps, with a closure at every hundredth.
MapGraph graph(int nodes, std::int64_t revision = 5) {
  MapGraph result{kUtime, revision, {}, {}};
  for (int i = 0; i < nodes; ++i) {
    result.poses.push_back({5.0 * i, 0.1 * i, 0.001 * i});
    if (i > 0) {
      const PoseConstraint measured{i - 1, i, {5.0, 0.1, 0.001 * i}, information()};
      result.constraints.push_back({measured, MapConstraint::Kind::kSequential});
    }
    if (i % 100 == 99) {
      const PoseConstraint measured{i, i - 99, {0.5, 0.1, 0.001 * i}, information()};
      result.constraints.push_back({measured, MapConstraint::Kind::kClosure});
    }
  }
  return result;
}

/// Their bits, which is more than equality.
std::vector<std::vector<std::uint8_t>> bytes_of(const MapGraph& graph) {
  std::vector<std::vector<std::uint8_t>> bytes;
  for (const PoseGraphPiece& piece : divide(graph)) bytes.push_back(encode(to_message(piece)));
  return bytes;
}

std::string_view refusal_after(const std::function<void(pose_graph_t&)>& change) {
  pose_graph_t message = to_message(divide(graph(3)).front());
  change(message);
  return from_message(message).refusal();
}

TEST(PoseGraphPieces, OfTenThousandLocalMapsAreAllSmall) {
  const auto pieces = bytes_of(graph(10'000));
  EXPECT_LT(pieces.size(), 30U);
  for (const auto& bytes : pieces) EXPECT_LE(bytes.size(), kPieceBytes);
}

TEST(PoseGraphPieces, GoOverTheWireAndAreJoinedInAnyOrder) {
  const MapGraph sent = graph(10'000);
  auto messages = bytes_of(sent);
  std::rotate(messages.begin(), messages.begin() + 7, messages.end());
  std::swap(messages.front(), messages.back());
  PoseGraphAssembler assembler;
  std::optional<MapGraph> received;
  for (const auto& bytes : messages) {
    EXPECT_FALSE(received);
    received = assembler.add(*from_message(*decode<pose_graph_t>(bytes)));
  }
  ASSERT_TRUE(received);
  EXPECT_EQ(bytes_of(*received), bytes_of(sent));
}

TEST(PoseGraphPieces, OfAnEmptyGraphIsOne) {
  const auto pieces = divide(MapGraph{kUtime, 0, {}, {}});
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_TRUE(PoseGraphAssembler().add(*test::over_the_wire(pieces[0]))->poses.empty());
}

TEST(PoseGraphMessage, IsRefusedWithAPlaceThatCannotBe) {
  using Message = pose_graph_t;
  EXPECT_EQ(refusal_after([](Message& m) { m.utime = -1; }), kImplausibleTime);
  EXPECT_EQ(refusal_after([](Message& m) { m.revision = -1; }), "negative revision");
  EXPECT_EQ(refusal_after([](Message& m) { m.n_nodes = -1; }), "negative number of nodes");
  EXPECT_EQ(refusal_after([](Message& m) { m.n_nodes = 2'000'000; }), "more nodes than plausible");
  EXPECT_EQ(refusal_after([](Message& m) { m.n_pieces = 0; }), "no pieces");
  EXPECT_EQ(refusal_after([](Message& m) { m.n_pieces = INT32_MAX; }),
            "more pieces than plausible");
  EXPECT_EQ(refusal_after([](Message& m) { m.piece = 1; }), "piece of a higher number");
  for (const std::int32_t first : {-1, 1, INT32_MAX}) {
    EXPECT_EQ(refusal_after([&](Message& m) { m.first_node = first; }),
              "poses of nodes that are not in the graph");
  }
}

TEST(PoseGraphMessage, IsRefusedWithPosesAndConstraintsThatMeanNothing) {
  using Message = pose_graph_t;
  EXPECT_EQ(refusal_after([](Message& m) { m.poses[1][0] = kNaN; }), kPoseNotFinite);
  EXPECT_EQ(refusal_after([](Message& m) { m.constraints[1].T_from_to[0] = kNaN; }),
            kPoseNotFinite);
  EXPECT_EQ(refusal_after([](Message& m) { m.constraints[1].information[1][1] = -1.0; }),
            kNoInformation);
  EXPECT_EQ(refusal_after([](Message& m) { m.constraints[1].kind = 9; }),
            "constraint of an unknown kind");
  EXPECT_EQ(refusal_after([](Message& m) { m.constraints[1].from = 2; }),
            "constraint of a node with itself");
  for (const std::int32_t node : {-1, 3, INT32_MAX}) {
    EXPECT_EQ(refusal_after([&](Message& m) { m.constraints[1].to = node; }),
              "constraint of a node that is not there");
  }
}

TEST(PoseGraphAssembler, DropsWhatIsIncompleteForANewerGraph) {
  const auto older = divide(graph(3000, 5));
  const auto newer = divide(graph(3000, 6));
  PoseGraphAssembler assembler;
  assembler.add(older[0]);
  assembler.add(newer[0]);
  EXPECT_FALSE(assembler.add(older[1]));
  std::optional<MapGraph> last;
  for (std::size_t i = 1; i < newer.size(); ++i) last = assembler.add(newer[i]);
  EXPECT_EQ(last->revision, 6);
  EXPECT_EQ(assembler.counts(), (PoseGraphAssembler::Counts{1, 0, 0, 1, 1, 0}));
}

TEST(PoseGraphAssembler, CountsPiecesThatComeTwiceOrDoNotBelong) {
  const auto pieces = divide(graph(3000));
  PoseGraphAssembler assembler;
  assembler.add(pieces[0]);
  EXPECT_FALSE(assembler.add(pieces[0]));
  PoseGraphPiece other = pieces[1];
  other.n_pieces += 1;
  EXPECT_FALSE(assembler.add(other));
  EXPECT_EQ(assembler.counts().duplicates, 1);
  EXPECT_EQ(assembler.counts().contradictory, 1);
}

TEST(PoseGraphAssembler, RefusesAGraphThatLacksPoses) {
  auto pieces = divide(graph(3));
  pieces[0].poses.pop_back();
  PoseGraphAssembler assembler;
  EXPECT_FALSE(assembler.add(pieces[0]));
  EXPECT_EQ(assembler.counts().given_up, 1);
}

TEST(PoseGraphAssembler, HoldsNoMoreBytesThanItMay) {
  PoseGraphAssembler assembler(1000);
  EXPECT_FALSE(assembler.add(divide(graph(3000))[0]));
  EXPECT_EQ(assembler.counts().given_up, 1);
}

}  // namespace
}  // namespace adit
