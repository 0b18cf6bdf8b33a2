// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "common/geometry/pose2.hpp"
#include "common/types/body_outline.hpp"
#include "tools/check_robot/robot_check.hpp"

namespace adit {
namespace {

constexpr double kSteeringAngleMaxRad = 1.0;  // of a wheel; more than any steering linkage reaches
constexpr double kDensityMin = 30.0;          // [kg/m³] of the box around a robot
constexpr double kDensityMax = 3000.0;
constexpr double kToleranceM = 0.001;
constexpr double kCentreOfMassShare = 0.5;  // of the height, the highest that is usual

std::string compare(bool holds, const char* relation, const char* otherwise) {
  return holds ? relation : otherwise;
}

/// Checks `sum <= limit`.
void check_at_most(CheckResults& results, const std::string& sum_text, double sum,
                   const std::string& limit_text, double limit, const char* remedy) {
  const bool holds = sum <= limit + kRoundingM;
  add_relation(results, holds, "vehicle",
               fmt::format("{} = {:.3g} {} {} = {:.3g}", sum_text, sum, compare(holds, "<=", ">"),
                           limit_text, limit),
               remedy);
}

double steering_angle_rad(const Vehicle& vehicle) {
  const double radius = vehicle.turning_radius_m;
  const double half = 0.5 * vehicle.wheelbase_m;
  if (vehicle.steering == "four_wheel") return std::atan(half / radius);
  const double axle = std::sqrt(std::max(0.0, radius * radius - half * half));
  return std::atan2(vehicle.wheelbase_m, axle);
}

void check_wheels(const Vehicle& vehicle, CheckResults& results) {
  check_at_most(
      results,
      fmt::format("track_m + wheel_width_m = {} + {}", vehicle.track_m, vehicle.wheel_width_m),
      vehicle.track_m + vehicle.wheel_width_m, "width_m", vehicle.width_m,
      "the wheels stand out of the body. track_m is from the middle of the left wheel to the "
      "middle of the right one; width_m includes all that protrudes");
  check_at_most(
      results,
      fmt::format("wheelbase_m + 2 wheel_radius_m = {} + {}", vehicle.wheelbase_m,
                  2.0 * vehicle.wheel_radius_m),
      vehicle.wheelbase_m + 2.0 * vehicle.wheel_radius_m, "length_m", vehicle.length_m,
      "the wheels stand out of the body. wheelbase_m is from axle to axle, wheel_radius_m "
      "half a diameter; length_m includes bumpers and lasers");
  check_at_most(results, "step_max_m", vehicle.step_max_m, "wheel_radius_m", vehicle.wheel_radius_m,
                "a wheel does not climb a step higher than its axle");
  check_at_most(results, "step_max_m", vehicle.step_max_m, "belly_clearance_m",
                vehicle.belly_clearance_m,
                "the belly would rest on a step that the wheels climb; state the step that the "
                "whole vehicle passes");
  check_at_most(results, "sinkage_max_m", vehicle.sinkage_max_m, "belly_clearance_m",
                vehicle.belly_clearance_m,
                "the belly would rest on the ground, and the wheels turn freely");
  check_at_most(results, "belly_clearance_m", vehicle.belly_clearance_m, "height_m",
                vehicle.height_m, "the lowest point is above the highest one");
  check_at_most(results, "2 wheel_radius_m", 2.0 * vehicle.wheel_radius_m, "height_m",
                vehicle.height_m,
                "the wheels are higher than height_m, the highest point of the vehicle above the "
                "ground; is wheel_radius_m the diameter?");
}

/// A footprint that is no rectangle: whether the stages can use it, and the wheels stand on it.
void check_footprint(const Vehicle& vehicle, CheckResults& results) {
  if (vehicle.footprint.empty()) return;
  const ConvexPolygon outline = body_outline(vehicle);
  const Eigen::Vector2d wheel(vehicle.wheelbase_m / 2.0 + vehicle.wheel_radius_m,
                              (vehicle.track_m + vehicle.wheel_width_m) / 2.0);
  add_relation(
      results, outline.grown(kToleranceM).contains(wheel), "vehicle",
      fmt::format("footprint with {} corners; the outer corner of a wheel at ({:.3g}, {:.3g}) m",
                  outline.corners().size(), wheel.x(), wheel.y()),
      "the wheel stands out of the footprint, which includes all that protrudes");
}

void check_steering(const Vehicle& vehicle, CheckResults& results) {
  if (vehicle.steering == "skid") {
    check_at_most(results, "track_m / 2", 0.5 * vehicle.track_m, "turning_radius_m",
                  vehicle.turning_radius_m,
                  "the wheels of the inner side would turn backwards; Adit does not plan turns on "
                  "the spot");
    return;
  }
  const double angle = steering_angle_rad(vehicle);
  add_relation(results, angle <= kSteeringAngleMaxRad, "vehicle",
               fmt::format("turning_radius_m = {} and wheelbase_m = {} turn a {} wheel by {:.0f}°",
                           vehicle.turning_radius_m, vehicle.wheelbase_m, vehicle.steering,
                           rad_to_deg(angle)),
               "no linkage turns a wheel by more than 57°. turning_radius_m is the radius, not the "
               "diameter, of the path of the body's middle; a vehicle that turns by its sides has "
               "steering: skid");
}

void check_attitude(const Vehicle& vehicle, CheckResults& results) {
  add_relation(results, vehicle.tilt_max_rad < 0.5 * std::numbers::pi, "vehicle",
               fmt::format("tilt_max_rad = {} is {:.0f}°", vehicle.tilt_max_rad,
                           rad_to_deg(vehicle.tilt_max_rad)),
               "an angle beyond the vertical; degrees instead of radians?");
  const double arm = 0.5 * std::min(vehicle.track_m, vehicle.wheelbase_m);
  const double tips = std::atan(arm / (kCentreOfMassShare * vehicle.height_m));
  add_relation(
      results, vehicle.tilt_max_rad <= tips, "vehicle",
      fmt::format("tilt_max_rad = {} against tipping over at atan({:.2f} / {:.2f}) = {:.2f}",
                  vehicle.tilt_max_rad, arm, kCentreOfMassShare * vehicle.height_m, tips),
      "with the centre of mass at half its height the vehicle tips over before; measure "
      "the angle, half of it is a good limit");
}

}  // namespace

void check_body(const RobotConfig& robot, CheckResults& results) {
  const Vehicle& vehicle = robot.vehicle;
  check_wheels(vehicle, results);
  check_footprint(vehicle, results);
  check_steering(vehicle, results);
  check_attitude(vehicle, results);
  const double volume_m3 = vehicle.length_m * vehicle.width_m * vehicle.height_m;
  const double density = vehicle.mass_kg / volume_m3;
  add_relation(results, density >= kDensityMin && density <= kDensityMax, "vehicle",
               fmt::format("mass_kg / (length_m width_m height_m) = {} / {:.3g} = {:.3g} kg/m³",
                           vehicle.mass_kg, volume_m3, density),
               "robots have 30 to 3000; lengths are in metres, the mass in kilograms");
}

}  // namespace adit
