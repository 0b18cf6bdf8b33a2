// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/live/drivers/simulated_robot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "common/service/wall_time.hpp"

namespace adit {
namespace {

constexpr std::int64_t kLateUs = 60'000;        // of a message of the simulator, at most
constexpr std::int64_t kLidarLateUs = 120'000;  // with a revolution, which is sent at its end
constexpr std::size_t kRevolutionsMax = 10;
constexpr std::size_t kScansMax = 40;
constexpr double kStandsMS = 1e-3;
constexpr std::size_t kQueue = 1000;

}  // namespace

SimulatedRobot::SimulatedRobot(const std::string& lcm_url, const RobotSensors& sensors)
    : bus_({.url = lcm_url}), sensors_(sensors), ends_(sensors.tilting_lasers) {
  for (std::size_t i = 0; i < ends_.size(); ++i) subscribe_laser(static_cast<LaserId>(i));
  if (sensors.has_lidar) {
    subscribe<spinning_lidar_t>(bus_, channels::kLidar, Delivery::queued(kQueue),
                                [this](const LidarFragment& fragment) {
                                  auto revolution = lidar_fragments_.add(fragment);
                                  if (!revolution) return;
                                  revolutions_.push_back(std::move(*revolution));
                                  if (revolutions_.size() > kRevolutionsMax)
                                    revolutions_.pop_front();
                                });
  }
  subscribe<wheel_odometry_t>(bus_, channels::kWheelOdometry, Delivery::queued(kQueue),
                              [this](const WheelOdometry& odometry) { handle(odometry); });
  subscribe<imu_t>(bus_, channels::kImu, Delivery::queued(kQueue),
                   [this](const ImuReading& reading) {
                     const Eigen::Vector3d& a = reading.linear_acceleration;
                     const Eigen::Vector3d& w = reading.angular_velocity;
                     note(reading.utime);
                     motion_.add(reading.utime, {a.x(), a.y(), a.z(), w.x(), w.y(), w.z()});
                   });
  subscribe<pose_t>(bus_, channels::kTruth, Delivery::queued(kQueue),
                    [this](const StampedPose& pose) {
                      const Eigen::Vector2d place = pose.T_odom_body.translation();
                      if (first_place_) true_travel_m_ += (place - last_place_).norm();
                      if (!first_place_) first_place_ = place;
                      last_place_ = place;
                    });
}

void SimulatedRobot::subscribe_laser(LaserId laser) {
  End& end = ends_.at(static_cast<std::size_t>(laser));
  const bool is_front = laser == LaserId::kFront;
  subscribe<tilt_t>(bus_, is_front ? channels::kTiltFront : channels::kTiltRear,
                    Delivery::queued(kQueue), [this, &end](const TiltReading& reading) {
                      note(reading.utime);
                      end.tilt.add(reading.utime, {reading.angle_rad});
                    });
  subscribe<planar_lidar_t>(bus_, is_front ? channels::kLaserFront : channels::kLaserRear,
                            Delivery::queued(kQueue), [this, &end](const LaserScan& scan) {
                              note(scan.utime);
                              end.scans.push_back(scan);
                              if (end.scans.size() > kScansMax) end.scans.pop_front();
                            });
}

double SimulatedRobot::true_distance_m() const {
  return first_place_ ? (last_place_ - *first_place_).norm() : 0.0;
}

void SimulatedRobot::step() {
  while (bus_.handle(0)) {
  }
}

void SimulatedRobot::note(std::int64_t utime) {
  const std::int64_t behind_us = wall_utime() - utime;
  behind_us_ = behind_us_ ? std::min(*behind_us_, behind_us) : behind_us;
  last_utime_ = std::max(last_utime_, utime);
}

/// The distances of both sides are those whose mean and difference are the measured motion.
void SimulatedRobot::handle(const WheelOdometry& odometry) {
  note(odometry.utime);
  if (last_) {
    const Pose2 motion = between(last_->T_wheel_body, odometry.T_wheel_body);
    const double turn = odometry.T_wheel_body.theta - last_->T_wheel_body.theta;
    const double ahead_m = std::copysign(std::hypot(motion.x, motion.y), motion.x);
    travel_m_[0] += ahead_m - 0.5 * turn * sensors_.track_m;
    travel_m_[1] += ahead_m + 0.5 * turn * sensors_.track_m;
  }
  last_ = odometry;
  travel_history_.add(odometry.utime, travel_m_);
}

std::optional<std::int64_t> SimulatedRobot::now() const {
  const auto has_nothing = [](const End& end) { return end.tilt.empty() || end.scans.empty(); };
  if (travel_history_.empty() || motion_.empty() || std::ranges::any_of(ends_, has_nothing))
    return std::nullopt;
  if (sensors_.has_lidar && revolutions_.empty()) return std::nullopt;
  return wall_utime() - *behind_us_ - (sensors_.has_lidar ? kLidarLateUs : kLateUs);
}

const LaserScan* SimulatedRobot::scan(LaserId laser, std::int64_t utime) const {
  const std::deque<LaserScan>& scans = end_of(laser).scans;
  const auto off_us = [utime](const LaserScan& scan) { return std::abs(scan.utime - utime); };
  const auto nearest = std::ranges::min_element(scans, {}, off_us);
  return nearest == scans.end() ? nullptr : &*nearest;
}

const LidarRevolution* SimulatedRobot::revolution(std::int64_t utime) const {
  if (revolutions_.empty()) return nullptr;
  const auto later = std::ranges::find_if(
      revolutions_, [utime](const LidarRevolution& each) { return each.utime > utime; });
  return later == revolutions_.begin() ? &revolutions_.front() : &*(later - 1);
}

void SimulatedRobot::drive(double left_m_s, double right_m_s, bool stopped) {
  const double speed_m_s = 0.5 * (left_m_s + right_m_s);
  const double turn_rad_s = (right_m_s - left_m_s) / sensors_.track_m;
  const double curvature_1_m = std::abs(speed_m_s) < kStandsMS ? 0.0 : turn_rad_s / speed_m_s;
  publish(bus_, channels::kDriveCommand,
          to_message(DriveCommand{last_utime_, speed_m_s, curvature_1_m}));
  publish(bus_, channels::kStop,
          to_message(StopOrder{last_utime_, stopped, stopped ? "the base brakes" : ""}));
}

void SimulatedRobot::tilt(LaserId laser, double goal_rad, double rate_max_rad_s) {
  publish(bus_, laser == LaserId::kFront ? channels::kTiltCommandFront : channels::kTiltCommandRear,
          to_message(TiltCommand{last_utime_, goal_rad, rate_max_rad_s}));
}

}  // namespace adit
