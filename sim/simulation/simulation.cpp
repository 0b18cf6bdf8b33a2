// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/sensing/seconds.hpp"
#include "common/sensing/vehicle_readings.hpp"
#include "sim/simulation/fault_injection.hpp"
#include "sim/simulation/random_stream.hpp"
#include "sim/simulation/spinning_lidar.hpp"
#include "sim/simulation/tilting_laser.hpp"
#include "sim/vehicle/proprioception.hpp"
#include "sim/world/world.hpp"

namespace adit {
namespace {

/// Composition of the air at a point of the plan. Gas pockets add up; methane displaces oxygen
/// proportionally. There is no carbon monoxide.
GasReading air_at(const World& world, const Eigen::Vector2d& p_world, std::int64_t utime) {
  GasReading reading;
  reading.utime = utime;
  for (const GasPocket& pocket : world.gas) {
    const double distances = (p_world - pocket.p_world).norm() / pocket.radius_m;
    reading.methane_share += pocket.methane_share * std::exp(-0.5 * distances * distances);
  }
  reading.methane_share = std::min(reading.methane_share, 1.0);
  reading.oxygen_share *= 1.0 - reading.methane_share;
  return reading;
}

constexpr double kStepS = seconds(Simulation::kStepUs);

// Periods in steps.
constexpr std::int64_t kTiltEvery = 2;
constexpr std::int64_t kWheelsEvery = 5;
constexpr std::int64_t kGasEvery = 50;
constexpr std::int64_t kSinkageEvery = 10;
constexpr std::int64_t kVehicleEvery = 10;
constexpr std::int64_t kTruthEvery = 2;
constexpr std::int64_t kRunEvery = 100;

void check_no_return(const LaserMount& mount, const LaserParams& laser) {
  if (mount.range_max_m > laser.no_return_m()) {
    throw std::invalid_argument(
        "lasers: range_max_m exceeds laser.reading_max times laser.unit_m of sim, which "
        "is the reading for no return");
  }
}

SpinningLidar::Setup lidar_setup(const SimulationParams& params, std::uint64_t seed) {
  check_no_return(params.lasers.front, params.laser);
  if (params.lasers.has_rear()) {
    throw std::invalid_argument(
        "lasers: a spinning lidar takes the place of all lasers: count must be 1");
  }
  return {params.lasers, params.lidar, params.laser, stream_seed(seed, RandomStream::kFrontLaser),
          stream_seed(seed, RandomStream::kFrontScanLoss)};
}

TiltingLaser::Setup laser_setup(const SimulationParams& params, SimLaser laser,
                                std::uint64_t seed) {
  const bool front = laser == SimLaser::kFront;
  const LaserMount& mount = front ? params.lasers.front : params.lasers.rear;
  LaserParams model = params.laser;
  model.field_of_view_rad = mount.field_of_view_rad;
  model.timing = mount.timing;
  check_no_return(mount, params.laser);
  return {mount,
          model,
          params.tilt,
          front ? 0.0 : 0.5,
          stream_seed(seed, front ? RandomStream::kFrontLaser : RandomStream::kRearLaser),
          stream_seed(seed, front ? RandomStream::kFrontScanLoss : RandomStream::kRearScanLoss),
          front ? params.front_mount_error : MountErrorParams{}};
}

}  // namespace

class Simulation::Impl {
 public:
  Impl(const Site& site, const SimulationParams& params, std::uint64_t seed,
       std::int64_t start_utime)
      : site_(site),
        params_(params),
        faults_(params.faults, start_utime),
        vehicle_(site, params.vehicle, params.motion, stream_seed(seed, RandomStream::kVehicle),
                 start_utime),
        wheels_(params.wheel_odometry, stream_seed(seed, RandomStream::kWheelOdometry),
                params.vehicle),
        imu_(params.imu, stream_seed(seed, RandomStream::kImu)),
        queue_(faults_, stream_seed(seed, RandomStream::kPacketLoss)),
        utime_(start_utime) {
    for (const SimLaser laser : laser_ids())
      lasers_.push_back(make_laser(laser, seed, start_utime));
    if (params_.lasers.lidar.present) {
      lidar_.emplace(site_.scene(), lidar_setup(params_, seed), start_utime,
                     vehicle_.motion().T_world_body);
    }
  }

  void command(const DriveCommand& command) { vehicle_.command(command); }
  void command(const StopOrder& order) { vehicle_.command(order); }
  void command(SimLaser laser, const TiltCommand& command) {
    if (std::ranges::count(laser_ids(), laser) > 0) of(laser).command(command);
  }

  std::vector<Reading> step() {
    const BodyMotion before = vehicle_.motion();
    const bool was_over = vehicle_.failure().has_value();
    advance();
    add_scans();
    if (lidar_) add_revolutions();
    add_sensors(before);
    add_truth(!was_over && vehicle_.failure());
    return queue_.take();
  }

  [[nodiscard]] std::int64_t utime() const { return utime_; }
  [[nodiscard]] const VehicleModel& vehicle() const { return vehicle_; }
  [[nodiscard]] RunState state() const {
    return {utime_, vehicle_.distance_travelled_m(), vehicle_.failure().value_or("")};
  }

 private:
  [[nodiscard]] TiltingLaser make_laser(SimLaser laser, std::uint64_t seed,
                                        std::int64_t utime) const {
    return {site_.scene(), laser_setup(params_, laser, seed), utime,
            vehicle_.motion().T_world_body};
  }

  [[nodiscard]] std::vector<SimLaser> laser_ids() const {
    if (params_.lasers.lidar.present) return {};
    if (params_.lasers.has_rear()) return {SimLaser::kFront, SimLaser::kRear};
    return {SimLaser::kFront};
  }

  TiltingLaser& of(SimLaser laser) { return lasers_[laser == SimLaser::kFront ? 0 : 1]; }

  void advance() {
    ++steps_;
    utime_ += kStepUs;
    vehicle_.advance(kStepS);
    const VehicleState state = vehicle_.state();
    wheels_.advance(state.speed_m_s, state.curvature_1_m, kStepS);
    for (TiltingLaser& laser : lasers_) laser.advance(utime_, vehicle_.motion().T_world_body);
    if (lidar_) lidar_->advance(utime_, vehicle_.motion().T_world_body);
  }

  void add_scans() {
    for (const SimLaser laser : laser_ids()) {
      const auto alive = [&](std::int64_t utime) { return faults_.alive(laser, utime); };
      for (auto& [utime, scan] : of(laser).finished_scans(alive)) {
        queue_.add(utime, LaserReading{laser, std::move(scan)});
      }
    }
  }

  void add_revolutions() {
    const auto alive = [&](std::int64_t utime) { return faults_.alive(SimLaser::kFront, utime); };
    for (auto& finished : lidar_->finished(alive)) {
      if (finished.revolution) queue_.add(finished.utime, std::move(*finished.revolution));
      queue_.add(finished.utime, LaserReading{SimLaser::kFront, std::move(finished.level)});
    }
  }

  void add_sensors(const BodyMotion& before) {
    const auto add = [&](Reading reading) { queue_.add(utime_, std::move(reading)); };
    if (is_time(kTiltEvery)) {
      for (const SimLaser laser : laser_ids()) {
        add(LaserTiltReading{laser, of(laser).tilt_reading()});
      }
    }
    if (params_.wheel_odometry.present && is_time(kWheelsEvery)) add(wheels_.reading(utime_));
    if (params_.imu.present) add(imu_.measure(before, vehicle_.motion(), kStepS));
    if (is_time(kGasEvery)) {
      const Eigen::Vector3d p_world = vehicle_.motion().T_world_body.translation();
      add(air_at(site_.world(), p_world.head<2>(), utime_));
    }
    if (is_time(kSinkageEvery)) add(SinkageReading{utime_, vehicle_.sinkage_m()});
    if (is_time(kVehicleEvery)) add(vehicle_.state());
  }

  void add_truth(bool just_failed) {
    if (is_time(kTruthEvery)) queue_.add(utime_, vehicle_.motion());
    if (just_failed || is_time(kRunEvery)) queue_.add(utime_, state());
  }

  [[nodiscard]] bool is_time(std::int64_t every) const { return steps_ % every == 0; }

  const Site& site_;
  SimulationParams params_;
  FaultSchedule faults_;
  VehicleModel vehicle_;
  std::vector<TiltingLaser> lasers_;  ///< front, rear; none with a spinning lidar
  std::optional<SpinningLidar> lidar_;
  DeadReckoning wheels_;
  InertialUnit imu_;
  ReadingQueue queue_;
  std::int64_t utime_;
  std::int64_t steps_ = 0;
};

Simulation::Simulation(const Site& site, const SimulationParams& params, std::uint64_t seed,
                       std::int64_t start_utime)
    : impl_(std::make_unique<Impl>(
          site, params,
          params.noise_seed < 0 ? seed : static_cast<std::uint64_t>(params.noise_seed),
          start_utime)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::command(const DriveCommand& command) { impl_->command(command); }
void Simulation::command(const StopOrder& order) { impl_->command(order); }
void Simulation::command(SimLaser laser, const TiltCommand& command) {
  impl_->command(laser, command);
}

std::vector<Reading> Simulation::step() { return impl_->step(); }

std::int64_t Simulation::utime() const { return impl_->utime(); }
const VehicleModel& Simulation::vehicle() const { return impl_->vehicle(); }
RunState Simulation::state() const { return impl_->state(); }

}  // namespace adit
