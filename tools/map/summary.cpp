// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/summary.hpp"

#include <algorithm>
#include <numeric>

#include <nlohmann/json.hpp>
#include <sys/resource.h>

namespace adit {
namespace {

using Json = nlohmann::ordered_json;

double seconds(const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * t.tv_usec; }

double mean(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto last = static_cast<double>(values.size() - 1);
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(share * last);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

std::size_t count(const RunRecord& record, ScanMatch::Status status) {
  return std::count_if(record.entries().begin(), record.entries().end(),
                       [&](const auto& entry) { return entry.match.status == status; });
}

Json scans_json(const RunRecord& record) {
  const auto& entries = record.entries();
  const auto degenerate = std::count_if(entries.begin(), entries.end(), [](const auto& entry) {
    return !entry.match.degenerate.empty();
  });
  const auto searched = std::count_if(entries.begin(), entries.end(),
                                      [](const auto& entry) { return entry.match.searched; });
  return {{"total", entries.size() + record.refused_scans()},
          {"matched", count(record, ScanMatch::Status::kMatched)},
          {"lost", count(record, ScanMatch::Status::kLost)},
          {"refused", record.refused_scans()},
          {"searched", searched},
          {"degenerate", degenerate}};
}

Json stretches_json(const RunRecord& record) {
  Json list = Json::array();
  for (const auto& stretch : record.stretches()) {
    list.push_back({{"from_s", 1e-6 * static_cast<double>(stretch.from_utime)},
                    {"to_s", 1e-6 * static_cast<double>(stretch.to_utime)},
                    {"length_m", stretch.length_m},
                    {"scans", stretch.scans},
                    {"what", stretch.lost ? "lost" : "degenerate"},
                    {"filled_by_sensor", stretch.filled}});
  }
  return list;
}

}  // namespace

RunCost cost_so_far() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  RunCost cost;
  cost.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  cost.peak_memory_mb = static_cast<double>(usage.ru_maxrss) / 1024.0;
  return cost;
}

std::string summary_json(const RunRecord& record, const RunCost& cost) {
  const Trajectory trajectory = record.trajectory();
  const double duration_s =
      trajectory.empty()
          ? 0.0
          : 1e-6 * static_cast<double>(trajectory.back().utime - trajectory.front().utime);
  const Json json = {
      {"scans", scans_json(record)},
      {"path_length_m", path_length_m(trajectory)},
      {"duration_s", duration_s},
      {"wall_s", cost.wall_s},
      {"cpu_s", cost.cpu_s},
      {"real_time_factor", cost.wall_s > 0.0 ? duration_s / cost.wall_s : 0.0},
      {"ms_per_scan", {{"mean", mean(cost.scan_ms)}, {"p99", quantile(cost.scan_ms, 0.99)}}},
      {"peak_memory_mb", cost.peak_memory_mb},
      {"unobserved_stretches", stretches_json(record)}};
  return json.dump(2) + "\n";
}

}  // namespace adit
