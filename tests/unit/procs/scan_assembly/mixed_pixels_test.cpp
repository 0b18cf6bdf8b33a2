// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/mixed_pixels.hpp"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "tests/unit/procs/scan_assembly/sweeping_robot.hpp"

namespace adit {
namespace {

using test::assembly_params;
using test::perfect_laser;
using test::SweepingRobot;

constexpr float kNoReturn = std::numeric_limits<float>::infinity();

int removed_count(RangeImage image, int turns = 1) {
  const RangeImage before = image;
  remove_mixed_pixels(image, turns, {});
  int n = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    for (std::size_t j = 0; j < image[i].size(); ++j) {
      n += std::isnan(image[i][j]) && !std::isnan(before[i][j]) ? 1 : 0;
    }
  }
  return n;
}

TEST(MixedPixelFilter, RemovesReturnsBetweenTwoSurfacesEvenAboveEachOther) {
  const std::vector<float> row{3.0F, 3.0F, 3.0F, 3.2F, 3.4F, 3.4F, 3.4F};
  EXPECT_EQ(removed_count({row}), 1);
  EXPECT_EQ(removed_count({row, row, row}), 3);
}

TEST(MixedPixelFilter, KeepsAStepBetweenTwoSurfaces) {
  const std::vector<float> row{3.0F, 3.0F, 3.0F, 3.4F, 3.4F, 3.4F};
  EXPECT_EQ(removed_count({row, row, row}), 0);
}

TEST(MixedPixelFilter, KeepsAWallAtGrazingIncidence) {
  std::vector<float> row;
  for (int i = 0; i < 40; ++i)
    row.push_back(2.0F / std::sin(0.05F + 0.0087F * static_cast<float>(i)));
  EXPECT_GT(row[0] - row[1], 1.0F);
  EXPECT_EQ(removed_count({row, row, row}), 0);
}

TEST(MixedPixelFilter, KeepsFloorThatIsScannedInTwoTurnsOfTheMirror) {
  std::vector<float> row;
  for (int i = 0; i < 40; ++i) {
    const float bearing = 0.9F + 0.0087F * static_cast<float>(i);
    const float distance = i % 2 == 0 ? 3.0F : 2.9F;  // by turn of the mirror
    row.push_back(distance / std::cos(bearing));
  }
  EXPECT_EQ(removed_count({row, row, row}, 2), 0);
}

TEST(MixedPixelFilter, KeepsThinObjectsInSeveralScansAndRemovesThoseInOne) {
  const std::vector<float> cable{6.0F, 6.0F, 4.0F, 6.0F, 6.0F};
  const std::vector<float> wall(5, 6.0F);
  EXPECT_EQ(removed_count({wall, cable, cable, wall}), 0);
  EXPECT_EQ(removed_count({wall, cable, wall}), 1);
}

TEST(MixedPixelFilter, KeepsAnInclinedCable) {
  RangeImage image;
  for (std::size_t i = 0; i < 8; ++i) {
    image.emplace_back(12, kNoReturn)[2 + i] = 4.0F + 0.02F * static_cast<float>(i);
  }
  EXPECT_EQ(removed_count(image), 0);
}

TEST(MixedPixelFilter, AcceptsRowsOfAnyLength) {
  EXPECT_EQ(removed_count({}), 0);
  EXPECT_EQ(removed_count({{}, {1.0F}, {1.0F, 2.0F, 1.0F}, {}}), 0 + 1);
}

constexpr double kPost = 4.0;    // from the origin to its face [m]
constexpr double kWall = 4.4;    // less than a pulse length behind it
constexpr double kCableY = 0.8;  // across [m]

/// A post and a cable of 3 cm in front of a wall.
World post_and_cable() {
  return box_tunnel({40.0, 40.0, 2.0}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kPost, Material::kRock, "post");
    builder.box(level_box({kPost + 0.1, 0.0, 1.0}, {0.2, 0.2, 2.0}));
    builder.begin_part(PartKind::kWall, Material::kRock, "wall");
    builder.box(level_box({kWall + 0.5, 0.0, 1.0}, {1.0, 10.0, 2.0}));
    builder.begin_part(PartKind::kPost, Material::kRock, "cable");
    builder.bar({kPost, kCableY, 0.0}, {kPost - 0.2, kCableY + 0.3, 2.0}, 0.015);
  });
}

struct Counts {
  int mixed = 0;  ///< between the face of the post and the wall, beside the post
  int cable = 0;  ///< within 4 cm of its axis
  std::size_t all = 0;
};

Counts count(int support_min) {
  LaserParams laser = perfect_laser();
  laser.subrays = 9;
  laser.noise_sd_m = 0.005;
  SweepingRobot robot(post_and_cable(), laser);
  ScanAssemblyParams params = assembly_params();
  params.mixed_pixels.support_min = support_min;
  ScanAssembly assembly(params);
  const Cloud cloud = robot.sweep(assembly).value();
  const Eigen::Vector3f foot(kPost, kCableY, 0.0F);
  const Eigen::Vector3f along = Eigen::Vector3f(-0.2F, 0.3F, 2.0F).normalized();
  Counts counts;
  counts.all = cloud.points();
  for (const CloudLine& line : cloud.lines) {
    for (const Eigen::Vector3f& p : line.points) {
      const bool beside = std::abs(p.y()) < 0.3F && p.z() > 0.05F && p.z() < 1.95F;
      if (beside && p.x() > kPost + 0.08 && p.x() < kWall - 0.08) ++counts.mixed;
      if ((p - foot).cross(along).norm() < 0.04F) ++counts.cable;
    }
  }
  return counts;
}

TEST(MixedPixelFilter, ClearsTheEdgesOfAPostAndKeepsACable) {
  const Counts before = count(0);  // nothing is removed
  const Counts after = count(1);
  EXPECT_GT(before.mixed, 40);
  EXPECT_LE(after.mixed, before.mixed / 10);
  EXPECT_GT(before.cable, 40);
  EXPECT_GE(after.cable, before.cable * 8 / 10);
  EXPECT_GT(after.all, before.all * 99 / 100);
}

}  // namespace
}  // namespace adit
