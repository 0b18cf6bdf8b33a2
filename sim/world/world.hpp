// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "sim/mesh/ray_scene.hpp"
#include "sim/mesh/triangle_mesh.hpp"
#include "sim/world/world_truth.hpp"

namespace adit {

/// Ground into which wheels sink, deepest in the centre and firm at the rim.
struct SoftGround {
  std::string name;
  Eigen::Vector2d p_world{0.0, 0.0};  ///< middle [m]
  double radius_m = 0.0;
  double depth_m = 0.0;  ///< sinkage of a wheel in the centre
};

/// Standing water: everything below the level within the outline.
struct StandingWater {
  std::string name;
  std::vector<Eigen::Vector2d> outline;  ///< closed, counter-clockwise, p_world [m]
  double level_m = 0.0;                  ///< z in world
};

/// A pocket of gas: its concentration falls off with distance as a normal distribution.
struct GasPocket {
  std::string name;
  Eigen::Vector2d p_world{0.0, 0.0};  ///< middle [m]
  double radius_m = 0.0;              ///< one standard deviation
  double methane_share = 0.0;         ///< fraction of the air in the centre
};

/// A mine to drive in, in the frame `world`, z up. Immutable once built.
struct World {
  std::string name;
  TriangleMesh mesh;
  std::vector<SoftGround> soft_ground;
  std::vector<StandingWater> water;
  std::vector<GasPocket> gas;
  Pose2 T_world_start;  ///< of the body at the start
  int start_level = 0;  ///< of the tunnels there
  WorldTruth truth;
};

/// A world and the ray casting scene of its mesh. Neither copied nor moved, since the scene refers
/// to the mesh.
class Site {
 public:
  explicit Site(World world) : world_(std::move(world)), scene_(world_.mesh) {}
  Site(const Site&) = delete;
  Site& operator=(const Site&) = delete;

  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] const RayScene& scene() const { return scene_; }

 private:
  World world_;
  RayScene scene_;
};

}  // namespace adit
