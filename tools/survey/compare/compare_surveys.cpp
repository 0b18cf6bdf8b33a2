// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/compare/compare_surveys.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "common/files/file_utils.hpp"
#include "common/geometry/order_statistics.hpp"
#include "tools/map/result_folder.hpp"
#include "tools/survey/compare/change_files.hpp"
#include "tools/survey/compare/change_sheet.hpp"
#include "tools/survey/compare/surveyed_cloud.hpp"
#include "tools/survey/files/geotiff_file.hpp"
#include "tools/survey/files/vector_files.hpp"
#include "tools/survey/frame/survey_frame.hpp"

namespace adit {
namespace {

constexpr double kThinnedM = 0.03;
constexpr double kScanRangeMaxM = 12.0;
constexpr double kRegisteredShareMin = 0.5;  // below, the surveys are probably not of one place
constexpr double kChi2Limit = 22.46;         // 99.9 %, six degrees of freedom
constexpr double kMovedShareMax = 0.1;

std::string registration_statement(const std::vector<ScanPlacement>& placements,
                                   bool by_coordinates) {
  std::vector<double> sds;
  std::vector<double> moved;
  std::size_t disagreed = 0;
  for (const ScanPlacement& placement : placements) {
    disagreed += placement.disagreed ? 1 : 0;
    sds.push_back(std::sqrt(placement.covariance.topLeftCorner<3, 3>().trace() / 3.0));
    if (placement.registered) moved.push_back(placement.moved_m);
  }
  if (by_coordinates) {
    return fmt::format(
        "Registered by the coordinates of both surveys: standard deviation of a scan of the newer "
        "one {:.3f} m per axis (median); all motion counts as change.",
        median(sds));
  }
  return fmt::format(
      "Registered by the clouds, scan by scan: {} of {} scans, moved by {:.3f} m from their "
      "coordinates (median; {:.3f} m at most), standard deviation {:.3f} m per axis (median). {} "
      "disagreed with their neighbours, as before a large surface that has moved. A motion of a "
      "stretch of the mine longer than a few scans does not show; compare by coordinates for it.",
      moved.size(), placements.size(), median(moved), quantile(moved, 1.0), median(sds), disagreed);
}

/// What ties both surveys to each other, a sentence.
std::string grid_statement(const std::string& crs_name) {
  if (crs_name != kLocalGridName) return fmt::format("Coordinate system: {}.", crs_name);
  return "Both surveys are in a local grid without control: their missions are taken to begin at "
         "the "
         "same place with the same heading.";
}

void add_warnings(const std::vector<ScanPlacement>& placements, CompareResult& result) {
  const auto beyond = static_cast<double>(std::ranges::count_if(
      placements, [](const ScanPlacement& at) { return at.registered && at.chi2 > kChi2Limit; }));
  if (result.registered > 0 && beyond > kMovedShareMax * static_cast<double>(result.registered)) {
    result.warnings.push_back(fmt::format(
        "{:.0f} of {} scans had to be moved farther than both surveys' accuracy explains: their "
        "starts differ, their control has an error, or a stretch of the mine has moved",
        beyond, result.registered));
  }
  if (result.registered < result.scans) {
    result.warnings.push_back(
        fmt::format("{} of {} scans have too little in common with the older survey, or disagree "
                    "with their neighbours; these place them, with a larger uncertainty",
                    result.scans - result.registered, result.scans));
  }
}

void add_sums(CompareResult& result) {
  std::vector<double> detection;
  for (const SurfaceDistance& at : result.distances) {
    if (!at.is_measured()) {
      result.unmeasured_m2 += at.area_m2;
      continue;
    }
    result.area_m2 += at.area_m2;
    if (at.is_significant()) result.significant_m2 += at.area_m2;
    detection.push_back(at.detection_m());
  }
  result.detection_median_m = median(detection);
}

std::string sum_statement(const CompareResult& result) {
  double gone_m3 = 0.0;
  double gone_sd_m3 = 0.0;
  double nearer_m3 = 0.0;
  double nearer_sd_m3 = 0.0;
  for (const ChangeRegion& region : result.regions) {
    (region.rock_gone ? gone_m3 : nearer_m3) += region.volume_m3;
    (region.rock_gone ? gone_sd_m3 : nearer_sd_m3) += region.volume_sd_m3;
  }
  return fmt::format(
      "{:.0f} m² of surface are seen by both; level of detection {:.3f} m (95 %, median); {:.1f} % "
      "exceed it (5 % by chance). {} regions of change: {:.2f} ± {:.2f} m³ of rock gone, {:.2f} ± "
      "{:.2f} m³ moved into the void (95 %). {:.0f} m² of the older survey are not seen by the "
      "newer one.",
      result.area_m2, result.detection_median_m,
      100.0 * result.significant_m2 / std::max(1e-9, result.area_m2), result.regions.size(),
      -gone_m3, 1.96 * gone_sd_m3, nearer_m3, 1.96 * nearer_sd_m3, result.unmeasured_m2);
}

}  // namespace

CompareResult compare_surveys(const CompareOptions& options, const CompareProgress& progress) {
  const auto report = [&](const char* step) {
    return [&progress, step](double done) {
      if (progress) progress(step, done);
    };
  };
  report("reading")(0.0);
  const SurveyedCloud older =
      read_surveyed_cloud(options.older, kThinnedM, kScanRangeMaxM, nullptr);
  report("reading")(0.5);
  const SurveyedCloud newer =
      read_surveyed_cloud(options.newer, kThinnedM, kScanRangeMaxM, &older.origin);
  if (older.crs_wkt != newer.crs_wkt) {
    throw std::runtime_error(
        fmt::format("the surveys are in different coordinate systems: {} and {}", older.crs_name,
                    newer.crs_name));
  }
  const SurfaceDistanceParams params;
  const std::vector<ScanPlacement> older_at = placed_by_coordinates(older);
  const std::vector<ScanPlacement> newer_at =
      options.by_coordinates ? placed_by_coordinates(newer)
                             : registered_scans(newer, older, report("registering"));
  CompareResult result;
  result.origin = older.origin;
  result.scans = newer_at.size();
  result.registered =
      static_cast<std::size_t>(std::ranges::count(newer_at, true, &ScanPlacement::registered));
  if (!options.by_coordinates && static_cast<double>(result.registered) <
                                     kRegisteredShareMin * static_cast<double>(result.scans)) {
    throw std::runtime_error(fmt::format(
        "{} of {} scans fit the older survey: not the same mine, or without control and not from "
        "the same start",
        result.registered, result.scans));
  }
  // Registered scans are placed relative to the older survey: its own errors drop out.
  std::vector<ScanPlacement> older_relative = older_at;
  if (!options.by_coordinates) {
    for (ScanPlacement& placement : older_relative) placement.covariance.setZero();
  }
  result.distances =
      surface_distances(older, older_relative, newer, newer_at, params, report("measuring"));
  add_sums(result);
  if (result.area_m2 <= 0.0) throw std::runtime_error("the surveys show no common surface");
  result.regions = change_regions(result.distances, {});
  result.statements = {grid_statement(older.crs_name),
                       registration_statement(newer_at, options.by_coordinates),
                       sum_statement(result)};
  if (!options.by_coordinates) {
    add_warnings(newer_at, result);
  } else if (older.crs_name == kLocalGridName) {
    result.warnings.emplace_back(
        "the surveys have no control: a difference of their starts counts as change");
  }

  report("writing")(0.0);
  const ResultFolder results(options.folder);
  const std::filesystem::path& folder = results.unfinished();
  write_geotiff(change_raster(result.distances, result.origin, params.spacing_m), older.crs_wkt,
                folder / "change.tif");
  write_geopackage(change_layers(result.regions, result.distances, result.origin, params.spacing_m),
                   older.crs_wkt, folder / "change.gpkg");
  write_text_file(change_table(result.regions, result.origin), folder / "changes.csv");
  write_change_sheet(result.distances, result.regions, result.origin, result.statements,
                     folder / "change.pdf");
  results.publish();
  report("writing")(1.0);
  return result;
}

}  // namespace adit
