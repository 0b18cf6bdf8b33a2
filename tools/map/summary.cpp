// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/summary.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "common/messages/codec.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/pose_graph/pose_graph.hpp"
#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

using Json = nlohmann::ordered_json;

double cpu_seconds(const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * t.tv_usec; }

/// The first ids; a person reads no more.
Json listed(const std::vector<int>& ids) {
  constexpr std::size_t kListed = 20;
  return std::vector<int>(ids.begin(),
                          ids.begin() + static_cast<std::ptrdiff_t>(std::min(kListed, ids.size())));
}

/// The mean, 0 without values.
class Mean {
 public:
  void add(double value) {
    sum_ += value;
    ++count_;
  }
  [[nodiscard]] double value() const {
    return count_ > 0 ? sum_ / static_cast<double>(count_) : 0.0;
  }

 private:
  double sum_ = 0.0;
  std::size_t count_ = 0;
};

Json scans_json(const RunRecord& record) {
  const RunRecord::Counts& counts = record.counts();
  return {{"total", counts.with_pose + counts.rejected},
          {"matched", counts.matched},
          {"lost", counts.lost},
          {"rejected", counts.rejected},
          {"searched", counts.searched},
          {"degenerate", counts.degenerate}};
}

Json times_json(const TimeChoice& times) {
  switch (times.source) {
    case TimeChoice::Source::kMeasured:
      return {{"source", "measurement"}, {"sorted_readings", times.late}};
    case TimeChoice::Source::kLogged:
      return {{"source", "logger"}, {"defects", times.defects}, {"sorted_readings", times.late}};
    case TimeChoice::Source::kOrder:
      break;
  }
  return {{"source", "order in the file"},
          {"defects", times.defects},
          {"scan_period_s", 1e-6 * times.period_us},
          {"scan_period_origin", times.period_origin}};
}

Json resumed_json(const ResumedMap& resumed) {
  return {{"damage", resumed.report},
          {"local_maps_lost", resumed.losses.local_maps},
          {"local_maps_shortened", resumed.losses.shortened},
          {"loop_closure_decisions_lost", resumed.losses.loop_closures},
          {"end_lost", resumed.losses.end}};
}

Json segments_json(const RunRecord& record) {
  Json list = Json::array();
  for (const auto& segment : record.segments().segments()) {
    list.push_back({{"from_s", seconds(segment.from_utime)},
                    {"to_s", seconds(segment.to_utime)},
                    {"length_m", segment.length_m},
                    {"scans", segment.scans},
                    {"intervals", segment.intervals},
                    {"kind", segment.lost ? "lost" : "degenerate"},
                    {"filled_by_sensor", segment.filled}});
  }
  return list;
}

/// Of the parts of the path that lie in stretches, which may overlap.
double length_m(std::vector<DoubtfulStretch> stretches) {
  std::ranges::sort(stretches, {}, &DoubtfulStretch::from_m);
  double length_m = 0.0;
  double end_m = 0.0;
  for (const DoubtfulStretch& stretch : stretches) {
    length_m += std::max(0.0, stretch.to_m - std::max(end_m, stretch.from_m));
    end_m = std::max(end_m, stretch.to_m);
  }
  return length_m;
}

Json stretches_json(const std::vector<DoubtfulStretch>& stretches) {
  Json list = Json::array();
  for (const DoubtfulStretch& stretch : stretches) {
    list.push_back({{"from_s", seconds(stretch.from_utime)},
                    {"to_s", seconds(stretch.to_utime)},
                    {"from_m", stretch.from_m},
                    {"to_m", stretch.to_m},
                    {"local_maps", listed(stretch.local_maps)},
                    {"local_map_count", stretch.local_maps.size()},
                    {"reasons", stretch.reasons},
                    {"motions", stretch.motions},
                    {"alternatives", stretch.alternatives}});
  }
  return list;
}

/// Size of the messages of a local map, all fragments [bytes].
double serialised_bytes(const LocalMap& map) {
  std::size_t bytes = 0;
  for (const LocalMapFragment& fragment : split(map)) bytes += encode(to_message(fragment)).size();
  return static_cast<double>(bytes);
}

/// Size of a local map with its scans, without the walls that mapping computes from them [bytes].
double unpacked_bytes(const LocalMap& map) {
  std::size_t bytes = sizeof(LocalMap) + map.scans.size() * sizeof(LocalScan);
  for (const LocalScan& scan : map.scans) bytes += scan.scan.ranges_m.size() * sizeof(float);
  return static_cast<double>(bytes);
}

Json bytes_json(const EarlierMap& earlier, const RunRecord& record) {
  Mean serialised;
  Mean unpacked;
  for (const LocalMapStore* maps : {&earlier.maps, &record.local_maps()}) {
    for (std::size_t i = 0; i < maps->size(); ++i) {
      const LocalMap map = maps->load(i);
      serialised.add(serialised_bytes(map));
      unpacked.add(unpacked_bytes(map));
    }
  }
  return {{"serialised", std::round(serialised.value())},
          {"resident", std::round(unpacked.value())}};
}

/// The number of pairs of local maps that contradict each other, and these local maps.
Json contradictions_json(const std::vector<MapContradiction>& contradictions) {
  std::set<int> local_maps;
  for (const MapContradiction& pair : contradictions) {
    local_maps.insert({pair.older_map, pair.newer_map});
  }
  return {{"pairs", contradictions.size()},
          {"local_maps", listed({local_maps.begin(), local_maps.end()})},
          {"local_map_count", local_maps.size()}};
}

Json map_json(const EarlierMap& earlier, const RunRecord& record, const FullMap& map) {
  const LoopClosureCounts loop_closures = count_loop_closures(map);
  return {{"sessions", map.paths.size()},
          {"local_maps", map.local_maps.size()},
          {"loop_closures",
           {{"proposed", loop_closures.proposed},
            {"accepted", loop_closures.accepted},
            {"revised", loop_closures.revised},
            {"to_earlier_sessions", count_cross_session_loop_closures(map)}}},
          {"contradictions", contradictions_json(record.contradictions())},
          {"objective", objective(pose_graph_of(map.graph))},
          {"bytes_per_local_map", bytes_json(earlier, record)}};
}

}  // namespace

RunCost process_cost() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  RunCost cost;
  cost.cpu_s = cpu_seconds(usage.ru_utime) + cpu_seconds(usage.ru_stime);
  cost.peak_memory_mb = static_cast<double>(usage.ru_maxrss) / 1024.0;
  return cost;
}

LoopClosureCounts count_loop_closures(const FullMap& map) {
  LoopClosureCounts counts;
  for (const Association* association : map.associations) {
    ++(association->action == Association::Action::kRevised ? counts.revised : counts.proposed);
  }
  counts.accepted = static_cast<std::size_t>(std::count_if(
      map.graph.constraints.begin(), map.graph.constraints.end(),
      [](const auto& constraint) { return constraint.kind == MapConstraint::Kind::kLoopClosure; }));
  return counts;
}

std::string summary_json(const RunRecord& record, const EarlierMap& earlier, const FullMap& map,
                         const std::vector<DoubtfulStretch>& stretches, const TimeChoice& times,
                         const ResumedMap& resumed, const RunCost& cost) {
  const Spool<TimedPose>& trajectory = record.odometry();
  const double duration_s =
      trajectory.empty() ? 0.0 : seconds(trajectory.back().utime - trajectory.front().utime);
  const Json json = {
      {"scans", scans_json(record)},
      {"times", times_json(times)},
      {"path_length_m", distance_travelled_m(trajectory, kTravelStepM)},
      {"duration_s", duration_s},
      {"wall_s", cost.wall_s},
      {"cpu_s", cost.cpu_s},
      {"real_time_factor", cost.wall_s > 0.0 ? duration_s / cost.wall_s : 0.0},
      {"ms_per_scan", {{"mean", cost.scans.mean_ms()}, {"p99", cost.scans.quantile_ms(0.99)}}},
      {"ms_per_local_map",
       {{"mean", cost.local_maps.mean_ms()}, {"max", cost.local_maps.max_ms()}}},
      {"peak_memory_mb", cost.peak_memory_mb},
      {"map", map_json(earlier, record, map)},
      {"doubtful_motions", record.doubts().size()},
      {"doubtful_length_m", length_m(stretches)},
      {"doubtful_stretches", stretches_json(stretches)},
      {"resumed_journal", resumed_json(resumed)},
      {"unobserved_segments_joined_m", record.segments().joined_m()},
      {"unobserved_segments", segments_json(record)}};
  return json.dump(2) + "\n";
}

}  // namespace adit
