// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle/vehicle_model.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "common/text/message_text.hpp"
#include "sim/vehicle/surroundings.hpp"

namespace adit {
namespace {

// Thinner objects are detected, too: they penetrate the body, which is far longer.
constexpr double kCollisionEveryM = 0.04;

/// An imported mesh may have no floor function.
std::optional<double> floor_at_start(const Site& site, const Vehicle& vehicle) {
  const Eigen::Vector2d p_world = site.world().T_world_start.translation();
  const auto& floor_height = site.world().truth.floor_height;
  return floor_height ? floor_height(p_world) : floor_with_headroom(site.scene(), vehicle, p_world);
}

}  // namespace

VehicleModel::VehicleModel(const Site& site, const Vehicle& vehicle,
                           const VehicleModelParams& params, std::uint64_t seed, std::int64_t utime)
    : site_(site),
      vehicle_(vehicle),
      steering_(vehicle),
      drivetrain_(vehicle, params, utime),
      slip_(params, seed),
      stance_(site, vehicle),
      battery_(vehicle, params),
      T_world_plan_(site.world().T_world_start) {
  const auto floor_m = floor_at_start(site, vehicle);
  std::optional<std::string> fault = "no floor";
  if (floor_m) fault = stance_.put(T_world_plan_, *floor_m);
  motion_ = {utime, stance_.T_world_body(), {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  if (!fault) fault = check_surroundings();
  if (fault) {
    throw std::invalid_argument(fmt::format("the vehicle cannot stand at the start: {}", *fault));
  }
}

void VehicleModel::advance(double seconds) {
  drivetrain_.advance(seconds);
  motion_.utime = drivetrain_.utime();
  if (failure_) return stand();
  battery_.draw(drivetrain_.speed_m_s(), rise_ahead(), seconds);
  if (battery_.empty()) return fail("battery empty");
  if (drivetrain_.wheel_distance_m() == 0.0) return stand();
  move(seconds);
}

void VehicleModel::move(double seconds) {
  slip_.advance(drivetrain_.wheel_distance_m());
  const Eigen::Isometry3d T_world_before = motion_.T_world_body;
  T_world_plan_ = next_place();
  auto fault = stance_.move(T_world_plan_);
  motion_.T_world_body = stance_.T_world_body();

  const Eigen::Isometry3d T_before_now = T_world_before.inverse() * motion_.T_world_body;
  const Eigen::AngleAxisd turn(T_before_now.linear());
  motion_.omega_body = turn.axis() * turn.angle() / seconds;
  motion_.v_body = T_before_now.linear().transpose() * T_before_now.translation() / seconds;
  distance_travelled_m_ += T_before_now.translation().norm();

  const double reach_m = 0.5 * std::hypot(vehicle_.length_m, vehicle_.width_m);
  unchecked_m_ += T_before_now.translation().norm() + turn.angle() * reach_m;
  if (!fault && unchecked_m_ >= kCollisionEveryM) fault = check_surroundings();
  if (fault) fail(*fault);
}

/// Sine of the angle at which the ground under the body rises along x.
double VehicleModel::rise_ahead() const {
  return std::clamp(motion_.T_world_body.linear()(2, 0), -1.0, 1.0);
}

/// Pose in the plan after the distance that the wheels rolled along the slope, reduced by the slip.
Pose2 VehicleModel::next_place() const {
  const double softness =
      *std::max_element(sinkage_m().begin(), sinkage_m().end()) / vehicle_.sinkage_max_m;
  const double distance_m = drivetrain_.wheel_distance_m() * (1.0 - slip_.slip_ratio(softness));
  const double level_share = motion_.T_world_body.linear().col(0).head<2>().norm();
  const double turn_rad = distance_m * steering_.turn_rad_per_m(drivetrain_.curvature_1_m());
  return T_world_plan_ *
         steering_.motion(distance_m * level_share, turn_rad, slip_.side_slip_rad(softness));
}

std::optional<std::string> VehicleModel::check_surroundings() {
  unchecked_m_ = 0.0;
  if (const auto part = colliding_part(site_.scene(), vehicle_, motion_.T_world_body)) {
    return fmt::format("collision with {}", quote(*part));
  }
  const auto water = water_above(site_.world(), motion_.T_world_body.translation());
  if (water && water->depth_m > vehicle_.wading_depth_max_m) {
    return fmt::format("in water {} of {:.2f} m", quote(water->name), water->depth_m);
  }
  return std::nullopt;
}

void VehicleModel::fail(const std::string& reason) {
  failure_ = fmt::format("{} after {:.2f} m", reason, distance_travelled_m_);
  stand();
}

void VehicleModel::stand() {
  if (failure_) drivetrain_.halt();
  motion_.v_body.setZero();
  motion_.omega_body.setZero();
}

VehicleState VehicleModel::state() const {
  return {motion_.utime,    drivetrain_.speed_m_s(), drivetrain_.curvature_1_m(),
          battery_.share(), drivetrain_.stopped(),   drivetrain_.expired()};
}

}  // namespace adit
