// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/sample_run.hpp"

#include <utility>

namespace adit {
namespace {

constexpr std::int64_t kStartUtime = 1'700'000'000'000'000;

// Streams of noise that do not repeat each other.
constexpr std::uint64_t kLaserStream = 0x1a5e;
constexpr std::uint64_t kOdometryStream = 0x0d03;

/// The beginning of the trajectory, up to this length of path.
Trajectory shortened(Trajectory trajectory, double length_max_m) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    length_m += (trajectory[i].pose.translation() - trajectory[i - 1].pose.translation()).norm();
    if (length_m > length_max_m) trajectory.resize(i);
  }
  return trajectory;
}

}  // namespace

SampleRun::SampleRun(std::uint64_t seed, const SyntheticLaserModel& laser, double length_max_m)
    : SampleRun(sample_site(SampleWorld::kRing, seed), seed, laser, length_max_m) {}

SampleRun::SampleRun(SampleSite site, std::uint64_t seed, const SyntheticLaserModel& laser,
                     double length_max_m)
    : mine_(std::move(site.mine)),
      truth_(shortened(drive_route(site.route, site.drive, kStartUtime), length_max_m)),
      laser_(laser, seed ^ kLaserStream),
      odometry_(site.odometry, seed ^ kOdometryStream) {}

std::optional<SampleReading> SampleRun::next() {
  if (next_ == truth_.size()) return std::nullopt;
  const auto& [utime, T_world_body] = truth_[next_];
  const Pose2& T_world_previous = truth_[next_ > 0 ? next_ - 1 : 0].pose;
  ++next_;
  return SampleReading{odometry_.advance(between(T_world_previous, T_world_body), utime),
                       laser_.measure(mine_, T_world_body, utime)};
}

double SampleRun::fraction_done() const {
  return static_cast<double>(next_) / static_cast<double>(truth_.size());
}

}  // namespace adit
