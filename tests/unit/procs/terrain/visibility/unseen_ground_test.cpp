// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <gtest/gtest.h>

#include "procs/terrain/terrain.hpp"
#include "tests/unit/procs/terrain/terrain_scenes.hpp"

namespace adit {
namespace {

constexpr double kLaserHeight = 0.62;  // height above the ground [m]
constexpr double kLaserAhead = 1.05;   // ahead of the origin of body [m]

TerrainMap map_of(const std::function<void(MeshBuilder&)>& add) {
  return Terrain({}).make(cloud_of(add));
}

std::function<bool(const TerrainCell&)> is(Ground ground) {
  return [ground](const TerrainCell& cell) { return cell.ground == ground; };
}

TEST(UnseenGround, IsNeverObservedBehindTheLaser) {
  const TerrainMap map = map_of(add_tunnel);
  EXPECT_EQ(cell_at(map, -2.0, 0.0).ground, Ground::kNeverObserved);
  EXPECT_TRUE(std::isnan(cell_at(map, -2.0, 0.0).low_m));
  EXPECT_TRUE(std::isnan(cell_at(map, -2.0, 0.0).coefficient_m));
  // At 30° the steepest beam hits the ground 1.07 m ahead of the laser.
  EXPECT_EQ(cell_at(map, 1.7, 0.0).ground, Ground::kNeverObserved);
}

TEST(UnseenGround, IsOccludedInTheShadowOfAPillar) {
  const TerrainMap map = map_of([](MeshBuilder& builder) {
    add_tunnel(builder);
    add_rock(builder, {4.0, 0.0, 1.0}, {0.5, 0.5, 2.0});
  });
  const Eigen::AlignedBox2d behind(Eigen::Vector2d(4.5, -0.15), Eigen::Vector2d(9.0, 0.15));
  EXPECT_EQ(share_of(map, behind, is(Ground::kOccluded)), 1.0);
  const Eigen::AlignedBox2d beside(Eigen::Vector2d(4.5, 1.0), Eigen::Vector2d(7.0, 1.5));
  EXPECT_EQ(share_of(map, beside, is(Ground::kObserved)), 1.0);
}

TEST(UnseenGround, InAPitIsBelowTheBeamsOverIt) {
  const TerrainMap map = map_of([](MeshBuilder& builder) {
    add_ground(builder, -5.0, 4.0);
    add_ground(builder, 4.0, 5.5, -1.0);
    add_ground(builder, 5.5, 15.0);
  });
  // Two cells from its edges: a region across the edge shows the ground beyond it.
  const Eigen::AlignedBox2d pit(Eigen::Vector2d(4.2, -1.0), Eigen::Vector2d(5.2, 1.0));
  EXPECT_EQ(share_of(map, pit, is(Ground::kBelowRay)), 1.0);
  const double edge_grade = kLaserHeight / (4.0 - kLaserAhead);
  for (const double x : {4.35, 4.75, 5.05}) {
    // The first beam over the edge passes at most one line, here 0.3°, above the one along the
    // edge.
    const double along_edge = -edge_grade * (x - 4.0);
    EXPECT_NEAR(cell_at(map, x, 0.05).low_m, along_edge, 0.3 * 0.0175 * (x - kLaserAhead) + 0.03);
  }
  EXPECT_EQ(cell_at(map, 6.5, 0.0).ground, Ground::kObserved);
  EXPECT_LT(cell_at(map, 6.5, 0.0).coefficient_m, 0.03);
}

/// Points of the roof above a cell are not points of its ground. A rail spans the pit.
TEST(UnseenGround, InAPitIsTheSameUnderARoof) {
  const auto pit = [](MeshBuilder& builder) {
    add_ground(builder, -5.0, 4.0);
    add_ground(builder, 4.0, 4.8, -1.0);
    add_ground(builder, 4.8, 15.0);
    add_rock(builder, {5.0, 0.5, -0.03}, {10.0, 0.06, 0.1});
  };
  const TerrainMap open = map_of(pit);
  const TerrainMap roofed = map_of([&](MeshBuilder& builder) {
    pit(builder);
    add_rock(builder, {5.0, 0.0, 2.5}, {20.0, 4.0, 1.0});
  });
  int below_beams = 0;
  for (double x = 3.55; x < 5.5; x += 0.1) {
    for (double y = -0.95; y < 1.0; y += 0.1) {
      EXPECT_EQ(cell_at(roofed, x, y).ground, cell_at(open, x, y).ground) << x << " " << y;
      below_beams += cell_at(open, x, y).ground == Ground::kBelowRay ? 1 : 0;
    }
  }
  EXPECT_GT(below_beams, 60);
}

/// For a rail of standard height, and the beams that pass over it.
TEST(UnseenGround, BehindARailIsOccludedAndNotADrop) {
  const auto rail = [](MeshBuilder& builder) {
    add_rock(builder, {5.0, 0.0, 0.05}, {0.06, 2.0, 0.1});
  };
  const Eigen::AlignedBox2d behind(Eigen::Vector2d(5.2, -0.8), Eigen::Vector2d(6.5, 0.8));
  const TerrainMap even = map_of([&](MeshBuilder& builder) {
    add_tunnel(builder);
    rail(builder);
  });
  EXPECT_GT(share_of(even, behind, is(Ground::kOccluded)), 0.1);
  EXPECT_EQ(share_of(even, behind, is(Ground::kBelowRay)), 0.0);
  const TerrainMap pit = map_of([&](MeshBuilder& builder) {
    add_ground(builder, -5.0, 5.1);
    add_ground(builder, 5.1, 9.5, -1.0);
    add_rock(builder, {12.25, 0.0, -0.5},
             {5.5, 8.0, 1.0});  // the far wall of the pit, and the ground behind it
    rail(builder);
  });
  EXPECT_EQ(share_of(pit, behind, is(Ground::kBelowRay)), 1.0);
}

TEST(UnseenGround, BeyondACrestIsBelowTheBeamsOverIt) {
  const TerrainMap map = map_of([](MeshBuilder& builder) {
    add_ground(builder, -5.0, 5.0);
    add_ground(builder, 5.0, 15.0, -1.5);
  });
  const Eigen::AlignedBox2d beyond(Eigen::Vector2d(5.2, -0.5), Eigen::Vector2d(8.0, 0.5));
  EXPECT_EQ(share_of(map, beyond, is(Ground::kBelowRay)), 1.0);
}

/// A quad across a tunnel 4 m wide, between two places along it and the heights there.
void add_slab(MeshBuilder& builder, const Eigen::Vector2f& from, const Eigen::Vector2f& to) {
  builder.quad(builder.vertex({from.x(), -2.0F, from.y()}), builder.vertex({to.x(), -2.0F, to.y()}),
               builder.vertex({to.x(), 2.0F, to.y()}), builder.vertex({from.x(), 2.0F, from.y()}));
}

/// A tunnel that is level up to an edge `edge_m` ahead and falls behind it.
std::function<void(MeshBuilder&)> falling_tunnel(float edge_m, float grade, float height_m) {
  return [=](MeshBuilder& builder) {
    const float end_m = edge_m + 20.0F;
    for (const float z_m : {0.0F, height_m}) {
      add_slab(builder, {-5.0F, z_m}, {edge_m, z_m});
      add_slab(builder, {edge_m, z_m}, {end_m, z_m + grade * 20.0F});
    }
    for (const double side : {-1.0, 1.0}) {
      add_rock(builder, {10.0, side * 2.5, 0.0}, {40.0, 1.0, 20.0});
    }
  };
}

const Eigen::AlignedBox2d kTunnelMiddle(Eigen::Vector2d(2.5, -1.2), Eigen::Vector2d(13.5, 1.2));

/// Cells in the middle of a falling tunnel: observed, observed as other than its floor, and where
/// beams without a return count as a sign of water.
struct FalseGround {
  int observed = 0;
  int wrong = 0;
  int possible_water = 0;
};

FalseGround false_ground(float edge_m, float grade, float height_m) {
  const TerrainMap map = map_of(falling_tunnel(edge_m, grade, height_m));
  FalseGround count;
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const Eigen::Vector2i at = map.cells.cell(i);
    const Eigen::Vector2d p = map.centre(at.x(), at.y());
    const TerrainCell& cell = map.cells[i];
    if (!kTunnelMiddle.contains(p)) continue;
    count.possible_water += cell.ground == Ground::kNoReturn ? 1 : 0;
    if (cell.ground != Ground::kObserved) continue;
    const double floor_m = grade * std::max(p.x() - static_cast<double>(edge_m), 0.0);
    const bool even = std::abs(cell.low_m - floor_m) < 0.1 && cell.high_m - cell.low_m < 0.1F;
    ++count.observed;
    count.wrong += even ? 0 : 1;
  }
  return count;
}

/// At the edge and at the far end of the roof, where the last beams end, single cells may fail.
TEST(UnseenGround, IsNotTheRoofThatFallsBehindAnEdge) {
  for (const float grade : {-0.2F, -0.25F, -0.3F, -0.36F}) {
    for (const float edge_m : {3.0F, 4.0F, 6.0F, 9.0F}) {
      for (const float height_m : {1.8F, 2.2F, 3.0F}) {
        const FalseGround count = false_ground(edge_m, grade, height_m);
        EXPECT_GT(count.observed, 100);
        EXPECT_LE(count.possible_water, 10) << grade << " " << edge_m << " " << height_m;
        EXPECT_LE(count.wrong, 5) << grade << " " << edge_m << " " << height_m;
      }
    }
  }
}

/// Banks of fallen rock lead from the roof to the floor in steps that a roof could have.
TEST(UnseenGround, IsNotTheFloorAtTheFootOfABankThatReachesTheRoof) {
  for (const float slope : {0.5F, 0.6F, 0.7F, 0.8F}) {
    for (const float height_m : {1.6F, 2.1F}) {
      const TerrainMap map = map_of([&](MeshBuilder& builder) {
        add_slab(builder, {-5.0F, 0.0F}, {25.0F, 0.0F});
        add_rock(builder, {10.0, 0.0, height_m + 0.5}, {40.0, 20.0, 1.0});
        add_rock(builder, {10.0, 2.5, 0.0}, {40.0, 1.0, 20.0});
        const float top_y = -1.4F - height_m / slope;
        builder.quad(builder.vertex({-5.0F, top_y, height_m}),
                     builder.vertex({25.0F, top_y, height_m}), builder.vertex({25.0F, -1.4F, 0.0F}),
                     builder.vertex({-5.0F, -1.4F, 0.0F}));
      });
      const Eigen::AlignedBox2d floor(Eigen::Vector2d(2.5, -1.2), Eigen::Vector2d(12.0, 1.2));
      int observed = 0;
      int wrong = 0;
      for_cells(map, floor, [&](const TerrainCell& cell) {
        if (cell.ground != Ground::kObserved) return;
        ++observed;
        wrong += std::abs(cell.low_m) < 0.1F ? 0 : 1;
      });
      EXPECT_GT(observed, 500);
      EXPECT_EQ(wrong, 0) << slope << " " << height_m;
    }
  }
}

/// The vehicle does not fit below it, wherever the hidden ground is that it could drive on.
TEST(UnseenGround, BelowALowSlabNearItsEdgeLeavesNoRoom) {
  const TerrainMap map = map_of([](MeshBuilder& builder) {
    add_ground(builder, -5.0, 4.0);
    add_ground(builder, 4.0, 15.0, -0.4);
    add_rock(builder, {5.5, 0.0, 0.8}, {1.5, 4.0, 0.8});
  });
  const Eigen::AlignedBox2d face(Eigen::Vector2d(4.75, -1.5), Eigen::Vector2d(4.85, 1.5));
  EXPECT_EQ(share_of(map, face,
                     [](const TerrainCell& cell) {
                       return cell.ground == Ground::kObserved && cell.high_m - cell.low_m > 0.3F;
                     }),
            1.0);
}

/// The same slab above ground that is hidden so far that it may have fallen below it.
TEST(UnseenGround, BelowALowSlabFarBehindAnEdgeIsUnknown) {
  const TerrainMap map = map_of([](MeshBuilder& builder) {
    add_ground(builder, -5.0, 4.0);
    add_ground(builder, 4.0, 40.0, -3.0);
    add_rock(builder, {10.0, 0.0, 1.1}, {2.0, 4.0, 0.8});
  });
  const Eigen::AlignedBox2d face(Eigen::Vector2d(9.0, -1.5), Eigen::Vector2d(9.1, 1.5));
  EXPECT_EQ(share_of(map, face, is(Ground::kObserved)), 0.0);
}

/// Rock from above the lines of sight down to below the edge leaves no room, however the hidden
/// ground falls.
TEST(UnseenGround, BeforeAWallBehindAnEdgeDoesNotHideIt) {
  const TerrainMap map = map_of([](MeshBuilder& builder) {
    add_ground(builder, -5.0, 4.0);
    add_ground(builder, 4.0, 15.0, -0.8);
    add_rock(builder, {9.0, 0.0, 0.0}, {1.0, 4.0, 5.0});
  });
  const Eigen::AlignedBox2d face(Eigen::Vector2d(8.45, -1.5), Eigen::Vector2d(8.55, 1.5));
  EXPECT_EQ(share_of(map, face,
                     [](const TerrainCell& cell) {
                       return cell.ground == Ground::kObserved && cell.high_m - cell.low_m > 0.6F;
                     }),
            1.0);
}

constexpr double kRailHeight = 0.12;  // [m]

/// Level ground with a rail across it, whose centre is at `x_m`.
std::function<void(MeshBuilder&)> with_rail(double x_m) {
  return [x_m](MeshBuilder& builder) {
    add_ground(builder, -5.0, 15.0);
    add_rock(builder, {x_m, 0.0, kRailHeight / 2.0}, {0.06, 4.0, kRailHeight});
  };
}

TEST(UnseenGround, BehindANearRailIsNotADrop) {
  const TerrainMap map = map_of(with_rail(2.6));
  // Its shadow is 1.58 m · 0.12 / 0.50 = 0.38 m long.
  const Eigen::AlignedBox2d behind(Eigen::Vector2d(2.65, -1.0), Eigen::Vector2d(4.0, 1.0));
  EXPECT_EQ(share_of(map, behind, is(Ground::kObserved)), 1.0);
}

TEST(UnseenGround, BehindADistantRailIsUnknown) {
  const TerrainMap map = map_of(with_rail(5.0));
  // Its shadow is 3.92 m · 0.12 / 0.50 = 0.94 m long; two cells from its ends, as for a pit.
  const Eigen::AlignedBox2d shadow(Eigen::Vector2d(5.25, -1.0), Eigen::Vector2d(5.75, 1.0));
  EXPECT_EQ(share_of(map, shadow, is(Ground::kOccluded)), 1.0);
  const Eigen::AlignedBox2d beyond(Eigen::Vector2d(6.3, -1.0), Eigen::Vector2d(7.0, 1.0));
  EXPECT_EQ(share_of(map, beyond, is(Ground::kObserved)), 1.0);
}

TEST(UnseenGround, InAPitBehindARailIsBelowTheBeamsOverIt) {
  const TerrainMap map = map_of([](MeshBuilder& builder) {
    add_ground(builder, -5.0, 2.7);
    add_rock(builder, {2.6, 0.0, kRailHeight / 2.0}, {0.06, 4.0, kRailHeight});
    add_ground(builder, 2.7, 4.5, -1.0);
    add_ground(builder, 4.5, 15.0);
  });
  const Eigen::AlignedBox2d pit(Eigen::Vector2d(3.0, -1.0), Eigen::Vector2d(4.2, 1.0));
  EXPECT_EQ(share_of(map, pit, is(Ground::kBelowRay)), 1.0);
}

TEST(UnseenGround, InADitchThatAWheelBridgesIsObserved) {
  const auto ditch = [](double width_m) {
    return map_of([=](MeshBuilder& builder) {
      add_ground(builder, -5.0, 4.0);
      add_ground(builder, 4.0, 4.0 + width_m, -1.0);
      add_ground(builder, 4.0 + width_m, 15.0);
    });
  };
  const auto over = [](double width_m) {
    return Eigen::AlignedBox2d(Eigen::Vector2d(4.0, -1.0), Eigen::Vector2d(4.0 + width_m, 1.0));
  };
  EXPECT_EQ(share_of(ditch(0.4), over(0.4), is(Ground::kObserved)), 1.0);
  EXPECT_GT(share_of(ditch(0.8), over(0.8), is(Ground::kBelowRay)), 0.4);
}

TEST(UnseenGround, UnderWaterReturnsNoBeams) {
  const TerrainMap map = map_of([](MeshBuilder& builder) {
    add_ground(builder, -5.0, 15.0);
    builder.begin_part(PartKind::kWater, Material::kWater, "water");
    builder.quad(builder.vertex({4.0F, -2.0F, 0.01F}), builder.vertex({6.0F, -2.0F, 0.01F}),
                 builder.vertex({6.0F, 2.0F, 0.01F}), builder.vertex({4.0F, 2.0F, 0.01F}));
  });
  const Eigen::AlignedBox2d water(Eigen::Vector2d(4.2, -1.5), Eigen::Vector2d(5.8, 1.5));
  EXPECT_EQ(share_of(map, water, is(Ground::kNoReturn)), 1.0);
  EXPECT_EQ(cell_at(map, 7.0, 0.0).ground, Ground::kObserved);
}

TEST(UnseenGround, BetweenLinesOnLevelGroundIsInterpolated) {
  const TerrainMap map = map_of(add_tunnel);
  // At 8 m from the laser the lines are 0.45 m apart, more than a region is wide.
  const Eigen::AlignedBox2d far(Eigen::Vector2d(8.0, -1.0), Eigen::Vector2d(9.0, 1.0));
  EXPECT_EQ(share_of(map, far, is(Ground::kObserved)), 1.0);
  EXPECT_GT(share_of(map, far, [](const TerrainCell& cell) { return cell.count == 0; }), 0.1);
  for_cells(map, far, [](const TerrainCell& cell) {
    EXPECT_NEAR(cell.low_m, 0.0, 0.03);  // noise as on observed ground
    EXPECT_LT(cell.coefficient_m, 0.03);
  });
}

}  // namespace
}  // namespace adit
