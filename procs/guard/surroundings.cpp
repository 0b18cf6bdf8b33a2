// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/surroundings.hpp"

#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "procs/guard/obstacle_check.hpp"

namespace adit {
namespace {

std::string obstacle_text(const char* name, double distance_m, double within_m,
                          const ArcMotion& motion, const char* arc, bool for_release) {
  return fmt::format("{} {:.2f} m {} on {}, {} distance {:.2f} m", name, distance_m,
                     direction_of(motion) > 0 ? "ahead" : "behind", arc,
                     for_release ? "release" : "stopping", within_m);
}

}  // namespace

Surroundings::Surroundings(const GuardParams& params)
    : vehicle_(params.vehicle),
      obstacle_(params.obstacle),
      timeout_s_(params.timeout_s),
      front_("laser front", params.lasers.front),
      rear_("laser rear", params.lasers.rear),
      has_rear_(params.lasers.has_rear()),
      flank_memory_(params.vehicle, params.lasers) {
  if (!params.lasers.sees_behind()) blind_side_memory_.emplace(params.vehicle, params.lasers.front);
}

void Surroundings::move_to(const Pose2& T_odom_body) {
  flank_memory_.move_to(T_odom_body);
  if (blind_side_memory_) blind_side_memory_->move_to(T_odom_body);
}

void Surroundings::receive(const MapCorrection& correction) {
  if (blind_side_memory_) blind_side_memory_->correct(correction);
}

void Surroundings::receive(LaserId laser, const TiltReading& reading, std::int64_t at_us) {
  monitor_of(laser).receive(reading, at_us);
}

void Surroundings::receive(LaserId laser, const LaserScan& scan, std::int64_t at_us,
                           const Eigen::Vector3d& up_body) {
  if (laser == LaserId::kRear && !has_rear_) return;
  if (!monitor_of(laser).receive(scan, at_us, up_body, vehicle_)) return;
  flank_memory_.observe(laser, monitor_of(laser).points());
  if (blind_side_memory_) blind_side_memory_->observe(monitor_of(laser).points());
}

std::optional<std::string> Surroundings::obstacle_on(const ArcMotion& motion, const char* arc,
                                                     bool for_release, std::int64_t now_us) const {
  if (direction_of(motion) == 0) return std::nullopt;
  const auto within_m = [&](double age_s, double margin_m) {
    return stopping_distance_m(obstacle_, motion.speed_m_s, age_s) + margin_m +
           (for_release ? obstacle_.release_margin_m : 0.0);
  };
  const ArcSweep footprint(vehicle_, motion, 0.0);
  const ArcSweep widened(vehicle_, motion, side_margin_m(obstacle_, motion.speed_m_s));
  const std::array sweeps{std::pair(&footprint, obstacle_.margin_m),
                          std::pair(&widened, obstacle_.flank_margin_m)};
  for (const auto& [sweep, margin_m] : sweeps) {
    for (const LaserMonitor* laser : {&front_, &rear_}) {
      const auto age_s = laser->age_s(now_us);
      if (!age_s || *age_s > timeout_s_) continue;  // the vehicle has moved since
      const double limit_m = within_m(*age_s, margin_m);
      const double distance_m = distance_to_obstacle_m(laser->points(), *sweep, limit_m);
      if (!std::isinf(distance_m))
        return obstacle_text("obstacle", distance_m, limit_m, motion, arc, for_release);
    }
    const double limit_m = within_m(0.0, margin_m);
    const double distance_m = distance_to_nearest_m(flank_memory_.p_body(), *sweep, limit_m);
    if (!std::isinf(distance_m))
      return obstacle_text("remembered obstacle", distance_m, limit_m, motion, arc, for_release);
  }
  return std::nullopt;
}

std::optional<std::string> Surroundings::laser_fault_on(const ArcMotion& motion,
                                                        std::int64_t now_us) const {
  const int direction = direction_of(motion);
  if (direction == 0) return std::nullopt;
  if (direction > 0 || !has_rear_) {
    auto fault = front_.fault(now_us, timeout_s_);
    if (fault || direction > 0 || !blind_side_memory_) return fault;
    const double within_m = stopping_distance_m(obstacle_, motion.speed_m_s, 0.0);
    const double known_m = blind_side_memory_->known_m(motion, within_m);
    if (known_m >= within_m) return std::nullopt;
    return fmt::format("blind behind: ground known for {:.2f} m, stopping distance {:.2f} m",
                       known_m, within_m);
  }
  return rear_.fault(now_us, timeout_s_);
}

}  // namespace adit
