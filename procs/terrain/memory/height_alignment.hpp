// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "procs/terrain/memory/remembered_map.hpp"
#include "procs/terrain/terrain_params.hpp"

namespace adit {

/// What is to be added to the heights of one level to have them in another, at a place of the
/// latter: levels lie on the ground where they were taken, and gravity is known to a degree or so.
struct HeightPlane {
  float offset_m = 0.0F;
  Eigen::Vector2f grade{0.0F, 0.0F};

  [[nodiscard]] float at(const Eigen::Vector2f& p_level) const {
    return offset_m + grade.dot(p_level);
  }
};

/// From an earlier look to a new one, by the ground that both saw, and that on which the body stood
/// when it looked. Nothing where they do not know enough in common, unless it looked from the same
/// place; where their heights, or where things stand, differ too much. Then one of the levels or
/// odom is wrong.
std::optional<HeightPlane> align_heights(const TerrainMap& now, const RememberedMap& before,
                                         const TerrainParams& params);

}  // namespace adit
