// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/control/control_points.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr double kFeetPerMetre = 1.0 / 0.3048;
constexpr double kScaleMax = 0.1;   // a larger difference of lengths is no error of measurement
constexpr double kApartMinM = 2.0;  // closer control points fix no bearing
constexpr double kReflectedShare = 0.2;  // of the misfit, that of exchanged axes is less
constexpr double kMisfitMinM = 0.5;
constexpr double kLevelSdRad = 0.005;  // of the level frame of a 3D scan
constexpr double kClimbMinM = 2.0;     // of control, to compare heights with those of the mission

[[noreturn]] void fail(const std::string& file, const std::string& reason) {
  throw std::runtime_error(message_line(fmt::format("{}: {}", file, reason)));
}

[[noreturn]] void fail_at(const ControlRow& row, const std::string& file,
                          const std::string& reason) {
  throw std::runtime_error(message_line(fmt::format("{}:{}: {}", file, row.line, reason)));
}

/// Pose of the body at a time, in map.
LevelPose T_map_body_at(std::int64_t utime, const ControlRow& row, const SurveyInput& input,
                        const std::string& file) {
  const auto pose = interpolate_in_space(input.map().path(), utime);
  if (!pose) {
    const Trajectory& path = input.map().path();
    fail_at(row, file,
            fmt::format("the mission is from {:.0f} to {:.0f} s, not at {:.3f} s",
                        1e-6 * static_cast<double>(path.front().utime),
                        1e-6 * static_cast<double>(path.back().utime),
                        1e-6 * static_cast<double>(utime)));
  }
  return {pose->pose, pose->z_m};
}

ControlPoint find(const ControlRow& row, const SurveyInput& input, const SurveyGraph& graph,
                  const std::string& file) {
  ControlPoint point{row};
  const auto attach = [&](std::size_t node, const Eigen::Vector3d& p_map) {
    point.node = node;
    point.p_map = p_map;
    point.p_local = graph.nodes()[node].T_map_local.inverse() * p_map;
  };
  switch (row.place) {
    case ControlRow::Place::kStart:
      attach(0, graph.nodes().front().T_map_local * row.offset);
      break;
    case ControlRow::Place::kTime:
      attach(graph.node_at(row.utime), T_map_body_at(row.utime, row, input, file) * row.offset);
      break;
    case ControlRow::Place::kScan: {
      if (static_cast<std::size_t>(row.scan) > input.clouds().size()) {
        fail_at(row, file,
                fmt::format("no scan {}: the mission has {}", row.scan, input.clouds().size()));
      }
      const Cloud& cloud = input.clouds()[static_cast<std::size_t>(row.scan) - 1];
      const std::size_t node = graph.node_at(cloud.utime);
      const SurveyGraph::Node& at = graph.nodes()[node];
      const LevelPose T_local_level =
          between(at.T_odom_local, LevelPose{cloud.T_odom_level, cloud.z_odom_m});
      attach(node, at.T_map_local * (T_local_level * row.offset));
      point.z_sd_m = kLevelSdRad * row.offset.head<2>().norm();
      break;
    }
    case ControlRow::Place::kMap:
      attach(graph.node_near(row.offset.head<2>()), row.offset);
      break;
  }
  return point;
}

std::vector<Eigen::Vector2d> exchanged(std::vector<Eigen::Vector2d> points) {
  for (Eigen::Vector2d& p : points) std::swap(p.x(), p.y());
  return points;
}

void require_system(const std::vector<Eigen::Vector2d>& given, const GridSystem& grid,
                    const std::string& file) {
  if (!grid.is_projected) return;
  const auto is_degrees = [](const Eigen::Vector2d& p) {
    return std::abs(p.x()) <= 180.0 && std::abs(p.y()) <= 180.0;
  };
  if (std::ranges::all_of(given, is_degrees)) {
    fail(file, fmt::format("coordinates look like degrees, not like eastings and northings of {}",
                           grid.name));
  }
  const auto factors = grid_factors(grid, given.front());
  if (factors && factors->in_area) return;
  const auto other = grid_factors(grid, exchanged(given).front());
  if (other && other->in_area)
    fail(file,
         fmt::format("easting and northing look exchanged: only so they are in the area of {}",
                     grid.name));
  const auto metres = grid_factors(grid, given.front() / kFeetPerMetre);
  if (metres && metres->in_area)
    fail(file,
         fmt::format("coordinates look like feet: only so they are in the area of {}", grid.name));
  fail(file, fmt::format("coordinates are outside of the area of {}: another system?", grid.name));
}

/// Lengths in the grid over those in the mission.
void require_scale(double scale, const char* what, const std::string& file) {
  if (std::abs(scale / kFeetPerMetre - 1.0) < kScaleMax)
    fail(file, fmt::format("{} between control points are {:.2f} times those of the mission: they "
                           "look like feet",
                           what, scale));
  if (std::abs(scale - 1.0) > kScaleMax)
    fail(file, fmt::format("{} between control points are {:.2f} times those of the mission: "
                           "another unit, or a point that is not where the file says?",
                           what, scale));
}

void require_heights(const std::vector<ControlPoint>& points, const std::string& file) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e12);  // given, in the mission
  Eigen::Vector2d high = -low;
  for (const ControlPoint& point : points) {
    if (!point.row.elevation_m) continue;
    const Eigen::Vector2d z(*point.row.elevation_m, point.p_map.z());
    low = low.cwiseMin(z);
    high = high.cwiseMax(z);
  }
  const Eigen::Vector2d climb = high - low;
  if (climb.minCoeff() > kClimbMinM &&
      std::abs(climb[0] / climb[1] / kFeetPerMetre - 1.0) < kScaleMax)
    fail(file, fmt::format("climbs between control points are {:.2f} times those of the mission: "
                           "elevations look like feet",
                           climb[0] / climb[1]));
}

}  // namespace

std::vector<ControlPoint> find_control(const std::vector<ControlRow>& rows,
                                       const SurveyInput& input, const SurveyGraph& free_network,
                                       const std::string& file) {
  std::vector<ControlPoint> points;
  points.reserve(rows.size());
  for (const ControlRow& row : rows) points.push_back(find(row, input, free_network, file));
  return points;
}

PlanFit fit_plan(const std::vector<Eigen::Vector2d>& from, const std::vector<Eigen::Vector2d>& to) {
  const auto n = static_cast<double>(from.size());
  Eigen::Vector2d middle_from(0.0, 0.0);
  Eigen::Vector2d middle_to(0.0, 0.0);
  for (std::size_t i = 0; i < from.size(); ++i) {
    middle_from += from[i] / n;
    middle_to += to[i] / n;
  }
  double dot = 0.0;
  double cross = 0.0;
  double square_from = 0.0;
  double square_to = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Eigen::Vector2d a = from[i] - middle_from;
    const Eigen::Vector2d b = to[i] - middle_to;
    dot += a.dot(b);
    cross += a.x() * b.y() - a.y() * b.x();
    square_from += a.squaredNorm();
    square_to += b.squaredNorm();
  }
  PlanFit fit;
  const Pose2 turn{0.0, 0.0, std::atan2(cross, dot)};
  const Eigen::Vector2d t = middle_to - turn * middle_from;
  fit.T_to_from = {t.x(), t.y(), turn.theta};
  for (std::size_t i = 0; i < from.size(); ++i)
    fit.rms_m += (to[i] - fit.T_to_from * from[i]).squaredNorm() / n;
  fit.rms_m = std::sqrt(fit.rms_m);
  fit.scale = square_from > 0.0 ? std::sqrt(square_to / square_from) : 1.0;
  return fit;
}

void require_plausible(const std::vector<ControlPoint>& points, const GridSystem& grid,
                       const std::string& file) {
  std::vector<Eigen::Vector2d> given;
  std::vector<Eigen::Vector2d> in_map;
  for (const ControlPoint& point : points) {
    if (!point.row.plan) continue;
    given.push_back(*point.row.plan);
    in_map.emplace_back(point.p_map.head<2>());
  }
  if (given.size() < 2)
    fail(file,
         "a survey on a grid needs two points with easting and northing: one fixes no bearing");
  require_system(given, grid, file);
  double apart_m = 0.0;
  for (const Eigen::Vector2d& p : in_map) apart_m = std::max(apart_m, (p - in_map.front()).norm());
  if (apart_m < kApartMinM)
    fail(file, fmt::format("control points are within {:.1f} m of each other: they fix no bearing",
                           apart_m));
  const PlanFit fit = fit_plan(in_map, given);
  require_scale(fit.scale, "distances", file);
  const double reflected_m = fit_plan(in_map, exchanged(given)).rms_m;
  if (given.size() > 2 && fit.rms_m > kMisfitMinM && reflected_m < kReflectedShare * fit.rms_m) {
    fail(file, fmt::format("easting and northing look exchanged: so they fit to {:.2f} m, as given "
                           "to {:.1f} m",
                           reflected_m, fit.rms_m));
  }
  require_heights(points, file);
}

}  // namespace adit
