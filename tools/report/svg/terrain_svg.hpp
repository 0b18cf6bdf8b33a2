// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Eigen/Core>

#include "common/grid/occupancy_grid.hpp"
#include "common/picture/rgb_image.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"
#include "tools/report/svg/scan_pictures.hpp"

namespace adit {

/// From level to a picture of some of the cells of a terrain, which must outlive it: y down.
class CellView {
 public:
  CellView(const TerrainMap& terrain, const CellBox& box) : terrain_(terrain), box_(box) {}

  [[nodiscard]] Eigen::Vector2d at(const Eigen::Vector2d& p_level) const {
    const Eigen::Vector2d cell = (p_level - terrain_.p_level_corner) / terrain_.cell_m;
    return {cell.x() - box_.from.x(), box_.to.y() - cell.y()};
  }
  [[nodiscard]] Eigen::Vector2d at(const Pose2& T_odom) const {
    return at(between(terrain_.T_odom_level, T_odom).translation());
  }
  [[nodiscard]] const TerrainMap& terrain() const { return terrain_; }

 private:
  const TerrainMap& terrain_;
  CellBox box_;
};

// What is drawn over these cells, SVG.

std::string svg_outline(const CellView& view, const Pose2& T_level_body, const Vehicle& vehicle,
                        const char* css_class);
/// The path with the vehicle on it here and there; nothing without one.
std::string svg_planned_path(const CellView& view, const PlannedPath& path, const Vehicle& vehicle);
/// What is in the way, by reason.
std::string svg_blocking(const CellView& view, const PlannedPath& path);
std::string svg_goal(const CellView& view, const PlanGoal& goal);

/// What blocks a path: CSS class, and name.
struct BlockingName {
  const char* css_class;
  const char* name;
};
const BlockingName& blocking_name(BlockingCell::Reason reason);

/// The cells of a terrain that are worth a picture: where something is known, and where the path
/// leads.
CellBox visible_box(const ScanProducts& scan);

/// An image of the terrain's cells, cut to a box, with the vehicle and the path over it, or what is
/// in the way. `label` says what it is to who cannot see it.
std::string terrain_svg(const ScanProducts& scan, const RgbImage& cells, const CellBox& box,
                        const Vehicle& vehicle, const std::string& label);

}  // namespace adit
