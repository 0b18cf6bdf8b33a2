// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include "adit/gas_t.hpp"
#include "adit/imu_t.hpp"
#include "adit/planar_lidar_t.hpp"
#include "adit/scan_request_t.hpp"
#include "adit/sinkage_t.hpp"
#include "adit/spinning_lidar_t.hpp"
#include "adit/tilt_command_t.hpp"
#include "adit/tilt_t.hpp"
#include "adit/wheel_odometry_t.hpp"

#include "common/messages/fields/fields.hpp"

/// The fields of the messages of sensors and their actuators, see Fields.
namespace adit {

inline constexpr double kTwoTurnsRad = 4.0 * std::numbers::pi;
inline constexpr Quantity kFirstBearing{-kTwoTurnsRad, kTwoTurnsRad, "implausible first bearing"};
inline constexpr Quantity kBearingStep{1e-9, kTwoTurnsRad, "bearings do not increase"};

template <>
struct Fields<planar_lidar_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("nranges", m.nranges, kCount);
    field("ranges", m.ranges, kAny);
    field("nintensities", m.nintensities, kCount);
    field("intensities", m.intensities, kAny);
    field("rad0", m.rad0, kFirstBearing);
    field("radstep", m.radstep, kBearingStep);
  }
};

inline constexpr Quantity kFragmentCount{0.0, 1e5, "implausible number of fragments"};
inline constexpr Quantity kFragmentIndex{0.0, 1e5, "fragment index out of range"};
inline constexpr Quantity kColumnTime{0.0, 1e7, "implausible time of a column"};  // [µs]
inline constexpr Quantity kRangeUnit{1e-5, 1.0, "implausible unit of the ranges"};

template <>
struct Fields<spinning_lidar_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("n_rings", m.n_rings, kCount);
    field("elevations_rad", m.elevations_rad, kAngle);
    field("ring_azimuths_rad", m.ring_azimuths_rad, kAngle);
    field("ring_times_us", m.ring_times_us, kColumnTime);
    field("range_unit_m", m.range_unit_m, kRangeUnit);
    field("n_fragments", m.n_fragments, kFragmentCount);
    field("fragment", m.fragment, kFragmentIndex);
    field("n_columns", m.n_columns, kCount);
    field("times_us", m.times_us, kColumnTime);
    field("azimuths_rad", m.azimuths_rad, kFirstBearing);
    field("ranges", m.ranges, kAny);
  }
};

template <>
struct Fields<imu_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("angular_velocity_rad_s", m.angular_velocity_rad_s, kAngularVelocity);
    field("linear_acceleration_m_s2", m.linear_acceleration_m_s2, kAcceleration);
    field("has_orientation", m.has_orientation, kFlag);
    field("orientation", m.orientation, kAny);  // not used
  }
};

template <>
struct Fields<wheel_odometry_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("x_m", m.x_m, kPosition);
    field("y_m", m.y_m, kPosition);
    field("theta_rad", m.theta_rad, kUnwrappedHeading);
    field("forward_m_s", m.forward_m_s, kAny);        // not used
    field("yaw_rate_rad_s", m.yaw_rate_rad_s, kAny);  // not used
  }
};

template <>
struct Fields<tilt_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("angle_rad", m.angle_rad, kAngle);
    field("rate_rad_s", m.rate_rad_s, kRate);
  }
};

template <>
struct Fields<tilt_command_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("goal_rad", m.goal_rad, kAngle);
    field("rate_max_rad_s", m.rate_max_rad_s, kRateMax);
  }
};

template <>
struct Fields<scan_request_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("id", m.id, kId);
    field("laser", m.laser, kName);
  }
};

template <>
struct Fields<gas_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("methane_share", m.methane_share, kShare);
    field("oxygen_share", m.oxygen_share, kShare);
    field("carbon_monoxide_share", m.carbon_monoxide_share, kShare);
  }
};

template <>
struct Fields<sinkage_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("depth_m", m.depth_m, kDepth);
  }
};

}  // namespace adit
