// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/eval/mapping/reported_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include <nlohmann/json.hpp>

#include "common/geometry/pose2.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/map/map_run.hpp"

namespace adit {
namespace {

constexpr double kReportedM = 5.0;   // a local map
constexpr double kRelationM = 10.0;  // path length between the poses of a relation

}  // namespace

ReportedMap map_log(const std::filesystem::path& log, bool use_odometry) {
  const test::ScratchFolder scratch;
  run_map({log, scratch / "run", {}, use_odometry, {}, false}, [](const std::string&, double) {});
  ReportedMap map{read_tum(scratch / "run/trajectory.tum"), {}};
  const auto summary = nlohmann::json::parse(test::contents(scratch / "run/summary.json"));
  for (const auto& stretch : summary.at("doubtful_stretches")) {
    const auto utime = [&](const char* key) {
      return std::llround(1e6 * stretch.at(key).get<double>());
    };
    map.stretches.push_back({utime("from_s"), utime("to_s")});
  }
  return map;
}

Trajectory sampled(const Trajectory& trajectory, const Trajectory& times) {
  Trajectory at;
  for (const TimedPose& pose : times) {
    if (const auto T = interpolate(trajectory, pose.utime)) at.push_back({pose.utime, *T});
  }
  return at;
}

std::vector<double> distances(const Trajectory& path) {
  std::vector<double> along(path.size(), 0.0);
  for (std::size_t i = 1; i < path.size(); ++i) {
    along[i] = along[i - 1] + between(path[i - 1].pose, path[i].pose).translation().norm();
  }
  return along;
}

std::vector<Relation> relations_of(const Trajectory& truth) {
  const std::vector<double> along = distances(truth);
  std::vector<Relation> relations;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    for (const double on_m : {kRelationM, 0.5 * along.back()}) {
      const auto j = static_cast<std::size_t>(std::ranges::lower_bound(along, along[i] + on_m) -
                                              along.begin());
      if (j >= truth.size()) continue;
      relations.push_back({truth[i].utime, truth[j].utime, between(truth[i].pose, truth[j].pose)});
    }
  }
  return relations;
}

double error_m(const std::vector<Relation>& relations, const Trajectory& trajectory) {
  return score_relations(relations, trajectory).translation_m.mean;
}

bool reports(const ReportedMap& map, const Trajectory& truth, const std::vector<double>& along,
             double from_m, double to_m) {
  const auto distance_at = [&](std::int64_t utime) {
    const auto pose = std::ranges::lower_bound(truth, utime, {}, &TimedPose::utime);
    return along[static_cast<std::size_t>(std::min(pose, truth.end() - 1) - truth.begin())];
  };
  return std::ranges::any_of(map.stretches, [&](const ReportedMap::Stretch& stretch) {
    return distance_at(stretch.from_utime) <= to_m + kReportedM &&
           distance_at(stretch.to_utime) >= from_m - kReportedM;
  });
}

}  // namespace adit
