// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "sim/world/relief.hpp"
#include "sim/world/surface/height_profile.hpp"
#include "sim/world/surface/tunnel_rises.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// Change of the floor or the roof by a prop, within a rectangle of the plan.
struct HeightChange {
  Eigen::Vector2d low{0.0, 0.0};   ///< corner of the rectangle, p_world [m]
  Eigen::Vector2d high{0.0, 0.0};  ///< the opposite one
  /// Maps the height at a point [m] to the new height.
  std::function<double(const Eigen::Vector2d& p_world, double height_m)> apply;
};

/// Heights of floor and roof as functions of the plan, inside and outside of the mine. Frame world.
class Heights {
 public:
  /// `rises` are those of the tunnels of the level; null for none. Throws std::invalid_argument for
  /// a profile that does not ascend.
  Heights(const HeightsDescription& description, int seed,
          std::shared_ptr<const TunnelRises> rises = nullptr);

  void change_floor(HeightChange change) { floor_changes_.push_back(std::move(change)); }
  void change_roof(HeightChange change) { roof_changes_.push_back(std::move(change)); }

  [[nodiscard]] double floor(const Eigen::Vector2d& p_world) const;
  /// At least 5 cm above the floor.
  [[nodiscard]] double roof(const Eigen::Vector2d& p_world) const;

 private:
  /// Height of the floor without relief and changes.
  [[nodiscard]] double base(const Eigen::Vector2d& p_world) const;

  HeightProfile profile_;
  Eigen::Vector2d heading_;
  double clearance_m_;
  Relief rolls_;
  std::shared_ptr<const TunnelRises> rises_;
  Relief floor_relief_;
  Relief roof_relief_;
  std::vector<HeightChange> floor_changes_;
  std::vector<HeightChange> roof_changes_;
};

}  // namespace adit
