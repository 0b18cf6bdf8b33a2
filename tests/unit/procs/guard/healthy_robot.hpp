// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "procs/guard/guard.hpp"

namespace adit {

inline GuardParams groundhog_guard() {
  GuardParams params;
  params.lasers.front.T_body_laser = {1.05, 0.0, 0.0};
  params.lasers.rear.T_body_laser = {-1.05, 0.0, std::numbers::pi};
  for (LaserMount* mount : {&params.lasers.front, &params.lasers.rear}) {
    mount->height_m = 0.62;
    mount->range_min_m = 0.2;
  }
  return params;
}

/// A guard that receives all data from a robot that drives ahead without obstacles, at the rates of
/// lcmtypes/README.md. A test changes the data.
class HealthyRobot {
 public:
  static constexpr std::int64_t kStart = 1'600'000'000'000'000;
  static constexpr std::int64_t kStepUs = 10'000;

  explicit HealthyRobot(const GuardParams& params = groundhog_guard()) : guard_(params) {}

  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds * 1e6 / kStepUs); ++i) step();
  }

  /// Seconds until the order is to stop; nothing if it is not within the time.
  std::optional<double> seconds_to_stop(double seconds_max) {
    for (int i = 1; i * kStepUs <= std::lround(seconds_max * 1e6); ++i) {
      step();
      if (order.stopped) return i * kStepUs * 1e-6;
    }
    return std::nullopt;
  }

  static LaserScan free_scan() {
    return {0, std::vector<float>(361, 8.0F), -std::numbers::pi / 2.0, std::numbers::pi / 360.0};
  }
  /// Beams straight ahead that end at a range.
  static LaserScan scan_with(float range_m, int beams) {
    LaserScan scan = free_scan();
    std::fill_n(scan.ranges_m.begin() + 180 - beams / 2, beams, range_m);
    return scan;
  }

  [[nodiscard]] const Guard& guard() const { return guard_; }

  // The data.
  std::set<std::string>
      muted;  ///< sources without data: front, rear, tilt, pose, command, state, …
  double speed_m_s = 0.3;
  double curvature_1_m = 0.0;
  VehicleState state;
  Pose2 T_odom_body;
  LaserScan front = free_scan();
  LaserScan rear = free_scan();
  ImuReading imu{0, Eigen::Vector3d::Zero(), {0.0, 0.0, 9.81}};
  GasReading gas;
  SinkageReading sinkage;
  std::int64_t clock_ahead_us = 0;  ///< offset of the bus and all sources

  StopOrder order{0, true, "not evaluated yet"};

 private:
  template <class Value>
  void send(const char* source, int every_steps, Value value) {
    if (steps_ % every_steps != 0 || muted.contains(source)) return;
    value.utime = now_;
    guard_.receive(value, now_);
  }
  void send(const char* source, LaserId laser, LaserScan scan) {
    if (muted.contains(source)) return;
    scan.utime = now_ - 27'000;
    guard_.receive(laser, scan, now_);
  }

  void step() {
    ++steps_;
    now_ = kStart + steps_ * kStepUs + clock_ahead_us;
    send("imu", 1, imu);
    if (steps_ % 2 == 0 && !muted.contains("tilt")) {
      guard_.receive(LaserId::kFront, TiltReading{now_, 0.0, 0.0}, now_);
      guard_.receive(LaserId::kRear, TiltReading{now_, 0.0, 0.0}, now_);
    }
    if (steps_ % 3 == 0) send("front", LaserId::kFront, front);
    if (steps_ % 3 == 1) send("rear", LaserId::kRear, rear);
    if (steps_ % 3 == 2 && !muted.contains("pose")) guard_.receive_pose(T_odom_body, now_, now_);
    send("state", 10, state);
    send("gas", 50, gas);
    send("sinkage", 10, sinkage);
    if (steps_ % 100 == 1 && !muted.contains("supervisor")) guard_.receive_supervisor(now_, now_);
    send("command", 5, DriveCommand{0, speed_m_s, curvature_1_m});
    order = guard_.evaluate(now_);
  }

  Guard guard_;
  std::int64_t steps_ = 0;
  std::int64_t now_ = kStart;
};

}  // namespace adit
