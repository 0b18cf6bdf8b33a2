// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/laser_on_body.hpp"

#include "common/sensing/seconds.hpp"

namespace adit {

LaserOnBody::LaserOnBody(const RayScene& scene, const Setup& setup, std::int64_t utime,
                         const Eigen::Isometry3d& T_world_body)
    : mount_(setup.mount),
      laser_(scene, setup.laser, setup.noise_seed),
      tilt_(setup.tilt),
      schedule_(setup.laser, utime, setup.phase),
      history_({utime, T_world_body, tilt_.angle_rad()}),
      scan_loss_(setup.laser.scan_loss),
      loss_random_(setup.loss_seed),
      utime_(utime) {}

void LaserOnBody::advance(std::int64_t utime, const Eigen::Isometry3d& T_world_body) {
  tilt_.advance(seconds(utime - utime_));
  utime_ = utime;
  history_.add({utime, T_world_body, tilt_.angle_rad()});
}

std::vector<LaserOnBody::FinishedScan> LaserOnBody::finished_scans(const AliveAt& alive) {
  std::vector<FinishedScan> scans;
  for (; schedule_.end_utime() <= utime_; schedule_.go_on()) {
    if (schedule_.is_kept() && !is_lost(alive)) scans.push_back({schedule_.end_utime(), measure()});
  }
  history_.forget_before(schedule_.begin_utime());
  return scans;
}

bool LaserOnBody::is_lost(const AliveAt& alive) {
  const bool lost = std::uniform_real_distribution<double>()(loss_random_) < scan_loss_;
  return lost || !alive(schedule_.begin_utime()) || !alive(schedule_.end_utime());
}

LaserScan LaserOnBody::measure() {
  const std::int64_t begin = schedule_.begin_utime();
  const auto T_world_laser = [&](double seconds) {
    const MotionHistory::Moment moment = history_.at(begin, seconds);
    return moment.T_world_body * tilted_laser(mount_, moment.tilt_rad);
  };
  return laser_.measure(T_world_laser, begin);
}

}  // namespace adit
