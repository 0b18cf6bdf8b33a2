// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/motion_history.hpp"

#include <algorithm>

namespace adit {
namespace {

MotionHistory::Moment between(const MotionHistory::Moment& a, const MotionHistory::Moment& b,
                              double share) {
  MotionHistory::Moment moment;
  moment.utime =
      a.utime + static_cast<std::int64_t>(share * static_cast<double>(b.utime - a.utime));
  const Eigen::Quaterniond from(a.T_world_body.linear());
  const Eigen::Quaterniond to(b.T_world_body.linear());
  moment.T_world_body.linear() = from.slerp(share, to).toRotationMatrix();
  moment.T_world_body.translation() =
      a.T_world_body.translation() +
      share * (b.T_world_body.translation() - a.T_world_body.translation());
  moment.tilt_rad = a.tilt_rad + share * (b.tilt_rad - a.tilt_rad);
  return moment;
}

}  // namespace

void MotionHistory::forget_before(std::int64_t utime) {
  while (moments_.size() > 1 && moments_[1].utime <= utime) moments_.pop_front();
}

MotionHistory::Moment MotionHistory::at(std::int64_t utime, double seconds) const {
  // Times are differences of whole numbers first, which keeps their fractions exact.
  const auto seconds_since = [&](const Moment& moment) {
    return static_cast<double>(utime - moment.utime) * 1e-6 + seconds;
  };
  const auto after = std::find_if(moments_.begin(), moments_.end(), [&](const Moment& moment) {
    return seconds_since(moment) < 0.0;
  });
  if (after == moments_.begin()) return moments_.front();
  const Moment& before = *std::prev(after);
  if (after == moments_.end()) return before;
  const double whole = static_cast<double>(after->utime - before.utime) * 1e-6;
  return between(before, *after, seconds_since(before) / whole);
}

}  // namespace adit
