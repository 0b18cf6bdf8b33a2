// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/bus/lcm_bus.hpp"
#include "common/messages/lidar.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/spinning_lidar.hpp"
#include "common/sensing/vehicle_readings.hpp"

namespace adit {

/// Numbers that change with time, of the last seconds; linear between them.
template <std::size_t N>
class History {
 public:
  void add(std::int64_t utime, const std::array<double, N>& values) {
    if (!samples_.empty() && utime <= samples_.back().utime) return;
    samples_.push_back({utime, values});
    while (samples_.front().utime < utime - kLengthUs) samples_.pop_front();
  }

  /// The first or the last before and after those known.
  [[nodiscard]] std::array<double, N> at(std::int64_t utime) const {
    if (samples_.empty()) return {};
    auto after = samples_.end();
    while (after != samples_.begin() && (after - 1)->utime > utime) --after;
    if (after == samples_.begin()) return samples_.front().values;
    if (after == samples_.end()) return samples_.back().values;
    const Sample& before = *(after - 1);
    const double share = static_cast<double>(utime - before.utime) /
                         static_cast<double>(after->utime - before.utime);
    std::array<double, N> values{};
    for (std::size_t i = 0; i < N; ++i)
      values[i] = before.values[i] + share * (after->values[i] - before.values[i]);
    return values;
  }

  [[nodiscard]] bool empty() const { return samples_.empty(); }

 private:
  static constexpr std::int64_t kLengthUs = 2'000'000;
  struct Sample {
    std::int64_t utime = 0;
    std::array<double, N> values{};
  };
  std::deque<Sample> samples_;
};

/// The sensors of a robot that the simulator has beside wheels and IMU.
struct RobotSensors {
  double track_m = 0.0;  ///< between the sides of the vehicle: a turn is a difference of distances
  std::size_t tilting_lasers = 0;  ///< one at the front, or two
  bool has_lidar = false;          ///< a spinning lidar, each revolution of which is published
};

/// What the simulator on a bus of its own says about the sensors of the robot, and where it takes
/// commands: the world of emulated devices.
class SimulatedRobot {
 public:
  SimulatedRobot(const std::string& lcm_url, const RobotSensors& sensors);

  /// Handles messages that have arrived.
  void step();

  /// The time of the simulator, which runs in real time, up to which all of its messages have
  /// arrived; empty before the first of each kind.
  [[nodiscard]] std::optional<std::int64_t> now() const;

  [[nodiscard]] std::array<double, 2> travel_m(std::int64_t utime) const {
    return travel_history_.at(utime);
  }
  [[nodiscard]] double tilt_rad(LaserId laser, std::int64_t utime) const {
    return end_of(laser).tilt.at(utime)[0];
  }
  /// Accelerations [m/s²], then rates [rad/s], in the body frame.
  [[nodiscard]] std::array<double, 6> motion(std::int64_t utime) const { return motion_.at(utime); }
  /// The scan whose first beam is nearest to a time; null without scans.
  [[nodiscard]] const LaserScan* scan(LaserId laser, std::int64_t utime) const;

  /// The last revolution that began at this time or earlier; the first known without one, null
  /// without revolutions.
  [[nodiscard]] const LidarRevolution* revolution(std::int64_t utime) const;

  /// True distance driven so far and distance from its begin, in plan [m].
  [[nodiscard]] double true_travel_m() const { return true_travel_m_; }
  [[nodiscard]] double true_distance_m() const;

  /// Publishes what the base and the servo were told.
  void drive(double left_m_s, double right_m_s, bool stopped);
  void tilt(LaserId laser, double goal_rad, double rate_max_rad_s);

 private:
  struct End {
    History<1> tilt;
    std::deque<LaserScan> scans;
  };

  [[nodiscard]] const End& end_of(LaserId laser) const {
    return ends_.at(static_cast<std::size_t>(laser));
  }
  void subscribe_laser(LaserId laser);
  void handle(const WheelOdometry& odometry);
  void note(std::int64_t utime);

  LcmBus bus_;
  RobotSensors sensors_;
  std::optional<WheelOdometry> last_;
  std::array<double, 2> travel_m_{};
  History<2> travel_history_;
  History<6> motion_;
  std::vector<End> ends_;  ///< by LaserId
  LidarReassembler lidar_fragments_;
  std::deque<LidarRevolution> revolutions_;
  std::optional<Eigen::Vector2d> first_place_;
  Eigen::Vector2d last_place_ = Eigen::Vector2d::Zero();
  double true_travel_m_ = 0.0;
  std::int64_t last_utime_ = 0;
  std::optional<std::int64_t> behind_us_;  ///< of the clock of this computer, at least
};

}  // namespace adit
