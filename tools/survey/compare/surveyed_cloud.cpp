// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/compare/surveyed_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "common/files/file_error.hpp"
#include "tools/survey/files/las_reader.hpp"
#include "tools/survey/files/scan_table.hpp"
#include "tools/survey/points/point_index.hpp"

namespace adit {
namespace {

/// Sums of the standard deviations of the points of a scan, which tell those of its pose: the
/// least is that of its place, its growth with the distance that of its rotation.
struct DeviationSums {
  double plan_min_m = std::numeric_limits<double>::infinity();
  double z_min_m = std::numeric_limits<double>::infinity();
  double plan_m2 = 0.0;  ///< sum of variances
  double z_m2 = 0.0;
  double lever_m2 = 0.0;  ///< sum of squared distances in plan
  double points = 0.0;

  void add(const LasPoint& point, const Eigen::Vector3d& from_laser) {
    plan_min_m = std::min(plan_min_m, static_cast<double>(point.plan_sd_m));
    z_min_m = std::min(z_min_m, static_cast<double>(point.z_sd_m));
    plan_m2 += std::pow(static_cast<double>(point.plan_sd_m), 2);
    z_m2 += std::pow(static_cast<double>(point.z_sd_m), 2);
    lever_m2 += from_laser.head<2>().squaredNorm();
    points += 1.0;
  }
  [[nodiscard]] Matrix6d covariance() const {
    const double plan = plan_min_m * plan_min_m;
    const double z = z_min_m * z_min_m;
    const double lever = std::max(1e-6, lever_m2);
    const double turn = std::max(0.0, plan_m2 - points * plan) / lever;
    const double tilt = std::max(0.0, z_m2 - points * z) / lever;
    Vector6d variances;
    variances << plan, plan, z, tilt, tilt, turn;
    return variances.asDiagonal();
  }
};

/// The step of a scan without points is a part of that to the next one.
void remove_empty(std::vector<SurveyedScan>& scans) {
  for (std::size_t i = 0; i + 1 < scans.size(); ++i) {
    if (!scans[i].points.empty()) continue;
    SurveyedScan& next = scans[i + 1];
    next.step_sd_m = std::hypot(next.step_sd_m, scans[i].step_sd_m);
    next.step_turn_sd_rad = std::hypot(next.step_turn_sd_rad, scans[i].step_turn_sd_rad);
    next.step_z_sd_m = std::hypot(next.step_z_sd_m, scans[i].step_z_sd_m);
  }
  std::erase_if(scans, [](const SurveyedScan& scan) { return scan.points.empty(); });
}

}  // namespace

std::size_t SurveyedCloud::points() const {
  std::size_t sum = 0;
  for (const SurveyedScan& scan : scans) sum += scan.points.size();
  return sum;
}

SurveyedCloud read_surveyed_cloud(const std::filesystem::path& folder, double voxel_m,
                                  double range_max_m, const Eigen::Vector3d* origin) {
  const std::filesystem::path las = folder / "cloud.las";
  const ScanTable table = read_scan_table(folder / "survey.gpkg");
  if (table.scans.empty())
    throw FileError(fmt::format("{}: a survey without 3D scans", folder.string()));
  SurveyedCloud cloud;
  cloud.origin = origin != nullptr ? *origin : table.scans.front().laser;
  cloud.crs_wkt = table.crs_wkt;
  cloud.crs_name = table.crs_name;
  std::unordered_map<std::int64_t, std::size_t> scan_at;
  for (const ScanPlace& place : table.scans) {
    scan_at.emplace(place.number, cloud.scans.size());
    SurveyedScan scan{place.number, place.laser - cloud.origin, {}};
    scan.step_sd_m = place.step_sd_m;
    scan.step_turn_sd_rad = place.step_turn_sd_rad;
    scan.step_z_sd_m = place.step_z_sd_m;
    cloud.scans.push_back(std::move(scan));
  }
  std::vector<DeviationSums> sums(cloud.scans.size());
  std::vector<std::unordered_set<std::uint64_t>> taken(cloud.scans.size());
  std::size_t last = cloud.scans.size();
  read_las(las, [&](const LasPoint& point) {
    const auto found = scan_at.find(point.scan);
    if (found == scan_at.end())
      throw FileError(fmt::format("{}: scan {} is not in survey.gpkg", las.string(), point.scan));
    const std::size_t at = found->second;
    if (at != last && last < taken.size()) taken[last] = {};  // a scan's points follow each other
    last = at;
    SurveyedScan& scan = cloud.scans[at];
    const Eigen::Vector3d p = point.p - cloud.origin - scan.laser;
    if (p.norm() > range_max_m) return;
    sums[at].add(point, p);
    if (taken[at].insert(voxel_key(p, voxel_m)).second) scan.points.push_back(p.cast<float>());
  });
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (sums[i].points > 0.0) cloud.scans[i].covariance = sums[i].covariance();
  }
  remove_empty(cloud.scans);
  if (cloud.scans.empty()) throw FileError(fmt::format("{}: no points", las.string()));
  return cloud;
}

}  // namespace adit
