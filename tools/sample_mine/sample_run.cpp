// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/sample_run.hpp"

#include "tools/sample_mine/mine_worlds.hpp"
#include "tools/sample_mine/route_driver.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStartUtime = 1'700'000'000'000'000;

// Streams of noise that do not repeat each other.
constexpr std::uint64_t kLaserStream = 0x1a5e;
constexpr std::uint64_t kOdometryStream = 0x0d03;

}  // namespace

SampleRun::SampleRun(std::uint64_t seed, const LaserModel& laser)
    : mine_(sample_mine(seed)),
      truth_(drive_route(sample_mine_route(), {}, kStartUtime)),
      laser_(laser, seed ^ kLaserStream),
      odometry_({}, seed ^ kOdometryStream) {}

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
