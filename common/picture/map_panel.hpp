// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Eigen/Core>

#include "common/geometry/convex_polygon.hpp"
#include "common/geometry/pose2.hpp"
#include "common/picture/canvas.hpp"
#include "common/picture/legend.hpp"
#include "common/picture/rgb_image.hpp"
#include "common/types/terrain_map.hpp"

namespace adit {

/// A map with the extent of a terrain map on a sheet, y up, with a title above and a scale bar and
/// a legend below.
class MapPanel {
 public:
  /// `width` on the sheet, the title from `top` on. Maps that are much higher than wide are
  /// narrower.
  MapPanel(const Canvas& canvas, const TerrainMap& terrain, double left, double top, double width);

  [[nodiscard]] const Canvas& canvas() const { return canvas_; }
  [[nodiscard]] const TerrainMap& terrain() const { return terrain_; }
  [[nodiscard]] double pixels_per_metre() const { return cell_px_ / terrain_.cell_m; }
  [[nodiscard]] double cell_px() const { return cell_px_; }
  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector2d& p_level) const;

  /// Draws an image with one pixel per cell.
  void draw(const RgbImage& image, const std::string& title) const;
  /// Draws the outline of a vehicle with an arrow that points ahead.
  void draw_vehicle(const Pose2& T_level_body, const ConvexPolygon& outline) const;
  /// Draws the outline at a pose.
  void outline(const Pose2& T_level_body, const ConvexPolygon& outline) const;
  /// Draws scale bar and legend. Returns their lower end [pixels].
  [[nodiscard]] double finish(const Legend& legend) const;
  /// Lower end of the map [pixels].
  [[nodiscard]] double bottom() const;

  /// Clips drawing to the map until `unclip`.
  void clip() const;
  void unclip() const;

 private:
  const Canvas& canvas_;
  const TerrainMap& terrain_;
  double left_;
  double top_;  ///< upper edge of the map itself
  double width_;
  double cell_px_;
};

}  // namespace adit
