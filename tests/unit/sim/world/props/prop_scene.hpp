// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "sim/world/props/props.hpp"

namespace adit {

/// Props alone, without surfaces around them, in a tunnel `main` along x from (0, 0) to (60, 0), 4
/// m wide and 2 m high; and a tunnel `bent` from (0, 20) by (30, 20) to (50, 30).
struct PropScene {
  explicit PropScene(const PropDescriptions& props, const ReliefDescription& relief = {0.0, 2.0, 1},
                     int seed = 1);
  PropScene(const PropScene&) = delete;  // the rays point at the mesh
  PropScene& operator=(const PropScene&) = delete;

  /// The part of a name; null if there is none.
  [[nodiscard]] const Obstacle* obstacle(const std::string& name) const;
  /// Distance of the first hit of a ray.
  [[nodiscard]] std::optional<double> range(
      const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
      RayScene::Layer layer = RayScene::Layer::kOptical) const;

  std::vector<TunnelLine> tunnels;
  Heights heights;
  World world;

 private:
  std::optional<RayScene> scene_;
};

}  // namespace adit
