// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/section/cross_section.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <utility>

#include <Eigen/Cholesky>

#include "common/geometry/order_statistics.hpp"
#include "common/grid/grid2.hpp"
#include "common/pose_graph/map_correction.hpp"

namespace adit {
namespace {

constexpr double kDirectionM = 1.5;      // to either side, over which the direction is taken
constexpr double kSurfaceGapM = 0.3;     // between returns of one surface and of another behind it
constexpr double kBelowM = 4.0;          // of the path, where returns are looked for,
constexpr double kAboveM = 12.0;         // and above it
constexpr double kFloorShareM = 0.3;     // to either side of the centre line, for floor and roof
constexpr double kSurfaceM = 0.3;        // thickness of their relief
constexpr double kHeightDefaultM = 1.4;  // where no roof is seen

constexpr double kOpeningShare = 0.9;  // of the width of a tunnel: reach of a junction
constexpr double kNicheShare = 1.5;    // of it: a section that is wider opens to a side

/// A return in the frame of a section.
struct SectionReturn {
  float u_m = 0.0F;
  float z_m = 0.0F;  ///< in survey
  float v_m = 0.0F;  ///< along the centre line, from the plane
  float sd_m = 0.0F;
  int scan = 0;
};

/// The sections near each cell of a coarse grid of the plan.
class PlaneIndex {
 public:
  PlaneIndex(const std::vector<SectionPlane>& planes, const SectionParams& params) {
    for (std::size_t i = 0; i < planes.size(); ++i) {
      for (double u = -params.reach_m; u <= params.reach_m; u += kCellM / 2.0) {
        const Eigen::Vector2i cell = cell_of(planes[i].p_survey + u * planes[i].left(), kCellM);
        for (int x = -1; x <= 1; ++x) {
          for (int y = -1; y <= 1; ++y) add({cell.x() + x, cell.y() + y}, i);
        }
      }
    }
  }

  [[nodiscard]] std::span<const std::size_t> near(const Eigen::Vector2d& p_survey) const {
    const Eigen::Vector2i cell = cell_of(p_survey, kCellM);
    const auto found = planes_.find({cell.x(), cell.y()});
    if (found == planes_.end()) return {};
    return found->second;
  }

 private:
  static constexpr double kCellM = 1.0;  // above the thickness of a slab

  void add(const std::pair<int, int>& cell, std::size_t plane) {
    std::vector<std::size_t>& of_cell = planes_[cell];
    if (of_cell.empty() || of_cell.back() != plane) of_cell.push_back(plane);
  }

  std::map<std::pair<int, int>, std::vector<std::size_t>> planes_;
};

std::vector<std::vector<SectionReturn>> returns_by_plane(const RegisteredCloud& cloud,
                                                         const std::vector<SectionPlane>& planes,
                                                         const SectionParams& params) {
  const PlaneIndex index(planes, params);
  std::vector<std::vector<SectionReturn>> returns(planes.size());
  cloud.for_each_point([&](const SurveyPoint& point) {
    const Eigen::Vector2d p = point.p_survey.head<2>();
    for (const std::size_t i : index.near(p)) {
      const SectionPlane& plane = planes[i];
      const double v = (p - plane.p_survey).dot(plane.along);
      const double u = (p - plane.p_survey).dot(plane.left());
      const double z = point.p_survey.z();
      if (std::abs(v) > params.half_slab_m || std::abs(u) > params.reach_m) continue;
      if (z < plane.z_path_m - kBelowM || z > plane.z_path_m + kAboveM) continue;
      const Eigen::Vector3d from_scan = point.p_survey - point.scan->T_survey_level.translation();
      if (from_scan.head<2>().norm() > params.range_max_m) continue;
      const double sd_m = std::sqrt(cloud.scan_covariance(point)(2, 2));
      returns[i].push_back({static_cast<float>(u), static_cast<float>(z), static_cast<float>(v),
                            static_cast<float>(sd_m), point.scan->number});
    }
  });
  return returns;
}

/// The middle of the surface nearest to the open space: of the values up to kSurfaceM behind the
/// third one, since the first ones may be strays. `distances`: from the open space.
double nearest_surface_m(std::vector<double> distances) {
  std::ranges::sort(distances);
  const double begin = distances[std::min<std::size_t>(2, distances.size() - 1)];
  const auto end = std::ranges::upper_bound(distances, begin + kSurfaceM);
  return median({distances.begin(), end});
}

/// Halfway between the floor and the roof at the centre line.
double middle_height_m(const std::vector<SectionReturn>& returns, const SectionPlane& plane,
                       const SectionParams& params) {
  const double open_m = plane.z_path_m + params.middle_m;
  std::vector<double> below;
  std::vector<double> above;
  for (const SectionReturn& at : returns) {
    if (std::abs(at.u_m) > kFloorShareM) continue;
    (at.z_m < open_m ? below : above).push_back(std::abs(at.z_m - open_m));
  }
  const double floor_m =
      below.empty() ? plane.z_path_m : open_m - nearest_surface_m(std::move(below));
  const double roof_m =
      above.empty() ? floor_m + kHeightDefaultM : open_m + nearest_surface_m(std::move(above));
  return 0.5 * (floor_m + roof_m);
}

/// A return by its distance along a ray.
struct RayReturn {
  double distance_m = 0.0;
  double angle_rad = 0.0;  ///< from the ray
  double v_m = 0.0;
  double sd_m = 0.0;
  int scan = 0;
};

/// The returns of the nearest surface: up to the first gap.
std::vector<RayReturn> nearest_surface(std::vector<RayReturn> returns) {
  std::ranges::sort(returns, {}, &RayReturn::distance_m);
  const auto is_gap = [](const RayReturn& a, const RayReturn& b) {
    return b.distance_m - a.distance_m > kSurfaceGapM;
  };
  auto begin = returns.begin();
  auto gap = std::adjacent_find(begin, returns.end(), is_gap);
  // A single return before a surface of many is a mixed pixel.
  while (gap != returns.end() && gap == begin && returns.end() - gap > 3) {
    begin = gap + 1;
    gap = std::adjacent_find(begin, returns.end(), is_gap);
  }
  const auto end = gap == returns.end() ? gap : gap + 1;
  return {begin, end};
}

/// Distance on the ray and in the plane, of the returns around it.
SectionOutline::Ray fit_ray(const std::vector<RayReturn>& returns) {
  if (returns.empty()) return {};
  std::vector<double> distances;
  for (const RayReturn& at : returns) distances.push_back(at.distance_m);
  const double middle_m = median(std::move(distances));
  // Slopes beyond 1 m/rad times the distance, and 1 m/m, are not those of a surface seen here.
  Eigen::Matrix3d A = Eigen::Vector3d(0.0, 1e-3, 1e-3).asDiagonal();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const RayReturn& at : returns) {
    const Eigen::Vector3d row(1.0, at.angle_rad * middle_m, at.v_m);
    A += row * row.transpose();
    b += row * (at.distance_m - middle_m);
  }
  const Eigen::Vector3d fit = A.ldlt().solve(b);
  double square = 0.0;
  double sd_m = returns.front().sd_m;
  std::set<int> scans;
  for (const RayReturn& at : returns) {
    const Eigen::Vector3d row(1.0, at.angle_rad * middle_m, at.v_m);
    square += std::pow(at.distance_m - middle_m - row.dot(fit), 2);
    sd_m = std::min(sd_m, at.sd_m);
    scans.insert(at.scan);
  }
  // Returns of one scan share its errors: each scan counts as one observation.
  const double scatter_m = std::sqrt(square / static_cast<double>(returns.size()));
  const double n = static_cast<double>(scans.size());
  return {middle_m + fit[0], std::hypot(scatter_m, sd_m) / std::sqrt(n)};
}

SectionOutline outline_of(const std::vector<SectionReturn>& returns, double z_middle_m) {
  constexpr std::size_t kRays = SectionOutline::kRays;
  constexpr double kStep = SectionOutline::kStepRad;
  std::vector<std::vector<RayReturn>> by_ray(kRays);
  for (const SectionReturn& at : returns) {
    const double z = at.z_m - z_middle_m;
    const double angle = std::atan2(z, at.u_m) / kStep;
    const double nearest = std::round(angle);
    const int turn = static_cast<int>(kRays);
    const int wrapped = (static_cast<int>(nearest) + turn) % turn;
    const auto ray = static_cast<std::size_t>(wrapped);
    by_ray[ray].push_back(
        {std::hypot(at.u_m, z), (angle - nearest) * kStep, at.v_m, at.sd_m, at.scan});
  }
  SectionOutline outline;
  for (std::size_t i = 0; i < kRays; ++i)
    outline.rays[i] = fit_ray(nearest_surface(std::move(by_ray[i])));
  outline.close_small_gaps();
  return outline;
}

/// Height of the end of a vertical ray, in survey.
Measured height_of(const SectionOutline::Ray& ray, double z_middle_m, double sign,
                   double z_variance) {
  return {z_middle_m + sign * ray.distance_m, std::sqrt(ray.sd_m * ray.sd_m + z_variance)};
}

}  // namespace

/// The opening of a junction reaches as far along a tunnel as the other one is wide, at most.
bool CentreLine::is_in_junction(double chainage_m) const {
  return (from_junction && chainage_m < kOpeningShare * width_m) ||
         (to_junction && line.length_m() - chainage_m < kOpeningShare * width_m);
}

bool CrossSection::has_width() const {
  return !plane.in_junction && std::isfinite(measures.width_m.value) &&
         measures.width_m.value <= kNicheShare * plane.width_expected_m;
}

std::vector<CentreLine> centre_lines(const CorridorGraph& corridors, const SurveyGraph& graph) {
  std::vector<CentreLine> lines;
  for (const Corridor& corridor : corridors.corridors) {
    if (corridor.points.empty()) continue;
    std::vector<Eigen::Vector2d> points;
    for (const Eigen::Vector2d& p_map : corridor.points)
      points.push_back(graph.T_survey_map(graph.node_near(p_map)).plan * p_map);
    const auto is_junction = [&](int node) {
      return corridors.nodes[static_cast<std::size_t>(node)].kind == CorridorNode::Kind::kJunction;
    };
    lines.push_back({static_cast<int>(lines.size()) + 1, corridor.from, corridor.to,
                     corridor.width_m, is_junction(corridor.from), is_junction(corridor.to),
                     Polyline(std::move(points))});
  }
  return lines;
}

std::vector<SectionPlane> section_planes(const std::vector<CentreLine>& lines,
                                         const std::vector<Eigen::Vector3d>& path, double every_m) {
  std::vector<SectionPlane> planes;
  if (path.empty()) return planes;
  for (const CentreLine& line : lines) {
    const double length_m = line.line.length_m();
    const auto count = static_cast<int>(std::floor(length_m / every_m));
    for (int i = 0; i <= count; ++i) {
      const double chainage_m = i * every_m;
      SectionPlane plane{line.tunnel, chainage_m, line.line.at(chainage_m)};
      plane.width_expected_m = line.width_m;
      plane.in_junction = line.is_in_junction(chainage_m);
      const Eigen::Vector2d chord = line.line.chord_at(plane.chainage_m, kDirectionM);
      if (chord.norm() < 1e-6) continue;
      plane.along = chord.normalized();
      const auto nearest = std::ranges::min_element(path, {}, [&](const Eigen::Vector3d& p) {
        return (p.head<2>() - plane.p_survey).squaredNorm();
      });
      plane.z_path_m = nearest->z();
      planes.push_back(plane);
    }
  }
  return planes;
}

std::vector<CrossSection> cross_sections(const RegisteredCloud& cloud,
                                         const std::vector<SectionPlane>& planes,
                                         const SectionParams& params) {
  const auto returns = returns_by_plane(cloud, planes, params);
  const SurveyGraph& graph = cloud.graph();
  std::vector<CrossSection> sections;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (returns[i].empty()) continue;
    CrossSection section;
    section.plane = planes[i];
    section.z_middle_m = middle_height_m(returns[i], planes[i], params);
    section.outline = outline_of(returns[i], section.z_middle_m);
    section.measures = measure(section.outline, params.common_sd_m);
    const Eigen::Vector2d& p = planes[i].p_survey;
    const std::size_t node = graph.node_near_in_survey(p);
    const Eigen::Matrix3d covariance =
        graph.covariance_at(node, {p.x(), p.y(), section.z_middle_m});
    section.plan_sd_m = position_sd_m(covariance);
    section.floor_m = height_of(section.outline.rays[SectionOutline::kDown], section.z_middle_m,
                                -1.0, covariance(2, 2));
    section.roof_m = height_of(section.outline.rays[SectionOutline::kUp], section.z_middle_m, 1.0,
                               covariance(2, 2));
    sections.push_back(section);
  }
  return sections;
}

}  // namespace adit
