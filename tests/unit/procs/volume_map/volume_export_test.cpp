// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/volume_export.hpp"

#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/procs/volume_map/octomap_reference.hpp"
#include "tests/unit/procs/volume_map/swept_tunnel.hpp"

namespace adit {
namespace {

VolumeMap map_of_two_scans() {
  VolumeMap map{VolumeMapParams{}};
  for (const double x : {0.0, 12.0}) {
    Cloud cloud = test::sweep_of_tunnel({x, 0.0, 0.2}, 20);
    cloud.id = static_cast<std::int32_t>(x);
    map.add(cloud);
  }
  return map;
}

TEST(VolumeExport, WritesEveryPointWithItsScanToPly) {
  const test::ScratchFolder folder;
  const VolumeMap map = map_of_two_scans();
  ASSERT_EQ(map.volumes().size(), 2U);
  write_ply(map, folder / "cloud.ply");
  const std::string ply = test::contents(folder / "cloud.ply");
  const std::size_t n =
      map.volumes()[0].volume.points().size() + map.volumes()[1].volume.points().size();
  const std::string head =
      "ply\nformat binary_little_endian 1.0\ncomment frame map, metres\nelement vertex " +
      std::to_string(n) +
      "\nproperty float x\nproperty float y\nproperty float z\nproperty int scan\nend_header\n";
  ASSERT_THAT(ply, testing::StartsWith(head));
  ASSERT_EQ(ply.size(), head.size() + 16 * n);
  std::array<std::size_t, 2> of_scan{};
  for (std::size_t i = 0; i < n; ++i) {
    std::array<float, 3> p{};
    std::int32_t scan = 0;
    std::memcpy(p.data(), ply.data() + head.size() + 16 * i, 12);
    std::memcpy(&scan, ply.data() + head.size() + 16 * i + 12, 4);
    // On a surface of the tunnel, within half a unit of the laser and single precision.
    const float to_rock =
        std::min({2.0F - std::abs(p[1]), 20.0F - std::abs(p[0]), p[2], 2.0F - p[2]});
    ASSERT_NEAR(to_rock, 0.0, 0.002);
    ASSERT_THAT(scan, testing::AnyOf(0, 12));
    ++of_scan[scan == 0 ? 0 : 1];
  }
  EXPECT_EQ(of_scan[0], map.volumes()[0].volume.points().size());
}

TEST(VolumeExport, WritesFilesThatOctoMapReads) {
  const test::ScratchFolder folder;
  const VolumeMap map = map_of_two_scans();
  export_volume(map, folder.path());
  octomap::OcTree bt(0.5);
  ASSERT_TRUE(bt.readBinary((folder / "volume.bt").string()));
  const std::unique_ptr<octomap::AbstractOcTree> ot(
      octomap::AbstractOcTree::read((folder / "volume.ot").string()));
  auto& tree = dynamic_cast<octomap::OcTree&>(*ot);
  EXPECT_TRUE(test::leaves(tree) == test::leaves(map.merged(), folder / "again.ot"));
  tree.toMaxLikelihood();
  tree.prune();
  EXPECT_TRUE(test::leaves(bt) == test::leaves(tree));
  EXPECT_GT(bt.size(), 1000U);
}

TEST(VolumeExport, ReportsAnUnwritableFile) {
  EXPECT_THROW(write_ply(map_of_two_scans(), "/nonexistent/cloud.ply"), std::runtime_error);
}

}  // namespace
}  // namespace adit
