// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/doubt_list.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kJoinedM = 2.0;  // less than the length of a local map
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
  for (const int map : next.local_maps) {
    if (last.local_maps.empty() || map > last.local_maps.back()) last.local_maps.push_back(map);
  }
  add_reasons(next.reasons, last.reasons);
}

/// Few stretches from any number in order: those that are near are joined, over twice the distance
/// whenever there are too many.
class StretchList {
 public:
  explicit StretchList(double joined_m) : joined_m_(joined_m) {}

  void add(const DoubtfulStretch& next) {
    append(next, joined_m_, stretches_);
    while (stretches_.size() > kStretchesMax) {
      joined_m_ *= 2.0;
      std::vector<DoubtfulStretch> joined;
      for (const DoubtfulStretch& stretch : stretches_) append(stretch, joined_m_, joined);
      stretches_ = std::move(joined);
    }
  }

  [[nodiscard]] std::vector<DoubtfulStretch>& stretches() { return stretches_; }

 private:
  double joined_m_;
  std::vector<DoubtfulStretch> stretches_;
};

std::vector<DoubtfulStretch> fewer(const std::vector<DoubtfulStretch>& stretches) {
  StretchList list(kJoinedM);
  for (const DoubtfulStretch& stretch : stretches) list.add(stretch);
  return std::move(list.stretches());
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

double DistanceAlong::operator()(std::int64_t utime) const {
  if (points_.empty()) return 0.0;
  const auto point = std::ranges::lower_bound(points_, utime, {}, &Point::utime);
  return point == points_.end() ? points_.back().distance_m : (*point).distance_m;
}

void DistanceAlong::add(const TimedPose& pose) {
  if (last_) distance_m_ += between(*last_, pose.pose).translation().norm();
  last_ = pose.pose;
  points_.push_back({pose.utime, distance_m_});
}

std::vector<DoubtfulStretch> contradictory_stretches(
    const std::vector<MapContradiction>& contradictions, const DistanceAlong& distance_at,
    const std::vector<const LocalMap*>& local_maps) {
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
    stretch.from_m = distance_at(stretch.from_utime);
    stretch.to_m = distance_at(stretch.to_utime);
    stretches.push_back(std::move(stretch));
  }
  return stretches;
}

std::vector<DoubtfulStretch> doubtful_stretches(const Spool<MotionDoubt>& doubts,
                                                const std::vector<MapContradiction>& contradictions,
                                                const DistanceAlong& distance_at,
                                                const std::vector<LocalMap>& local_maps) {
  StretchList motions(kJoinedM);
  for (const MotionDoubt& doubt : doubts) {
    motions.add({doubt.from_utime,
                 doubt.utime,
                 distance_at(doubt.from_utime),
                 distance_at(doubt.utime),
                 1,
                 doubt.alternatives,
                 {reason_text(doubt.reason)},
                 {}});
  }
  for (DoubtfulStretch& stretch : motions.stretches()) {
    for (const LocalMap& map : local_maps) {
      const bool overlaps = map.utime <= stretch.to_utime && map.end_utime >= stretch.from_utime;
      if (overlaps) stretch.local_maps.push_back(map.id);
    }
  }
  std::vector<const LocalMap*> maps;
  for (const LocalMap& map : local_maps) maps.push_back(&map);
  std::vector<DoubtfulStretch> all = contradictory_stretches(contradictions, distance_at, maps);
  if (all.size() > kStretchesMax) all = fewer(all);
  all.insert(all.end(), motions.stretches().begin(), motions.stretches().end());
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

bool in_stretches(const std::vector<DoubtfulStretch>& stretches, std::int64_t utime) {
  return std::ranges::any_of(stretches, [utime](const DoubtfulStretch& stretch) {
    return stretch.from_utime <= utime && utime <= stretch.to_utime;
  });
}

}  // namespace adit
