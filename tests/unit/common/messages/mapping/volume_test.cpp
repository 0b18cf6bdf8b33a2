// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mapping/volume.hpp"

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "common/messages/fields/quantities.hpp"
#include "common/messages/planar_geometry.hpp"
#include "tests/unit/common/messages/map_values.hpp"

namespace adit {
namespace {

using test::kNaN;
using test::kUtime;

/// A full tree: nodes above depth 0 have eight children; nodes at depth 0 have a free and an
/// occupied one.
void grow(int depth, std::vector<std::uint8_t>& octree) {
  const bool last = depth == 0;
  octree.push_back(last ? 0x09 : 0xFF);
  octree.push_back(last ? 0x00 : 0xFF);
  for (int i = 0; !last && i < 8; ++i) grow(depth - 1, octree);
}

Volume volume(int depth = 5) {
  Volume volume{kUtime, 4, 2, 12, 7, {12.0, -3.0, 0.7}, 0.1, 0, 0, {}, -2.5};
  grow(depth, volume.octree);
  const OctreeCounts counts = count_cells(volume.octree);
  volume.occupied = counts.occupied;
  volume.free = counts.free;
  return volume;
}

std::string_view rejection_after(const std::function<void(volume_t&)>& change) {
  volume_t message = to_message(split(volume(1)).front());
  change(message);
  return from_message(message).rejection();
}

TEST(VolumeFragments, AreReassembledInAnyOrder) {
  const Volume sent = volume();
  auto fragments = split(sent);
  EXPECT_EQ(fragments.size(), 2U);  // 37,449 nodes of 2 bytes
  std::reverse(fragments.begin(), fragments.end());
  VolumeReassembler reassembler;
  std::optional<Volume> received;
  for (const VolumeFragment& fragment : fragments) {
    EXPECT_LE(encode(to_message(fragment)).size(), kFragmentBytes);
    EXPECT_FALSE(received);
    received = reassembler.add(*test::round_trip(fragment));
  }
  ASSERT_TRUE(received);
  EXPECT_EQ(received->utime, sent.utime);
  EXPECT_EQ(received->id, sent.id);
  EXPECT_EQ(received->revision, sent.revision);
  EXPECT_EQ(received->graph_revision, sent.graph_revision);
  EXPECT_EQ(received->local_map, sent.local_map);
  EXPECT_EQ(received->T_map_volume, sent.T_map_volume);
  EXPECT_EQ(received->z_map_m, sent.z_map_m);
  EXPECT_EQ(received->cell_m, sent.cell_m);
  EXPECT_EQ(received->occupied, sent.occupied);
  EXPECT_EQ(received->free, sent.free);
  EXPECT_EQ(received->octree, sent.octree);
}

TEST(VolumeFragments, AreOneForAVolumeWithoutCells) {
  Volume nothing = volume();
  nothing.octree.clear();
  nothing.occupied = nothing.free = 0;
  const auto fragments = split(nothing);
  ASSERT_EQ(fragments.size(), 1U);
  EXPECT_FALSE(is_pose_only(fragments[0]));
  EXPECT_TRUE(VolumeReassembler().add(*test::round_trip(fragments[0])));
}

TEST(VolumeFragments, MayBePoseOnly) {
  const Volume sent = volume();
  const VolumeFragment fragment = *test::round_trip(pose_only(sent));
  EXPECT_TRUE(is_pose_only(fragment));
  EXPECT_EQ(fragment.part.T_map_volume, sent.T_map_volume);
  EXPECT_TRUE(fragment.part.octree.empty());
  EXPECT_EQ(fragment.part.z_map_m, sent.z_map_m);
  EXPECT_LT(encode(to_message(fragment)).size(), 128U);
}

TEST(VolumeMessage, IsRejectedWithAnInvalidHeader) {
  using Message = volume_t;
  EXPECT_EQ(rejection_after([](Message& m) { m.utime = -1; }), kImplausibleTime);
  EXPECT_EQ(rejection_after([](Message& m) { m.id = -1; }), "negative id");
  EXPECT_EQ(rejection_after([](Message& m) { m.local_map = -1; }), "negative id");
  EXPECT_EQ(rejection_after([](Message& m) { m.revision = 0; }), "revision without a cloud");
  EXPECT_EQ(rejection_after([](Message& m) { m.graph_revision = -1; }), "negative revision");
  EXPECT_EQ(rejection_after([](Message& m) { m.T_map_volume[2] = kNaN; }), kImplausibleHeading);
  EXPECT_EQ(rejection_after([](Message& m) { m.z_map_m = kNaN; }), kImplausibleHeight);
  for (const double cell : {kNaN, 0.0, -0.1, 11.0}) {
    EXPECT_EQ(rejection_after([cell](Message& m) { m.cell_m = cell; }), "implausible cell size");
  }
  EXPECT_EQ(rejection_after([](Message& m) { m.free = -1; }), "negative number of cells");
}

TEST(VolumeMessage, IsRejectedWithAnInvalidFragment) {
  using Message = volume_t;
  EXPECT_EQ(rejection_after([](Message& m) { m.n_fragments = -1; }),
            "implausible number of fragments");
  EXPECT_EQ(rejection_after([](Message& m) { m.n_fragments = 101; }),
            "implausible number of fragments");
  EXPECT_EQ(rejection_after([](Message& m) { m.n_fragments = 0; }),
            "octree in a pose-only message");
  for (const std::int32_t fragment : {-1, 1}) {
    EXPECT_EQ(rejection_after([fragment](Message& m) { m.fragment = fragment; }),
              "fragment index out of range");
  }
  EXPECT_EQ(rejection_after([](Message& m) {
              m.n_bytes = 1'000'000;
              m.octree.resize(1'000'000);
            }),
            "fragment too large");
}

TEST(VolumeReassembler, RejectsAnInvalidOctree) {
  auto fragments = split(volume(1));
  fragments[0].part.octree.pop_back();
  VolumeReassembler reassembler;
  EXPECT_FALSE(reassembler.add(fragments[0]));
  EXPECT_EQ(reassembler.counts().abandoned, 1);
}

TEST(VolumeReassembler, RejectsAnOctreeWithOtherCellCounts) {
  auto fragments = split(volume(1));
  ++fragments[0].part.occupied;
  VolumeReassembler reassembler;
  EXPECT_FALSE(reassembler.add(fragments[0]));
  EXPECT_EQ(reassembler.counts().abandoned, 1);
}

}  // namespace
}  // namespace adit
