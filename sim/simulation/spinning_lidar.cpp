// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/spinning_lidar.hpp"

#include <cmath>
#include <random>
#include <utility>

namespace adit {

SpinningLidar::SpinningLidar(const RayScene& scene, const Setup& setup, std::int64_t utime,
                             const Eigen::Isometry3d& T_world_body)
    : T_body_lidar_(T_body_lidar(setup.lasers)),
      period_s_(1.0 / setup.lasers.front.timing.mirror_hz),
      decimation_(setup.lidar.decimation),
      model_(scene, setup.lidar, setup.laser, period_s_, setup.noise_seed),
      level_view_(setup.lasers),
      level_readings_(level_view_.readings_used(model_.blank())),
      history_({utime, T_world_body, 0.0}),
      scan_loss_(setup.laser.scan_loss),
      loss_random_(setup.loss_seed),
      start_utime_(utime),
      utime_(utime) {}

void SpinningLidar::advance(std::int64_t utime, const Eigen::Isometry3d& T_world_body) {
  utime_ = utime;
  history_.add({utime, T_world_body, 0.0});
}

std::vector<SpinningLidar::Finished> SpinningLidar::finished(const AliveAt& alive) {
  std::vector<Finished> finished;
  for (; end_utime() <= utime_; ++revolution_) {
    if (!is_lost(alive)) finished.push_back(measure());
  }
  history_.discard_before(begin_utime());
  return finished;
}

std::int64_t SpinningLidar::begin_utime() const {
  return start_utime_ + std::llround(1e6 * period_s_ * static_cast<double>(revolution_));
}

std::int64_t SpinningLidar::end_utime() const {
  return begin_utime() + model_.blank().columns.back().time_us;
}

bool SpinningLidar::is_lost(const AliveAt& alive) {
  const bool lost = std::uniform_real_distribution<double>()(loss_random_) < scan_loss_;
  return lost || !alive(begin_utime()) || !alive(end_utime());
}

SpinningLidar::Finished SpinningLidar::measure() {
  const std::int64_t begin = begin_utime();
  const auto T_world_lidar = [&](double seconds) {
    return history_.at(begin, seconds).T_world_body * T_body_lidar_;
  };
  const bool is_full = revolution_ % decimation_ == 0;
  LidarRevolution revolution =
      model_.measure(T_world_lidar, begin, is_full ? std::vector<bool>{} : level_readings_);
  Finished finished{end_utime(), level_view_.scan(revolution), std::nullopt};
  if (is_full) finished.revolution = std::move(revolution);
  return finished;
}

}  // namespace adit
