// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/geometry/attitude.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/laser_tilt.hpp"
#include "common/sensing/spinning_lidar.hpp"
#include "common/types/cloud.hpp"
#include "procs/scan_assembly/beam_placement.hpp"
#include "procs/scan_assembly/gravity.hpp"
#include "procs/scan_assembly/mixed_pixels.hpp"
#include "procs/scan_assembly/passed_revolutions.hpp"
#include "procs/scan_assembly/sweep_motion.hpp"

namespace adit {

struct ScanAssemblyParams {
  Lasers lasers;
  SweepMotionParams sweep;
  GravityParams gravity;
  MixedPixelParams mixed_pixels;
  int revolutions = 2;  ///< of a spinning lidar that stands, for one 3D scan
  PassedRevolutionsParams passed_revolutions;
  double timeout_s = 4.0;         ///< beyond the duration of the sweep motion
  double sensor_timeout_s = 0.5;  ///< of the laser and its tilt; aborts a sweep
  double moved_max_m = 0.05;      ///< motion of the body since the request; aborts a sweep
  double moved_max_rad = 0.02;

  template <class V>
  void visit(V& v) {
    v.shared(Lasers::kSection, lasers);
    v("sweep", sweep);
    v("gravity", gravity);
    v("mixed_pixels", mixed_pixels);
    v("revolutions", revolutions, within(1, 50));
    v("passed_revolutions", passed_revolutions);
    v("timeout_s", timeout_s, above(0.0));
    v("sensor_timeout_s", sensor_timeout_s, above(0.0));
    v("moved_max_m", moved_max_m, above(0.0));
    v("moved_max_rad", moved_max_rad, above(0.0));
  }
};

/// Assembles one 3D scan from one tilt sweep of a planar laser (section 3 of the paper): each beam
/// is placed by the tilt and the pose of the body at its own time, the body is levelled by gravity,
/// and mixed pixels are removed. The robot must stand; without new poses it is assumed to stand at
/// its last pose. With a spinning lidar there is no sweep: the scan is made
/// of its last revolutions, once gravity has been measured by the readings of the IMU after the
/// request, and of those made while it drove there (PassedRevolutions).
///
/// Times that are passed beside readings are bus time. Only bus time is used for timeouts, as
/// sensors may have another clock.
class ScanAssembly {
 public:
  struct Step {
    std::optional<TiltCommand> command;  ///< for the laser of the sweep
    std::optional<Cloud> cloud;
  };

  explicit ScanAssembly(const ScanAssemblyParams& params);

  /// Starts a sweep. Rejected, with a problem(), during another sweep or without a pose.
  /// Repetitions of the request of the current sweep are ignored.
  void begin(const ScanRequest& request, std::int64_t utime);

  // These return false if the reading is not used. Without a sweep only poses and IMU readings are
  // used. Readings that are not finite and scans that do not advance in time are rejected; tilts
  // and poses may arrive in any order.
  bool add(LaserId laser, const LaserScan& scan);
  bool add(LaserId laser, const TiltReading& reading);
  /// Without a request a revolution may be used for the next one (PassedRevolutions).
  bool add(const LidarRevolution& revolution);
  bool add(const ImuReading& reading);
  bool add(std::int64_t utime, const Pose2& T_odom_body, double z_odom_m,
           const Attitude& attitude = {});

  /// Must be called at least ten times per second. A sweep ends with a cloud. An aborted sweep
  /// (timeout, stale sensor, motion of the robot) ends with an incomplete cloud, or with none if
  /// there is no line.
  Step advance(std::int64_t utime);

  /// Laser of the current or last scan.
  [[nodiscard]] LaserId laser() const { return request_.laser; }
  /// The problem of the last request or sweep; empty without one.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  [[nodiscard]] const LaserMount& mount() const;
  [[nodiscard]] bool is_repeat(const ScanRequest& request, std::int64_t utime) const;
  [[nodiscard]] bool uses_laser(LaserId laser) const;
  [[nodiscard]] bool is_busy() const {
    return collects_ || sweep_.phase() != SweepMotion::Phase::kIdle;
  }
  Step advance_collection(std::int64_t utime);
  void measure_up();
  [[nodiscard]] std::string abort_reason(std::int64_t utime) const;
  [[nodiscard]] std::string collection_abort_reason(std::int64_t utime) const;
  [[nodiscard]] bool has_moved() const;
  [[nodiscard]] bool waits_for_gravity(std::int64_t utime) const;
  [[nodiscard]] bool has_imu() const;
  std::optional<Cloud> abort_sweep(const std::string& reason);
  void start_lines();
  [[nodiscard]] Cloud empty_cloud(std::int64_t utime, bool complete) const;
  [[nodiscard]] std::optional<Cloud> assemble(bool complete) const;
  [[nodiscard]] std::optional<Cloud> assemble_revolutions(bool complete);

  ScanAssemblyParams params_;
  SweepMotion sweep_;
  GravityEstimator gravity_;
  ScanRequest request_;
  std::string problem_;

  // The current sweep.
  std::vector<LaserScan> scans_;
  bool collects_ = false;  ///< revolutions of a spinning lidar
  std::vector<LidarRevolution> revolutions_;
  PassedRevolutions passed_;
  InterpolationBuffer<double> tilt_rad_;
  InterpolationBuffer<Pose2> T_odom_body_;
  InterpolationBuffer<double> z_odom_m_;  ///< of the body
  Eigen::Vector3d up_body_ = Eigen::Vector3d::UnitZ();
  Pose2 T_odom_begin_;
  std::int64_t first_line_utime_ = 0;  ///< the laser approached the start before it
  std::int64_t begin_utime_ = 0;       ///< bus time of the request
  std::int64_t scan_utime_ = 0;        ///< bus time of the last scan
  std::int64_t tilt_utime_ = 0;        ///< bus time of the last tilt
  std::int64_t imu_utime_ = 0;         ///< bus time of the last reading of the IMU
  std::int64_t cloud_utime_ = 0;       ///< bus time of the cloud

  std::int64_t utime_ = 0;  ///< bus time
  struct LastPose {
    std::int64_t utime = 0;
    Pose2 T_odom_body;
    double z_odom_m = 0.0;
    Attitude attitude;
  };
  std::optional<LastPose> last_pose_;
};

}  // namespace adit
