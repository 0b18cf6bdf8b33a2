// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/compare/surface_distances.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

#include "common/geometry/symmetric_eigen.hpp"
#include "tools/survey/points/point_index.hpp"

namespace adit {
namespace {

constexpr double kIndexCellM = 0.25;
constexpr int kNormalPointsMin = 8;
constexpr double kFlatness =
    0.3;  // maximum ratio of the smallest to the middle variance: a surface
constexpr std::size_t kProgressEvery = 4096;

PointIndex index_of(const SurveyedCloud& cloud, const std::vector<ScanPlacement>& at) {
  std::vector<ComparedPoint> points;
  points.reserve(cloud.points());
  for (std::size_t i = 0; i < cloud.scans.size(); ++i) {
    for (const Eigen::Vector3f& p : cloud.scans[i].points) {
      const Eigen::Vector3d in_comparison = at[i].T_comparison_scan * p.cast<double>();
      points.push_back({in_comparison.cast<float>(), static_cast<std::uint32_t>(i)});
    }
  }
  return {std::move(points), kIndexCellM};
}

/// The means of the points by voxel, in the order of the points.
std::vector<Eigen::Vector3d> core_places(const PointIndex& index, double spacing_m) {
  std::unordered_map<std::uint64_t, std::size_t> core_at;
  std::vector<std::pair<Eigen::Vector3d, int>> sums;
  for (const ComparedPoint& point : index.points()) {
    const Eigen::Vector3d p = point.p.cast<double>();
    const auto [entry, is_new] = core_at.try_emplace(voxel_key(p, spacing_m), sums.size());
    if (is_new) sums.emplace_back(Eigen::Vector3d::Zero(), 0);
    auto& [sum, count] = sums[entry->second];
    sum += p;
    ++count;
  }
  std::vector<Eigen::Vector3d> places;
  places.reserve(sums.size());
  for (const auto& [sum, count] : sums) places.emplace_back(sum / count);
  return places;
}

/// The normal of the surface around a place, towards the lasers; nothing where it is no surface.
std::optional<Eigen::Vector3d> normal_at(const Eigen::Vector3d& p, const PointIndex& index,
                                         const std::vector<ScanPlacement>& at, double radius_m) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_lasers = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  int count = 0;
  index.for_each_around(p, radius_m, [&](const ComparedPoint& point) {
    const Eigen::Vector3d d = point.p.cast<double>() - p;
    sum += d;
    squares += d * d.transpose();
    to_lasers += (at[point.scan].laser() - p).normalized();
    ++count;
  });
  if (count < kNormalPointsMin) return std::nullopt;
  const auto eigen =
      symmetric_eigen(Eigen::Matrix3d(squares / count - sum * sum.transpose() / (count * count)));
  if (eigen.values[0] > kFlatness * eigen.values[1]) return std::nullopt;
  const Eigen::Vector3d n = eigen.vectors.col(0);
  return n.dot(to_lasers) < 0.0 ? Eigen::Vector3d(-n) : n;
}

/// A return in a cylinder.
struct AlongNormal {
  double h_m = 0.0;  ///< from the core point
  std::uint32_t scan = 0;
};

/// A surface in a cylinder.
struct Layer {
  double h_m = 0.0;
  double variance = 0.0;  ///< of that height, beside the error of both surveys' ranges
};

/// The variance of the mean of scans: their scatter, or what they state where there is one.
double scatter_of_scans(std::span<const AlongNormal> layer, double mean_m) {
  double squares = 0.0;
  int scans = 0;
  for (std::size_t first = 0; first < layer.size();) {
    std::size_t last = first;
    double sum = 0.0;
    for (; last < layer.size() && layer[last].scan == layer[first].scan; ++last)
      sum += layer[last].h_m;
    const double of_scan = sum / static_cast<double>(last - first);
    squares += (of_scan - mean_m) * (of_scan - mean_m);
    ++scans;
    first = last;
  }
  return scans < 2 ? 0.0 : squares / ((scans - 1.0) * scans);
}

std::optional<Layer> layer_at(const Eigen::Vector3d& p, const Eigen::Vector3d& n,
                              const PointIndex& index, const std::vector<ScanPlacement>& at,
                              const SurfaceDistanceParams& params,
                              std::vector<AlongNormal>& returns) {
  returns.clear();
  index.for_each_along(
      p, n, params.cylinder_radius_m, params.depth_m, [&](const ComparedPoint& point, double h_m) {
        const Eigen::Vector3d to_laser = at[point.scan].laser() - point.p.cast<double>();
        if (to_laser.dot(n) > 0.0) returns.push_back({h_m, point.scan});
      });
  const auto enough = static_cast<std::size_t>(params.points_min);
  if (returns.size() < enough) return std::nullopt;
  const auto middle = returns.begin() + static_cast<std::ptrdiff_t>(returns.size() / 2);
  std::nth_element(returns.begin(), middle, returns.end(),
                   [](const AlongNormal& a, const AlongNormal& b) { return a.h_m < b.h_m; });
  const double median_m = middle->h_m;
  std::erase_if(returns, [&](const AlongNormal& point) {
    return std::abs(point.h_m - median_m) > params.layer_m;
  });
  if (returns.size() < enough) return std::nullopt;
  std::ranges::sort(returns, {}, [](const AlongNormal& a) { return std::pair(a.scan, a.h_m); });
  Layer layer;
  for (const AlongNormal& point : returns) layer.h_m += point.h_m;
  const auto count = static_cast<double>(returns.size());
  layer.h_m /= count;
  double squares = 0.0;
  for (const AlongNormal& point : returns)
    squares += (point.h_m - layer.h_m) * (point.h_m - layer.h_m);
  const double measurements = std::max(1.0, count / params.points_per_measurement);
  double placed = 0.0;
  for (const AlongNormal& point : returns)
    placed += at[point.scan].variance_along(p, n) / count;  // errors of neighbours are alike
  layer.variance = squares / count / measurements + scatter_of_scans(returns, layer.h_m) + placed;
  return layer;
}

/// Of a surface that fills a part of its voxel: a plane through voxels of side s meets
/// (|nx| + |ny| + |nz|) of them per s² of its area.
double area_of_core(const Eigen::Vector3d& n, double spacing_m) {
  return spacing_m * spacing_m / n.cwiseAbs().sum();
}

}  // namespace

bool SurfaceDistance::is_measured() const { return std::isfinite(distance_m); }

bool SurfaceDistance::is_significant() const {
  return is_measured() && std::abs(distance_m) > detection_m();
}

std::vector<SurfaceDistance> surface_distances(const SurveyedCloud& older,
                                               const std::vector<ScanPlacement>& older_at,
                                               const SurveyedCloud& newer,
                                               const std::vector<ScanPlacement>& newer_at,
                                               const SurfaceDistanceParams& params,
                                               const std::function<void(double done)>& progress) {
  const PointIndex older_index = index_of(older, older_at);
  const PointIndex newer_index = index_of(newer, newer_at);
  const std::vector<Eigen::Vector3d> places = core_places(older_index, params.spacing_m);
  std::vector<SurfaceDistance> distances;
  distances.reserve(places.size());
  std::vector<AlongNormal> returns;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (progress && i % kProgressEvery == 0)
      progress(static_cast<double>(i) / static_cast<double>(places.size()));
    const Eigen::Vector3d& p = places[i];
    const auto n = normal_at(p, older_index, older_at, params.normal_radius_m);
    if (!n) continue;
    const auto before = layer_at(p, *n, older_index, older_at, params, returns);
    if (!before) continue;
    SurfaceDistance distance{p, *n, area_of_core(*n, params.spacing_m)};
    if (const auto after = layer_at(p, *n, newer_index, newer_at, params, returns)) {
      distance.distance_m = after->h_m - before->h_m;
      distance.sd_m =
          std::sqrt(before->variance + after->variance + 2.0 * params.scan_sd_m * params.scan_sd_m);
    }
    distances.push_back(distance);
  }
  return distances;
}

}  // namespace adit
