// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/picture/canvas.hpp"
#include "common/picture/legend.hpp"
#include "common/picture/rgb_image.hpp"
#include "common/types/terrain_map.hpp"

namespace adit {

/// A map of the size of a terrain somewhere on a sheet, y up, with a title above and a scale and a
/// legend below.
class MapPanel {
 public:
  /// So wide on the sheet, its title from `top` on. Maps that are much higher than wide are
  /// narrower.
  MapPanel(const Canvas& canvas, const TerrainMap& terrain, double left, double top, double width);

  [[nodiscard]] const Canvas& canvas() const { return canvas_; }
  [[nodiscard]] const TerrainMap& terrain() const { return terrain_; }
  [[nodiscard]] double pixels_per_metre() const { return cell_px_ / terrain_.cell_m; }
  [[nodiscard]] double cell_px() const { return cell_px_; }
  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector2d& p_level) const;

  /// A pixel of the image for each cell.
  void draw(const RgbImage& image, const std::string& title) const;
  /// A vehicle as its outline, an arrow within it pointing ahead.
  void draw_vehicle(const Pose2& T_level_body, double length_m, double width_m) const;
  /// A closed line round a rectangle about a pose.
  void outline(const Pose2& T_level_body, double length_m, double width_m) const;
  /// Scale and legend. Returns where they end [pixels].
  [[nodiscard]] double finish(const Legend& legend) const;
  /// Where the map ends [pixels].
  [[nodiscard]] double bottom() const;

  /// What is drawn until `unclip` stays within the map.
  void clip() const;
  void unclip() const;

 private:
  const Canvas& canvas_;
  const TerrainMap& terrain_;
  double left_;
  double top_;  ///< of the map itself
  double width_;
  double cell_px_;
};

}  // namespace adit
