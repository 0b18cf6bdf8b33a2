// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "sim/world/build_world.hpp"
#include "sim/world/world_file.hpp"
#include "tests/unit/sim/world/passage.hpp"

namespace adit {
namespace {

const Eigen::Vector3f kUp = Eigen::Vector3f::UnitZ();

const TunnelLine& tunnel(const std::vector<TunnelLine>& tunnels, const std::string& name) {
  return find_tunnel(tunnels, name, "the test");
}

TEST(BuiltInWorlds, AreReproducible) {
  for (const std::string& name : built_in_worlds()) {
    const World first = build_world(find_world(name));
    const World second = build_world(find_world(name));
    EXPECT_EQ(first.mesh.triangles, second.mesh.triangles) << name;
    EXPECT_EQ(first.mesh.vertices, second.mesh.vertices) << name;
    EXPECT_EQ(first.truth.obstacles.size(), second.truth.obstacles.size()) << name;
  }
}

TEST(BuiltInWorlds, HaveRoomForTheVehicleWhereItStarts) {
  for (const std::string& name : built_in_worlds()) {
    const Site site(build_world(find_world(name)));
    const Pose2& start = site.world().T_world_start;
    EXPECT_TRUE(is_free(site, {}, start)) << name;
    const auto floor = site.world().truth.floor_height(start.translation());
    ASSERT_TRUE(floor.has_value()) << name;
    const Eigen::Vector3f above(static_cast<float>(start.x), static_cast<float>(start.y),
                                static_cast<float>(*floor) + 0.5F);
    const auto down = site.scene().cast({above, -kUp}, 5.0F);
    const auto up = site.scene().cast({above, kUp}, 5.0F);
    ASSERT_TRUE(down.has_value() && up.has_value()) << name;
    EXPECT_NEAR(down->distance_m, 0.5, 0.02) << name;  // between the vertices of the mesh
    EXPECT_GE(down->distance_m + up->distance_m, 1.5) << name;
  }
}

class Mathies : public testing::Test {
 protected:
  const WorldDescription description_ = find_world("mathies");
  const std::vector<TunnelLine> tunnels_ = tunnel_lines(description_.plan);
  const Site site_{build_world(description_)};
};

TEST_F(Mathies, HasTheBeam308MetresFromTheStart) {
  const double start_m = description_.T_world_start.x;  // the tunnel begins at the origin, along x
  EXPECT_EQ(description_.props.beams.at(0).at_m - start_m, 308.0);
}

TEST_F(Mathies, LeavesMoreThanTheVehicleNeedsUpToTheBeam) {
  const Body wide{.length_m = 0.5, .width_m = 1.8};
  EXPECT_TRUE(is_passable(site_, wide, tunnel(tunnels_, "main"), 4.0, 306.0));
  EXPECT_TRUE(is_passable(site_, {}, tunnel(tunnels_, "main"), 4.0, 306.0));
}

TEST_F(Mathies, IsImpassableAtTheBeam) {
  EXPECT_FALSE(is_passable(site_, {}, tunnel(tunnels_, "main"), 304.0, 320.0));
}

TEST_F(Mathies, HasFallsInTheCrosscutsBeforeTheBeam) {
  for (int i = 1; i <= 5; ++i) {
    const TunnelLine& crosscut = tunnel(tunnels_, "crosscut_" + std::to_string(i));
    EXPECT_FALSE(is_passable(site_, {}, crosscut, 0.0, crosscut.length_m())) << i;
  }
  const TunnelLine& next = tunnel(tunnels_, "crosscut_6");
  EXPECT_TRUE(is_passable(site_, {}, next, 0.0, next.length_m()));
}

TEST_F(Mathies, ClimbsBy4MetresToTheBeam) {
  const auto& floor = site_.world().truth.floor_height;
  const auto at = [&](double s_m) { return *floor(tunnel(tunnels_, "main").at(s_m).p_world); };
  EXPECT_NEAR(at(312.0) - at(4.0), 4.0, 0.15);  // relief of 4 cm at both; smooth at the ends
}

TEST(Florence, IsClearFor40MetresAndThenUnderWater) {
  const WorldDescription description = find_world("florence");
  const TunnelLine adit = tunnel_lines(description.plan).front();
  const Site site(build_world(description));
  EXPECT_TRUE(is_passable(site, {}, adit, 2.0, 39.0));
  ASSERT_EQ(site.world().water.size(), 1U);
  for (double s_m = 42.0; s_m < 58.0; s_m += 1.0) {
    for (const double across_m : {-1.0, 0.0, 1.0}) {
      const Eigen::Vector2d p = adit.beside(s_m, across_m);
      const Eigen::Vector3f above(static_cast<float>(p.x()), static_cast<float>(p.y()), 1.0F);
      const auto hit = site.scene().cast({above, -kUp}, 5.0F);
      ASSERT_TRUE(hit.has_value());
      EXPECT_EQ(site.scene().mesh().part_of(hit->triangle).kind, PartKind::kWater) << s_m;
    }
  }
}

TEST(Straight, HasWallsWithoutAFeature) {
  const World world = build_world(find_world("straight"));
  Eigen::AlignedBox1f left;
  Eigen::AlignedBox1f right;
  for (std::uint32_t t = 0; t < world.mesh.triangles.size(); ++t) {
    if (world.mesh.part_of(t).kind != PartKind::kWall) continue;
    for (const std::uint32_t v : world.mesh.triangles[t]) {
      const Eigen::Vector3f& p = world.mesh.vertices[v];
      if (p.x() < 0.1F || p.x() > 199.9F) continue;  // the ends
      (p.y() > 0.0F ? left : right).extend(Eigen::Matrix<float, 1, 1>(p.y()));
    }
  }
  EXPECT_NEAR(left.center().value(), 1.6, 0.005);  // the mesh has no edges shorter than that
  EXPECT_NEAR(right.center().value(), -1.6, 0.005);
  EXPECT_LT(left.sizes().value(), 1e-4);  // single precision
  EXPECT_LT(right.sizes().value(), 1e-4);
}

class BrucetonDrive : public testing::Test {
 protected:
  BrucetonDrive() {
    std::ifstream file(ADIT_SOURCE_DIR "/sim/worlds/bruceton_drive.txt");
    for (std::string line; std::getline(file, line);) {
      if (line.empty() || line[0] == '#') continue;
      std::istringstream words(line);
      double x = 0.0;
      double y = 0.0;
      words >> x >> y;
      drive_.points.emplace_back(x, y);
    }
  }

  TunnelLine drive_;
  const Site site_{build_world(find_world("bruceton"))};
};

TEST_F(BrucetonDrive, IsLongerThanAMileAndBeginsAtTheStart) {
  ASSERT_GT(drive_.points.size(), 2U);
  EXPECT_GT(drive_.length_m(), 1700.0);
  const Pose2& start = site_.world().T_world_start;
  EXPECT_NEAR((drive_.points.front() - start.translation()).norm(), 0.0, 1e-9);
  EXPECT_NEAR(angle_diff(drive_.at(0.0).heading_rad, start.theta), 0.0, 0.01);
}

TEST_F(BrucetonDrive, HasRoomForTheVehicleAlongItsLength) {
  const double length_m = drive_.length_m();
  for (double s_m = 0.0; s_m < length_m; s_m += 0.5) {
    // Heading over the length of a vehicle, not that of a short segment.
    const Eigen::Vector2d ahead = drive_.at(s_m + 0.5).p_world - drive_.at(s_m - 0.5).p_world;
    const Eigen::Vector2d p = drive_.at(s_m).p_world;
    EXPECT_TRUE(is_free(site_, {}, {p.x(), p.y(), std::atan2(ahead.y(), ahead.x())}))
        << "at x " << p.x() << ", y " << p.y();
  }
}

TEST_F(BrucetonDrive, KeepsTheTurningRadiusOfTheVehicle) {
  constexpr double kSegment = 1.0;
  for (double s_m = kSegment; s_m < drive_.length_m() - kSegment; s_m += 0.5) {
    const Eigen::Vector2d in = drive_.at(s_m).p_world - drive_.at(s_m - kSegment).p_world;
    const Eigen::Vector2d out = drive_.at(s_m + kSegment).p_world - drive_.at(s_m).p_world;
    const double turn = angle_diff(std::atan2(out.y(), out.x()), std::atan2(in.y(), in.x()));
    EXPECT_LT(std::abs(turn), kSegment / 1.6) << "at " << s_m;
  }
}

TEST_F(BrucetonDrive, PassesNearlyEveryTunnel) {
  double passed_m = 0.0;
  double all_m = 0.0;
  for (const TunnelEdge& edge : site_.world().truth.tunnels.edges) {
    const TunnelLine line{edge.tunnel, edge.points, edge.width_m, false};
    for (double s_m = 0.5; s_m < line.length_m(); s_m += 1.0) {
      all_m += 1.0;
      if (drive_.distance_m(line.at(s_m).p_world) < 10.0) passed_m += 1.0;
    }
  }
  EXPECT_GT(passed_m / all_m, 0.95);
}

}  // namespace
}  // namespace adit
