// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/doubt_list.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kJoinedM = 2.0;  // less than the length of a local map
constexpr std::size_t kStretchesMax = 200;
constexpr std::size_t kTold = 5;  // stretches in a line of text
constexpr double kLongS = 10.0;   // in which a body without sensors may have gone metres

const char* reason_text(MatchDoubt::Reason reason) {
  switch (reason) {
    case MatchDoubt::Reason::kLost:
      return "lost";
    case MatchDoubt::Reason::kPoor:
      return "poor match";
    case MatchDoubt::Reason::kAmbiguous:
      return "ambiguous";
    case MatchDoubt::Reason::kDegenerate:
      return "degenerate";
    case MatchDoubt::Reason::kContradicted:
      break;
  }
  return "contradicted by sensors";
}

/// Distance travelled up to each pose [m].
std::vector<double> distances(const Trajectory& path) {
  std::vector<double> along(path.size(), 0.0);
  for (std::size_t i = 1; i < path.size(); ++i) {
    along[i] = along[i - 1] + between(path[i - 1].pose, path[i].pose).translation().norm();
  }
  return along;
}

double distance_at(std::int64_t utime, const Trajectory& path, const std::vector<double>& along) {
  if (path.empty()) return 0.0;
  const auto pose = std::ranges::lower_bound(path, utime, {}, &TimedPose::utime);
  const auto i = static_cast<std::size_t>(pose - path.begin());
  return along[std::min(i, along.size() - 1)];
}

void add_reasons(const std::vector<std::string>& more, std::vector<std::string>& reasons) {
  for (const std::string& reason : more) {
    if (std::ranges::find(reasons, reason) == reasons.end()) reasons.push_back(reason);
  }
}

/// Appends a stretch, or extends the last one if it ends at most `joined_m` before.
void append(const DoubtfulStretch& next, double joined_m, std::vector<DoubtfulStretch>& all) {
  if (all.empty() || next.from_m - all.back().to_m > joined_m) {
    all.push_back(next);
    return;
  }
  DoubtfulStretch& last = all.back();
  last.from_utime = std::min(last.from_utime, next.from_utime);
  last.from_m = std::min(last.from_m, next.from_m);
  last.to_utime = std::max(last.to_utime, next.to_utime);
  last.to_m = std::max(last.to_m, next.to_m);
  last.motions += next.motions;
  last.alternatives = std::max(last.alternatives, next.alternatives);
  add_reasons(next.reasons, last.reasons);
}

std::vector<DoubtfulStretch> joined(const std::vector<DoubtfulStretch>& stretches,
                                    double joined_m) {
  std::vector<DoubtfulStretch> result;
  for (const DoubtfulStretch& stretch : stretches) append(stretch, joined_m, result);
  return result;
}

/// Ids of consecutive local maps.
struct MapInterval {
  int first = 0;
  int last = 0;
};

/// The fewest intervals such that the path between the maps of each contradiction contains one: the
/// intersections of as many as possible, from the one that ends first.
std::vector<MapInterval> common_intervals(std::vector<MapContradiction> contradictions) {
  std::ranges::stable_sort(contradictions, {}, &MapContradiction::newer_map);
  std::vector<MapInterval> intervals;
  int end = -1;  // of the first interval in the intersection
  for (const MapContradiction& pair : contradictions) {
    if (pair.older_map >= end) {
      end = pair.newer_map;
      intervals.push_back({pair.older_map, pair.newer_map});
    } else {
      intervals.back().first = std::max(intervals.back().first, pair.older_map);
    }
  }
  return intervals;
}

/// Whether nothing measured how far the body went: the distances of the stretch are as doubtful.
bool is_unmeasured(const DoubtfulStretch& stretch) {
  const auto has = [&](MatchDoubt::Reason reason) {
    return std::ranges::find(stretch.reasons, reason_text(reason)) != stretch.reasons.end();
  };
  return has(MatchDoubt::Reason::kLost) || has(MatchDoubt::Reason::kDegenerate);
}

std::string stretch_text(const DoubtfulStretch& stretch) {
  std::string reasons = fmt::format("{}", fmt::join(stretch.reasons, ", "));
  const double duration_s = seconds(stretch.to_utime - stretch.from_utime);
  if (is_unmeasured(stretch) && duration_s >= kLongS) {
    reasons += fmt::format(", for {:.0f} s", duration_s);
  }
  if (stretch.to_m - stretch.from_m < 0.5) {
    return fmt::format("at {:.0f} m ({})", stretch.from_m, reasons);
  }
  return fmt::format("at {:.0f} to {:.0f} m ({})", stretch.from_m, stretch.to_m, reasons);
}

}  // namespace

std::vector<DoubtfulStretch> contradictory_stretches(
    const std::vector<MapContradiction>& contradictions, const Trajectory& path,
    const std::vector<const LocalMap*>& local_maps) {
  const std::vector<double> along = distances(path);
  std::vector<DoubtfulStretch> stretches;
  for (const MapInterval& common : common_intervals(contradictions)) {
    DoubtfulStretch stretch;
    stretch.reasons = {"contradictory"};
    for (const LocalMap* map : local_maps) {
      if (map->id < common.first || map->id > common.last || map->end_utime == 0) continue;
      if (stretch.local_maps.empty()) stretch.from_utime = map->utime;
      stretch.to_utime = map->end_utime;
      stretch.local_maps.push_back(map->id);
    }
    if (stretch.local_maps.empty()) continue;  // of earlier runs
    stretch.from_m = distance_at(stretch.from_utime, path, along);
    stretch.to_m = distance_at(stretch.to_utime, path, along);
    stretches.push_back(std::move(stretch));
  }
  return stretches;
}

std::vector<DoubtfulStretch> doubtful_stretches(const std::vector<MatchDoubt>& doubts,
                                                const std::vector<MapContradiction>& contradictions,
                                                const Trajectory& odometry,
                                                const std::vector<LocalMap>& local_maps) {
  const std::vector<double> along = distances(odometry);
  std::vector<DoubtfulStretch> stretches;
  for (const MatchDoubt& doubt : doubts) {
    const double from_m = distance_at(doubt.from_utime, odometry, along);
    const double to_m = distance_at(doubt.utime, odometry, along);
    stretches.push_back({doubt.from_utime,
                         doubt.utime,
                         from_m,
                         to_m,
                         1,
                         doubt.alternatives.size(),
                         {reason_text(doubt.reason)},
                         {}});
  }
  double joined_m = kJoinedM;
  stretches = joined(stretches, joined_m);
  while (stretches.size() > kStretchesMax) {
    joined_m *= 2.0;
    stretches = joined(stretches, joined_m);
  }
  for (DoubtfulStretch& stretch : stretches) {
    for (const LocalMap& map : local_maps) {
      const bool overlaps = map.utime <= stretch.to_utime && map.end_utime >= stretch.from_utime;
      if (overlaps) stretch.local_maps.push_back(map.id);
    }
  }
  std::vector<const LocalMap*> maps;
  for (const LocalMap& map : local_maps) maps.push_back(&map);
  std::vector<DoubtfulStretch> all = contradictory_stretches(contradictions, odometry, maps);
  all.insert(all.end(), stretches.begin(), stretches.end());
  return all;
}

std::string stretches_text(const std::vector<DoubtfulStretch>& stretches) {
  if (stretches.empty()) return {};
  std::vector<std::string> told;
  for (const DoubtfulStretch& stretch : stretches) {
    if (told.size() == kTold) break;
    told.push_back(stretch_text(stretch));
  }
  const std::size_t more = stretches.size() - told.size();
  return fmt::format("{} doubtful stretch{}: {}{}", stretches.size(),
                     stretches.size() == 1 ? "" : "es", fmt::join(told, ", "),
                     more > 0 ? fmt::format(" and {} more, see summary.json", more) : "");
}

std::vector<bool> in_stretches(const std::vector<DoubtfulStretch>& stretches,
                               const Trajectory& trajectory) {
  std::vector<bool> inside;
  inside.reserve(trajectory.size());
  for (const TimedPose& pose : trajectory) {
    inside.push_back(std::ranges::any_of(stretches, [&](const DoubtfulStretch& stretch) {
      return stretch.from_utime <= pose.utime && pose.utime <= stretch.to_utime;
    }));
  }
  return inside;
}

}  // namespace adit
