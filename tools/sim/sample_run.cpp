// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sim/sample_run.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "common/bus/log/lcm_log.hpp"
#include "common/files/new_file.hpp"
#include "sim/drive/waypoint_file.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/world_file.hpp"
#include "tools/carmen/carmen_import.hpp"
#include "tools/carmen/carmen_line.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStartUtime = 1'700'000'000'000'000;
constexpr double kScanPeriodS = 0.32;  // 0.16 m at full speed
constexpr double kGridScanPeriodS = 0.2;
constexpr double kLaserHeightM = 0.62;
constexpr std::size_t kNewest = 200;  // steps of 10 ms; a scan waits for less

/// Constant slip, to which the odometry is calibrated, so that the bias of the heading is the only
/// error that counts: after the loop, the estimate is some 10 m north of the true pose, in the
/// north tunnel. Random slip of 2 % in the bends would turn the heading by 0.05 rad. Walls return
/// at grazing incidence, too, so that a tunnel has the same appearance in both directions of
/// travel.
void set_parallel_errors(SimulationParams& params) {
  params.laser.range_at_10_percent_m = 300.0;
  params.motion.slip_sd = 0.0;
  params.motion.side_slip_sd_rad = 0.0;
  WheelOdometryParams& odometry = params.wheel_odometry;
  odometry.distance_scale = 1.0 - params.motion.slip_share;
  odometry.turn_scale = 1.0 - params.motion.slip_share;
  odometry.turn_bias_rad_per_m = -0.00016;
  odometry.distance_noise_m_per_sqrt_m = 0.005;
  odometry.turn_noise_rad_per_sqrt_m = 0.0002;
}

SimulationParams simulation_params(const SampleParams& sample) {
  SimulationParams params;
  params.lasers.front.T_body_laser = {};  // where LaserMount has it by default
  params.lasers.front.height_m = kLaserHeightM;
  params.laser.beams = sample.beams;
  params.laser.bearing_scale = sample.bearing_scale;
  const double period_s = params.laser.timing.scan_period_s(params.laser.angle_step_rad());
  const double scan_period_s = sample.world == "grid" ? kGridScanPeriodS : kScanPeriodS;
  params.laser.scan_decimation = static_cast<int>(std::lround(scan_period_s / period_s));
  if (sample.world == "parallel") set_parallel_errors(params);
  if (sample.turn_bias_rad_per_m) {
    params.wheel_odometry.turn_bias_rad_per_m = *sample.turn_bias_rad_per_m;
  }
  params.faults = {{.kind = "laser_dies", .at_s = 0.0, .target = "rear", .amount = 0.0}};
  return params;
}

WaypointDriver full_speed_driver(const SampleParams& sample) {
  const Vehicle vehicle;
  WaypointDriverParams params;
  params.speed_m_s = vehicle.speed_max_m_s;
  return {built_in_drive(sample.world), vehicle, params};
}

void append(Trajectory& trajectory, std::int64_t utime, const Pose2& pose) {
  trajectory.push_back({utime, pose});
  if (trajectory.size() > 2 * kNewest) {
    trajectory.erase(trajectory.begin(), trajectory.end() - kNewest);
  }
}

}  // namespace

SampleRun::SampleRun(const SampleParams& params)
    : length_max_m_(params.length_max_m),
      site_(std::make_unique<const Site>(build_world(find_world(params.world, params.seed)))),
      simulation_(*site_, simulation_params(params), static_cast<std::uint64_t>(params.seed),
                  kStartUtime),
      driver_(full_speed_driver(params)),
      motion_{{kStartUtime, in_plan(simulation_.vehicle().motion().T_world_body)}},
      wheel_odometry_{{kStartUtime, {}}} {}

std::optional<SampleReading> SampleRun::next() {
  while (!ended_ && (!scan_ || wheel_odometry_.back().utime < scan_->utime)) step();
  if (ended_) return std::nullopt;
  const std::int64_t utime = scan_->utime;
  const Pose2 T_world_body = *interpolate(motion_, utime);
  if (!truth_.empty()) {
    length_m_ += (T_world_body.translation() - truth_.back().pose.translation()).norm();
  }
  ended_ = length_m_ > length_max_m_;
  if (ended_) return std::nullopt;
  truth_.push_back({utime, T_world_body});
  return SampleReading{{utime, *interpolate(wheel_odometry_, utime)},
                       *std::exchange(scan_, std::nullopt)};
}

void SampleRun::step() {
  simulation_.command(driver_.command(simulation_.vehicle().motion()));
  const auto readings = simulation_.step();
  append(motion_, simulation_.utime(), in_plan(simulation_.vehicle().motion().T_world_body));
  for (const Reading& reading : readings) {
    if (const auto* laser = std::get_if<LaserReading>(&reading)) scan_ = laser->scan;
    if (const auto* wheels = std::get_if<WheelOdometry>(&reading)) {
      append(wheel_odometry_, wheels->utime, wheels->T_wheel_body);
    }
  }
  const std::string failure =
      driver_.abort_reason().value_or(simulation_.vehicle().failure().value_or(""));
  if (!failure.empty()) {
    throw std::runtime_error(fmt::format("the sample drive failed: {}", failure));
  }
  ended_ = driver_.done();
}

double SampleRun::fraction_done() const {
  if (ended_) return 1.0;
  const double length_m = std::min(driver_.length_m(), length_max_m_);
  return length_m > 0.0 ? std::min(driver_.progress_m() / length_m, 1.0) : 0.0;
}

namespace {

void write_lcm(SampleRun& run, const std::filesystem::path& path,
               const std::function<void(double)>& progress) {
  LogWriter log(path, LogWriter::Name::kWhenClosed);
  while (const auto reading = run.next()) {
    write_reading(log, reading->odometry);
    write_reading(log, reading->scan);
    progress(run.fraction_done());
  }
  log.close();
}

void write_carmen(SampleRun& run, const std::filesystem::path& path,
                  const std::function<void(double)>& progress) {
  NewFile file(path);
  std::ofstream log(file.part());
  while (const auto reading = run.next()) {
    const Pose2& pose = reading->odometry.T_wheel_body;
    log << flaser_line({reading->scan, pose, reading->odometry}) << "\n";
    if (!log) break;
    progress(run.fraction_done());
  }
  log.close();
  if (!log) throw std::runtime_error(fmt::format("cannot write {}", path.string()));
  file.publish();
}

}  // namespace

void write_sample_log(SampleRun& run, const std::filesystem::path& path,
                      const std::function<void(double)>& progress) {
  if (path.extension() == ".lcmlog") {
    write_lcm(run, path, progress);
  } else if (path.extension() == ".log") {
    write_carmen(run, path, progress);
  } else {
    throw std::runtime_error("the output must end in .lcmlog or .log, which selects the format");
  }
}

}  // namespace adit
