// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mapping/pose_graph.hpp"

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "common/messages/fields/quantities.hpp"
#include "common/messages/planar_geometry.hpp"
#include "tests/unit/common/messages/map_values.hpp"

namespace adit {
namespace {

using test::information;
using test::kNaN;
using test::kUtime;

/// A chain of local maps with a loop closure at every hundredth.
MapGraph graph(int nodes, std::int64_t revision = 5) {
  MapGraph result{kUtime, revision, {}, {}};
  for (int i = 0; i < nodes; ++i) {
    result.poses.push_back({5.0 * i, 0.1 * i, 0.001 * i});
    result.z_m.push_back(0.01 * i);
    result.z_variance.push_back(1e-4 * i);
    if (i > 0) {
      const PoseConstraint measured{i - 1, i, {5.0, 0.1, 0.001 * i}, information()};
      result.constraints.push_back({measured, MapConstraint::Kind::kSequential});
    }
    if (i % 100 == 99) {
      const PoseConstraint measured{i, i - 99, {0.5, 0.1, 0.001 * i}, information()};
      result.constraints.push_back({measured, MapConstraint::Kind::kLoopClosure});
    }
  }
  return result;
}

/// The encoded fragments, which compare all bits.
std::vector<std::vector<std::uint8_t>> bytes_of(const MapGraph& graph) {
  std::vector<std::vector<std::uint8_t>> bytes;
  for (const PoseGraphFragment& fragment : split(graph))
    bytes.push_back(encode(to_message(fragment)));
  return bytes;
}

std::string_view rejection_after(const std::function<void(pose_graph_t&)>& change) {
  pose_graph_t message = to_message(split(graph(3)).front());
  change(message);
  return from_message(message).rejection();
}

TEST(PoseGraphFragments, FitTheSizeLimit) {
  const auto fragments = bytes_of(graph(10'000));
  EXPECT_LT(fragments.size(), 30U);
  for (const auto& bytes : fragments) EXPECT_LE(bytes.size(), kFragmentBytes);
}

TEST(PoseGraphFragments, AreReassembledInAnyOrder) {
  const MapGraph sent = graph(10'000);
  auto messages = bytes_of(sent);
  std::rotate(messages.begin(), messages.begin() + 7, messages.end());
  std::swap(messages.front(), messages.back());
  PoseGraphReassembler reassembler;
  std::optional<MapGraph> received;
  for (const auto& bytes : messages) {
    EXPECT_FALSE(received);
    received = reassembler.add(*from_message(*decode<pose_graph_t>(bytes)));
  }
  ASSERT_TRUE(received);
  EXPECT_EQ(bytes_of(*received), bytes_of(sent));
}

TEST(PoseGraphFragments, AreOneForAnEmptyGraph) {
  const auto fragments = split(MapGraph{kUtime, 0, {}, {}});
  ASSERT_EQ(fragments.size(), 1U);
  EXPECT_TRUE(PoseGraphReassembler().add(*test::round_trip(fragments[0]))->poses.empty());
}

TEST(PoseGraphMessage, IsRejectedWithAnInvalidHeader) {
  using Message = pose_graph_t;
  EXPECT_EQ(rejection_after([](Message& m) { m.utime = -1; }), kImplausibleTime);
  EXPECT_EQ(rejection_after([](Message& m) { m.revision = -1; }), "negative revision");
  EXPECT_EQ(rejection_after([](Message& m) { m.n_nodes = -1; }), "negative number of nodes");
  EXPECT_EQ(rejection_after([](Message& m) { m.n_nodes = 2'000'000; }),
            "implausible number of nodes");
  EXPECT_EQ(rejection_after([](Message& m) { m.n_fragments = 0; }), "no fragments");
  EXPECT_EQ(rejection_after([](Message& m) { m.n_fragments = INT32_MAX; }),
            "implausible number of fragments");
  EXPECT_EQ(rejection_after([](Message& m) { m.fragment = 1; }), "fragment index out of range");
  for (const std::int32_t first : {-1, 1, INT32_MAX}) {
    EXPECT_EQ(rejection_after([&](Message& m) { m.first_node = first; }),
              "poses of nodes outside the graph");
  }
}

TEST(PoseGraphMessage, IsRejectedWithInvalidPosesAndConstraints) {
  using Message = pose_graph_t;
  EXPECT_EQ(rejection_after([](Message& m) { m.poses[1][0] = kNaN; }), kImplausiblePosition);
  EXPECT_EQ(rejection_after([](Message& m) { m.constraints[1].T_from_to[0] = kNaN; }),
            kImplausiblePosition);
  EXPECT_EQ(rejection_after([](Message& m) { m.constraints[1].information[1][1] = -1.0; }),
            kInvalidInformation);
  EXPECT_EQ(rejection_after([](Message& m) { m.constraints[1].kind = 9; }),
            "unknown constraint kind");
  EXPECT_EQ(rejection_after([](Message& m) { m.constraints[1].from = 2; }),
            "constraint of a node with itself");
  for (const std::int32_t node : {-1, 3, INT32_MAX}) {
    EXPECT_EQ(rejection_after([&](Message& m) { m.constraints[1].to = node; }),
              "constraint of a node outside the graph");
  }
}

TEST(PoseGraphReassembler, ReplacesAnIncompleteGraphByANewerOne) {
  const auto older = split(graph(3000, 5));
  const auto newer = split(graph(3000, 6));
  PoseGraphReassembler reassembler;
  reassembler.add(older[0]);
  reassembler.add(newer[0]);
  EXPECT_FALSE(reassembler.add(older[1]));
  std::optional<MapGraph> last;
  for (std::size_t i = 1; i < newer.size(); ++i) last = reassembler.add(newer[i]);
  EXPECT_EQ(last->revision, 6);
  EXPECT_EQ(reassembler.counts(), (PoseGraphReassembler::Counts{1, 0, 0, 1, 1, 0}));
}

TEST(PoseGraphReassembler, CountsDuplicateAndContradictoryFragments) {
  const auto fragments = split(graph(3000));
  PoseGraphReassembler reassembler;
  reassembler.add(fragments[0]);
  EXPECT_FALSE(reassembler.add(fragments[0]));
  PoseGraphFragment other = fragments[1];
  other.n_fragments += 1;
  EXPECT_FALSE(reassembler.add(other));
  EXPECT_EQ(reassembler.counts().duplicates, 1);
  EXPECT_EQ(reassembler.counts().contradictory, 1);
}

TEST(PoseGraphReassembler, RejectsAGraphWithMissingPoses) {
  auto fragments = split(graph(3));
  fragments[0].poses.pop_back();
  PoseGraphReassembler reassembler;
  EXPECT_FALSE(reassembler.add(fragments[0]));
  EXPECT_EQ(reassembler.counts().abandoned, 1);
}

TEST(PoseGraphReassembler, RespectsTheByteLimit) {
  PoseGraphReassembler reassembler({.incomplete = 1, .bytes = 1000});
  EXPECT_FALSE(reassembler.add(split(graph(3000))[0]));
  EXPECT_EQ(reassembler.counts().abandoned, 1);
}

}  // namespace
}  // namespace adit
