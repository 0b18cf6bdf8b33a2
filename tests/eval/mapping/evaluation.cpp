// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/eval/mapping/evaluation.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "procs/mapping/map_journal.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/eval/tum.hpp"
#include "tools/map/map_run.hpp"

namespace adit {
namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Evaluation read_results(const std::filesystem::path& folder) {
  const auto summary = nlohmann::json::parse(test::contents(folder / "summary.json"));
  Evaluation result;
  result.trajectory = read_tum(folder / "trajectory.tum");
  result.odometry = read_tum(folder / "odometry.tum");
  result.map = read_map_journal(folder / "map.journal");
  result.scans = result.odometry.size();
  result.lost_scans = summary.at("scans").at("lost");
  result.searched = summary.at("scans").at("searched");
  result.degenerate = summary.at("scans").at("degenerate");
  for (const auto& segment : summary.at("unobserved_segments")) {
    if (segment.at("kind") != "degenerate") continue;
    ++result.degenerate_segments;
    result.degenerate_m += segment.at("length_m").get<double>();
  }
  result.scan_ms = summary.at("ms_per_scan").at("mean");
  result.scan_p99_ms = summary.at("ms_per_scan").at("p99");
  result.loop_closures = summary.at("map").at("loop_closures").at("accepted");
  result.revised_decisions = summary.at("map").at("loop_closures").at("revised");
  result.local_map_ms = summary.at("ms_per_local_map").at("mean");
  result.local_map_max_ms = summary.at("ms_per_local_map").at("max");
  result.local_map_kbytes =
      1e-3 * summary.at("map").at("bytes_per_local_map").at("serialised").get<double>();
  return result;
}

}  // namespace

Evaluation evaluate(const std::filesystem::path& log, bool use_odometry, int runs) {
  const test::ScratchFolder scratch;
  Evaluation result;
  std::vector<double> means_ms;
  std::vector<double> p99s_ms;
  std::vector<double> local_maps_ms;
  std::vector<double> local_maps_max_ms;
  for (int i = 0; i < runs; ++i) {
    run_map({log, scratch / "run", {}, use_odometry, {}, false}, [](const std::string&, double) {});
    const Evaluation run = read_results(scratch / "run");
    if (i == 0) result = run;
    if (run.trajectory != result.trajectory) {
      throw std::runtime_error(log.string() + ": two runs give different trajectories");
    }
    means_ms.push_back(run.scan_ms);
    p99s_ms.push_back(run.scan_p99_ms);
    local_maps_ms.push_back(run.local_map_ms);
    local_maps_max_ms.push_back(run.local_map_max_ms);
  }
  result.scan_ms = median(means_ms);
  result.scan_p99_ms = median(p99s_ms);
  result.local_map_ms = median(local_maps_ms);
  result.local_map_max_ms = median(local_maps_max_ms);
  return result;
}

}  // namespace adit
