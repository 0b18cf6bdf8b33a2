// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/surface/plan_mesh.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kGrid = 0.2;

/// Rotated against the grid, so that its walls pass the corners of the grid at any distance.
PlanMesh mesh_of_askew_tunnel() {
  WorldDescription description;
  description.plan.tunnels = {{"main", {0.0, 0.0, 60.0, 7.0}, 3.0, false}};
  description.wall_relief.height_m = 0.0;
  return plan_mesh(OpenSpace(description, tunnel_lines(description.plan)), kGrid);
}

double area_m2(const PlanMesh& mesh) {
  double twice = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector2d u = mesh.points[b] - mesh.points[a];
    const Eigen::Vector2d v = mesh.points[c] - mesh.points[a];
    twice += u.x() * v.y() - u.y() * v.x();
  }
  return twice / 2.0;
}

TEST(PlanMesh, AWallFacesWhereThePlanHasItFace) {
  const PlanMesh mesh = mesh_of_askew_tunnel();
  const Eigen::Vector2d along = Eigen::Vector2d(60.0, 7.0).normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  double most = 0.0;
  for (std::uint32_t i = 0; i < mesh.points.size(); ++i) {
    if (!mesh.is_on_wall(i)) continue;
    const Eigen::Vector2d& p = mesh.points[i];
    const Eigen::Vector2d step = mesh.points[mesh.next_on_wall[i]] - p;
    EXPECT_GE(step.norm(), 0.1 * kGrid);
    const double s = p.dot(along);
    if (s < 0.5 || s > 59.5) continue;  // the ends
    most = std::max(most, std::atan2(std::abs(step.dot(across)), std::abs(step.dot(along))));
  }
  // Crossings are kept 2 mm from the corners of the grid: both ends of 20 mm off by that.
  EXPECT_LT(most, std::atan2(2.0 * 2.0, 20.0));
}

TEST(PlanMesh, CoversThePlan) {
  const PlanMesh mesh = mesh_of_askew_tunnel();
  const double length = std::hypot(60.0, 7.0);
  // Half of the 2 mm along the walls; a tenth of a square of the grid is lost in each corner.
  EXPECT_NEAR(area_m2(mesh), 3.0 * length, 0.001 * 2.0 * length + 4 * 0.1 * kGrid * kGrid);
}

TEST(ShortWalls, AreMergedAndTheirTrianglesRemoved) {
  // A square with one corner cut by 1 cm, as a fan around its centre.
  PlanMesh mesh;
  mesh.points = {{0.5, 0.5}, {0.0, 0.0}, {0.99, 0.0}, {1.0, 0.01}, {1.0, 1.0}, {0.0, 1.0}};
  mesh.next_on_wall = {PlanMesh::kNone, 2, 3, 4, 5, 1};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}};
  merge_short_walls(mesh, 0.02);
  ASSERT_EQ(mesh.points.size(), 5U);
  EXPECT_LT((mesh.points[2] - Eigen::Vector2d(0.995, 0.005)).norm(), 1e-12);
  EXPECT_EQ(mesh.triangles.size(), 4U);
  const std::vector<std::uint32_t> around{PlanMesh::kNone, 2, 3, 4, 1};
  EXPECT_EQ(mesh.next_on_wall, around);
}

TEST(ShortWalls, KeepThreePointsOfAWall) {
  PlanMesh mesh;
  mesh.points = {{0.0, 0.0}, {0.01, 0.0}, {0.01, 0.01}, {0.0, 0.01}};
  mesh.next_on_wall = {1, 2, 3, 0};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  merge_short_walls(mesh, 1.0);
  EXPECT_EQ(mesh.points.size(), 3U);
  EXPECT_EQ(mesh.triangles.size(), 1U);
}

}  // namespace
}  // namespace adit
