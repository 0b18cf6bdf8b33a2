// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/sim/simulation/simulation_fixture.hpp"

namespace adit {
namespace {

class Bytes {
 public:
  template <class Number>
  void add_all(const Number* numbers, std::size_t count) {
    bytes_.append(reinterpret_cast<const char*>(numbers), count * sizeof(Number));
  }
  void add(const auto&... numbers) { (add_all(&numbers, 1), ...); }

  void operator()(const LaserReading& laser) {
    add(laser.laser, laser.scan.utime, laser.scan.angle_min_rad, laser.scan.angle_step_rad);
    add_all(laser.scan.ranges_m.data(), laser.scan.ranges_m.size());
  }
  void operator()(const LidarRevolution& revolution) {
    add(revolution.utime);
    add_all(revolution.ranges_m.data(), revolution.ranges_m.size());
  }
  void operator()(const LaserTiltReading& tilt) {
    add(tilt.laser, tilt.reading.utime, tilt.reading.angle_rad, tilt.reading.rate_rad_s);
  }
  void operator()(const WheelOdometry& wheels) {
    add(wheels.utime, wheels.T_wheel_body.x, wheels.T_wheel_body.y, wheels.T_wheel_body.theta);
  }
  void operator()(const ImuReading& imu) {
    add(imu.utime);
    add_all(imu.angular_velocity.data(), 3);
    add_all(imu.linear_acceleration.data(), 3);
  }
  void operator()(const GasReading& gas) {
    add(gas.utime, gas.methane_share, gas.oxygen_share, gas.carbon_monoxide_share);
  }
  void operator()(const SinkageReading& sinkage) {
    add(sinkage.utime);
    add_all(sinkage.depth_m.data(), sinkage.depth_m.size());
  }
  void operator()(const VehicleState& state) {
    add(state.utime, state.speed_m_s, state.curvature_1_m, state.battery_share, state.stopped,
        state.expired);
  }
  void operator()(const BodyMotion& motion) {
    add(motion.utime);
    add_all(motion.T_world_body.data(), 16);
    add_all(motion.v_body.data(), 3);
    add_all(motion.omega_body.data(), 3);
  }
  void operator()(const RunState& state) {
    add(state.utime, state.distance_travelled_m);
    bytes_ += state.failure;
  }

  [[nodiscard]] const std::string& text() const { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace

std::string bytes_of(const Reading& reading) {
  Bytes bytes;
  std::visit(bytes, reading);
  return std::to_string(reading.index()) + bytes.text();
}

}  // namespace adit
