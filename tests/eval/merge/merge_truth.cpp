// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/eval/merge/merge_truth.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <stdexcept>
#include <utility>

#include "common/geometry/symmetric_eigen.hpp"
#include "tools/eval/trajectory_score.hpp"
#include "tools/merge/merge_input.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStandsUs = 100'000;
constexpr double kFixedSdM = 0.1;

}  // namespace

TrueRun open_true_run(const std::filesystem::path& folder, std::int64_t ahead_us) {
  MergeInput input = open_run(folder, {}, {}, [](const std::string&, double) {});
  MappingParams params;
  params.lasers = input.lasers;
  TrueRun run{folder.filename().string(), std::make_unique<Mapping>(params),
              read_ground_truth(folder / "run.lcmlog")};
  for (TimedPose& pose : run.truth) pose.utime -= ahead_us;
  if (!run.truth.empty()) {  // the first scan comes before the first TRUTH, and the robot stands
    TimedPose start = run.truth.front();
    start.utime -= kStandsUs;
    run.truth.insert(run.truth.begin(), start);
  }
  run.map->restore(std::move(input.map));
  return run;
}

MergedRuns::MergedRuns(std::vector<TrueRun> runs)
    : groups_(std::make_unique<RunGroups>(RunJoinParams{})) {
  const std::clock_t start = std::clock();
  for (TrueRun& run : runs) {
    groups_->add(std::move(run.map));
    names_.push_back(std::move(run.name));
    truths_.push_back(std::move(run.truth));
  }
  groups_->finish();
  cpu_s_ = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

std::vector<PosePair> MergedRuns::places(const RunGroup& group, const PlacedRun& run) const {
  std::vector<PosePair> pairs;
  const std::vector<Pose2> poses = group.map->graph().poses;
  for (int i = run.first_map; i < run.first_map + run.maps; ++i)
    pairs.push_back({poses[static_cast<std::size_t>(i)], true_pose(group, i)});
  return pairs;
}

std::vector<PosePair> MergedRuns::places(const RunGroup& group) const {
  std::vector<PosePair> pairs;
  for (const PlacedRun& run : group.runs) {
    const std::vector<PosePair> own = places(group, run);
    pairs.insert(pairs.end(), own.begin(), own.end());
  }
  return pairs;
}

std::vector<double> MergedRuns::link_errors_m(const RunGroup& group, const RunJoin& join) const {
  std::vector<double> errors;
  for (const JoinLink& link : join.links) {
    const Pose2 truth = between(true_pose(group, link.older), true_pose(group, link.newer));
    const Eigen::Vector2d error = between(truth, link.T_older_newer).translation();
    const SymmetricEigen<2> axes =
        symmetric_eigen(Eigen::Matrix2d(link.information.topLeftCorner<2, 2>()));
    double squared = 0.0;
    for (int i = 0; i < 2; ++i) {
      if (axes.values[i] > 1.0 / (kFixedSdM * kFixedSdM))
        squared += std::pow(axes.vectors.col(i).dot(error), 2);
    }
    errors.push_back(std::sqrt(squared));
  }
  return errors;
}

/// Where the robot of its run was when the local map began.
Pose2 MergedRuns::true_pose(const RunGroup& group, int map) const {
  const auto run = std::ranges::find_if(group.runs, [&](const PlacedRun& placed) {
    return map >= placed.first_map && map < placed.first_map + placed.maps;
  });
  const std::int64_t utime = group.map->local_maps()[static_cast<std::size_t>(map)].utime;
  const auto pose = interpolate(truths_.at(run->run), utime);
  if (!pose) throw std::runtime_error(name(run->run) + ": no TRUTH at the time of a local map");
  return *pose;
}

}  // namespace adit
