// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/svg/scan_pictures.hpp"

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>

#include "common/picture/cloud_picture.hpp"
#include "common/picture/plan_picture.hpp"
#include "common/picture/terrain_picture.hpp"
#include "procs/planning/planning_picture.hpp"
#include "tools/report/svg/indexed_png.hpp"
#include "tools/report/svg/terrain_svg.hpp"
#include "tools/report/text_format.hpp"

namespace adit {
namespace {

constexpr int kViewWidth = 400;
constexpr int kViewHeight = 240;

/// The cloud turned so that the laser points along x: points of the rear laser are behind the
/// robot.
Cloud in_laser_direction(Cloud cloud) {
  double sum_x_m = 0.0;
  for (const CloudLine& line : cloud.lines) {
    for (const Eigen::Vector3f& p : line.points) sum_x_m += p.x();
  }
  if (sum_x_m >= 0.0) return cloud;
  for (CloudLine& line : cloud.lines) {
    for (Eigen::Vector3f& p : line.points) p.head<2>() *= -1.0F;
  }
  return cloud;
}

std::string view_of(const Cloud& cloud) {
  const RgbImage image = cloud_image(in_laser_direction(cloud), kViewWidth, kViewHeight);
  return data_uri("image/png", indexed_png(image));
}

std::string svg_uri(const std::string& svg) {
  return data_uri("image/svg+xml", {reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size()});
}

/// Heading of the middle of the path, otherwise of the route or the goal, in level [rad].
double heading_of(const ScanProducts& scan) {
  const Pose2& T_odom_level = scan.terrain->T_odom_level;
  if (scan.path && scan.path->points.size() > 1) {
    const auto& points = scan.path->points;
    return between(T_odom_level, points[points.size() / 2].T_odom_body).theta;
  }
  if (!scan.goal) return 0.0;
  if (!scan.goal->route_odom.empty()) {
    const auto& route = scan.goal->route_odom;
    const Eigen::Vector2d p_level = T_odom_level.inverse() * route[route.size() / 2];
    return std::atan2(p_level.y(), p_level.x());
  }
  return between(T_odom_level, scan.goal->T_odom_goal).theta;
}

}  // namespace

ScanPictures ScanRenderer::render(const ScanProducts& scan) {
  ScanPictures pictures;
  if (scan.cloud) pictures.view = view_of(*scan.cloud);
  if (!scan.terrain || scan.terrain->cells.box().empty()) return pictures;
  const CellBox box = visible_box(scan);
  pictures.terrain = svg_uri(terrain_svg(scan, terrain_image(*scan.terrain), box, params_.vehicle,
                                         "Terrain: bright cells are smooth"));
  const double heading_rad = heading_of(scan);
  try {
    planning_.prepare(*scan.terrain, scan.terrain->T_odom_level);
  } catch (const std::invalid_argument&) {  // cells too coarse for the planner
    return pictures;
  }
  const PlanPicture plan = planning_picture("", *scan.terrain, scan.path.value_or(PlannedPath{}),
                                            planning_, params_.vehicle, {heading_rad});
  if (plan.slices.empty()) return pictures;
  const double heading_deg = rad_to_deg(heading_rad);
  pictures.heading_deg = heading_deg;
  pictures.c_space =
      svg_uri(terrain_svg(scan, grey_image(plan.slices.front()), box, params_.vehicle,
                          fmt::format("C-space at a heading of {}°", fixed(heading_deg, 0))));
  return pictures;
}

}  // namespace adit
