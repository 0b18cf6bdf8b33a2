// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle/stance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>

#include <fmt/format.h>

#include "common/geometry/pose2.hpp"
#include "common/text/message_text.hpp"
#include "sim/vehicle/surroundings.hpp"

namespace adit {
namespace {

constexpr int kSide = 5;
constexpr int kRays = kSide * kSide;
constexpr int kMiddle = kSide / 2;
constexpr double kSpacing = 0.3;  // of the rays along the wheel, in wheel radii
constexpr float kDepthM = 10.0F;  // a deeper shaft has no ground
constexpr double kNone = -std::numeric_limits<double>::infinity();

/// Hits of the rays, row by row along the wheel; kNone marks rays without a hit.
struct Ground {
  std::array<double, kRays> height_m;
  std::array<double, kRays> grade;  ///< of the surface, along the heading of the wheel [m/m]
  std::array<std::uint32_t, kRays> triangle;
};

/// Indices from the middle of the wheel.
int along(int ray) { return ray / kSide - kMiddle; }
int across(int ray) { return ray % kSide - kMiddle; }

/// Rise of a surface along a direction of the plan [m/m].
double grade_along(const Eigen::Vector3f& normal, const Eigen::Vector2d& direction) {
  return -normal.head<2>().cast<double>().dot(direction) / static_cast<double>(normal.z());
}

Ground cast_down(const RayScene& scene, const std::array<Ray, kRays>& rays, double heading_rad) {
  const Eigen::Vector2d ahead(std::cos(heading_rad), std::sin(heading_rad));
  std::array<RayHit, kRays> hits;
  scene.cast(rays, kDepthM, hits, RayScene::Layer::kSolid);
  Ground ground{};
  for (std::size_t i = 0; i < kRays; ++i) {
    ground.height_m[i] = static_cast<double>(rays[i].origin.z()) - hits[i].distance_m;
    ground.grade[i] = grade_along(hits[i].normal, ahead);
    ground.triangle[i] = hits[i].triangle;
  }
  return ground;
}

bool has_ground_below_middle(const Ground& ground) {
  for (int i = 0; i < kRays; ++i) {
    if (along(i) == 0 && ground.height_m[i] != kNone) return true;
  }
  return false;
}

void rest_on(const Ground& ground, double radius_m, WheelGround& wheel) {
  for (int i = 0; i < kRays; ++i) {
    const double x = along(i) * kSpacing * radius_m;
    const double rim_m =
        radius_m - std::sqrt(radius_m * radius_m - x * x);  // above the lowest point of the wheel
    if (ground.height_m[i] - rim_m <= wheel.height_m) continue;
    wheel.height_m = ground.height_m[i] - rim_m;
    wheel.triangle = ground.triangle[i];
  }
}

/// The grade that all have in common; 0 if they rise and fall.
double common_grade(std::initializer_list<double> grades) {
  const auto [low, high] = std::minmax(grades);
  return std::clamp(0.0, low, high);
}

void find_step(const Ground& ground, double grade_ahead, double spacing_m, WheelGround& wheel) {
  for (int behind = 0; behind + 2 * kSide < kRays; ++behind) {
    const int ahead = behind + 2 * kSide;
    const double change = ground.height_m[ahead] - ground.height_m[behind];
    if (!std::isfinite(change)) continue;
    const double grade = common_grade({grade_ahead, ground.grade[behind], ground.grade[ahead]});
    const double rise = change - 2.0 * spacing_m * grade;
    if (std::abs(rise) <= wheel.step_m) continue;
    wheel.step_m = std::abs(rise);
    wheel.step_triangle = ground.triangle[rise > 0.0 ? ahead : behind];
  }
}

}  // namespace

WheelGroundProbe::WheelGroundProbe(const RayScene& scene, const Vehicle& vehicle)
    : scene_(scene),
      wheel_radius_m_(vehicle.wheel_radius_m),
      wheel_width_m_(vehicle.wheel_width_m) {}

std::optional<WheelGround> WheelGroundProbe::under(const WheelPlace& place) const {
  const Pose2 T_world_wheel{place.p_world.x(), place.p_world.y(), place.heading_rad};
  std::array<Ray, kRays> rays;
  for (int i = 0; i < kRays; ++i) {
    const double x = along(i) * kSpacing * wheel_radius_m_;
    const double y = across(i) * wheel_width_m_ / (kSide - 1);
    const Eigen::Vector2d p_world = T_world_wheel * Eigen::Vector2d(x, y);
    rays[i] = {Eigen::Vector3d(p_world.x(), p_world.y(), place.cast_from_m).cast<float>(),
               -Eigen::Vector3f::UnitZ()};
  }
  const Ground ground = cast_down(scene_, rays, place.heading_rad);
  if (!has_ground_below_middle(ground)) return std::nullopt;
  WheelGround wheel{kNone, 0, 0.0, 0};
  rest_on(ground, wheel_radius_m_, wheel);
  find_step(ground, place.grade_ahead, kSpacing * wheel_radius_m_, wheel);
  return wheel;
}

namespace {

constexpr std::array<const char*, 4> kWheelNames{"front left wheel", "front right wheel",
                                                 "rear left wheel", "rear right wheel"};
// The rays under a wheel are some centimetres apart; without a limit, its height would jump between
// them. A wheel climbs an edge at about this slope.
constexpr double kClimbSlope = 1.0;
// The wheels determine the tilt, and the tilt moves the wheels: iterations until both agree to 1
// µm.
constexpr int kPutRounds = 8;
constexpr double kAnyChange = std::numeric_limits<double>::infinity();

std::string at_step(std::size_t wheel, double step_m, const Part& part) {
  return fmt::format("{} at a step of {:.2f} m of {}", kWheelNames[wheel], step_m,
                     quote(part.name));
}

std::string tips_over(const char* tilt, double angle_rad) {
  return fmt::format("tips over at a {} of {:.0f} degrees", tilt, rad_to_deg(std::abs(angle_rad)));
}

}  // namespace

Stance::Stance(const Site& site, const Vehicle& vehicle)
    : site_(site), vehicle_(vehicle), probe_(site.scene(), vehicle) {}

Stance::Fault Stance::put(const Pose2& T_world_plan, double floor_m) {
  T_world_body_ = Eigen::AngleAxisd(T_world_plan.theta, Eigen::Vector3d::UnitZ());
  for (int round = 0; round < kPutRounds; ++round) {
    ground_m_.fill(floor_m);
    if (Fault fault = find_ground(T_world_plan, kAnyChange)) return fault;
    contact_m_ = ground_m_;
    if (Fault fault = sink(T_world_plan)) return fault;
    fit_plane(T_world_plan);
  }
  return check_tilt();
}

Stance::Fault Stance::move(const Pose2& T_world_plan) {
  std::array<double, 4> distance_m{};
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d before = (T_world_body_ * p_body_wheel(i)).head<2>();
    distance_m[i] = (p_world_wheel(i, T_world_plan) - before).norm();
  }
  if (Fault fault = find_ground(T_world_plan, vehicle_.step_max_m)) return fault;
  for (std::size_t i = 0; i < 4; ++i) {
    const double climb_max_m = kClimbSlope * distance_m[i];
    contact_m_[i] += std::clamp(ground_m_[i] - contact_m_[i], -climb_max_m, climb_max_m);
  }
  if (Fault fault = sink(T_world_plan)) return fault;
  fit_plane(T_world_plan);
  return check_tilt();
}

Eigen::Vector3d Stance::p_body_wheel(std::size_t wheel) const {
  return {(wheel < 2 ? 0.5 : -0.5) * vehicle_.wheelbase_m,
          (wheel % 2 == 0 ? 0.5 : -0.5) * vehicle_.track_m, 0.0};
}

/// Uses the previous tilt, which changes little in one move.
Eigen::Vector2d Stance::p_world_wheel(std::size_t wheel, const Pose2& T_world_plan) const {
  const Eigen::Vector2d ahead = T_world_body_.linear().col(0).head<2>();
  const double turn = T_world_plan.theta - std::atan2(ahead.y(), ahead.x());
  const Eigen::Vector2d level = (T_world_body_.linear() * p_body_wheel(wheel)).head<2>();
  return Pose2{T_world_plan.x, T_world_plan.y, turn} * level;
}

/// Of the previous pose, which differs little.
double Stance::grade_ahead() const {
  const Eigen::Vector3d ahead = T_world_body_.linear().col(0);
  return ahead.z() / ahead.head<2>().norm();
}

Stance::Fault Stance::find_ground(const Pose2& T_world_plan, double change_max_m) {
  const TriangleMesh& mesh = site_.scene().mesh();
  for (std::size_t i = 0; i < 4; ++i) {
    const auto ground = probe_.under({p_world_wheel(i, T_world_plan), T_world_plan.theta,
                                      ground_m_[i] + 2.0 * vehicle_.wheel_radius_m, grade_ahead()});
    if (!ground) return fmt::format("no ground under the {}", kWheelNames[i]);
    const double change_m = std::abs(ground->height_m - ground_m_[i]);
    if (ground->step_m > vehicle_.step_max_m) {
      return at_step(i, ground->step_m, mesh.part_of(ground->step_triangle));
    }
    if (change_m > change_max_m) {
      return at_step(i, change_m, mesh.part_of(ground->triangle));
    }
    ground_m_[i] = ground->height_m;
  }
  return std::nullopt;
}

Stance::Fault Stance::sink(const Pose2& T_world_plan) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Sinkage sinkage = sinkage_at(site_.world(), p_world_wheel(i, T_world_plan));
    sinkage_m_[i] = sinkage.depth_m;
    if (sinkage.depth_m > vehicle_.sinkage_max_m) {
      return fmt::format("{} stuck in {}, sinkage {:.2f} m", kWheelNames[i], quote(sinkage.name),
                         sinkage.depth_m);
    }
  }
  return std::nullopt;
}

/// The wheels form a rectangle, so that the slopes of the least-squares plane are differences of
/// means.
void Stance::fit_plane(const Pose2& T_world_plan) {
  std::array<double, 4> low{};
  for (std::size_t i = 0; i < 4; ++i) low[i] = contact_m_[i] - sinkage_m_[i];
  const double height = 0.25 * (low[0] + low[1] + low[2] + low[3]);
  const double rise_x = 0.5 * (low[0] + low[1] - low[2] - low[3]) / vehicle_.wheelbase_m;
  const double rise_y = 0.5 * (low[0] + low[2] - low[1] - low[3]) / vehicle_.track_m;
  const double pitch = -std::asin(std::clamp(rise_x, -1.0, 1.0));
  const double roll = std::asin(std::clamp(rise_y / std::cos(pitch), -1.0, 1.0));

  T_world_body_ = Eigen::Translation3d(T_world_plan.x, T_world_plan.y, height) *
                  Eigen::AngleAxisd(T_world_plan.theta, Eigen::Vector3d::UnitZ()) *
                  Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                  Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
}

Stance::Fault Stance::check_tilt() const {
  const Eigen::Matrix3d R = T_world_body_.linear();
  const double pitch = std::asin(std::clamp(R(2, 0), -1.0, 1.0));
  const double roll = std::atan2(R(2, 1), R(2, 2));
  if (std::abs(pitch) > vehicle_.tilt_max_rad) return tips_over("pitch", pitch);
  if (std::abs(roll) > vehicle_.tilt_max_rad) return tips_over("roll", roll);
  return std::nullopt;
}

}  // namespace adit
