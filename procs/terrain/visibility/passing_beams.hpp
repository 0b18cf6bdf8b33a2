// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/types/cloud.hpp"
#include "common/types/terrain_map.hpp"

namespace adit {

/// Heights of the lowest and the highest beams that pass over each place and end beyond it. Ground
/// is never above the lowest: points that are show something that hangs over the place, for example
/// a roof that falls behind an edge. Above the highest nothing is known if what higher beams hit
/// before hides it: behind the lip of a low roof the floor may be seen and the roof not. No class
/// of the points is needed, only where each beam ends.
class PassingBeams {
 public:
  /// `margin_m`: by which points are above beams that pass below them.
  PassingBeams(const Cloud& cloud, const TerrainMap& map, double margin_m);

  /// Whether beams pass below a height z in level [m] at a point: then it is not that of the
  /// ground.
  [[nodiscard]] bool pass_below(const Eigen::Vector2f& p_level, float z_m) const {
    return z_m > height_m(p_level) + margin_m_;
  }

  /// z in level [m] up to which a place, or what lies a sector beside it, is seen to be free;
  /// infinite if nothing nearer hides what is above. Of a sector that meets the edge of a wall the
  /// highest beams may end there and lower ones pass.
  [[nodiscard]] float free_up_to_m(const Eigen::Vector2f& p_level) const;

  /// Where the first lines begin; the origin without any.
  [[nodiscard]] Eigen::Vector2d p_level_laser() const;

 private:
  /// Heights by sector, then distance in cells.
  struct Viewpoint {
    Eigen::Vector2f origin;
    std::size_t bins;
    std::vector<float> heights_m;
    std::vector<float> highest_m;  ///< infinite where nothing hides what is above, −infinite
                                   ///< where fewer than two beams reach

    /// Of a place among these heights; empty if it is too far away.
    [[nodiscard]] std::optional<std::size_t> index(const Eigen::Vector2f& p_level,
                                                   float cell_m) const;
    [[nodiscard]] float free_up_to_m(const Eigen::Vector2f& p_level, float cell_m) const;
  };

  /// z in level [m] of the second lowest beam over a point, since a single one may be a reflection;
  /// infinite if fewer pass.
  [[nodiscard]] float height_m(const Eigen::Vector2f& p_level) const;

  float cell_m_;
  float margin_m_;
  std::vector<Viewpoint> viewpoints_;
};

}  // namespace adit
