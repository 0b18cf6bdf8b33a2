// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/laser_tilt.hpp"
#include "common/types/cloud.hpp"
#include "procs/scan_assembly/beam_placement.hpp"
#include "procs/scan_assembly/gravity.hpp"
#include "procs/scan_assembly/mixed_pixels.hpp"
#include "procs/scan_assembly/sweep_motion.hpp"

namespace adit {

struct ScanAssemblyParams {
  Lasers lasers;
  ScanTiming timing;
  SweepMotionParams sweep;
  GravityParams gravity;
  MixedPixelParams mixed_pixels;
  double timeout_s = 4.0;         ///< beyond the time that the motions of the sweep take
  double sensor_timeout_s = 0.5;  ///< of the laser or its tilt, at which a sweep is cut short
  double moved_max_m = 0.05;      ///< of the body since the request, at which it is
  double moved_max_rad = 0.02;

  template <class V>
  void visit(V& v) {
    v.shared(Lasers::kSection, lasers);
    v("timing", timing);
    v("sweep", sweep);
    v("gravity", gravity);
    v("mixed_pixels", mixed_pixels);
    v("timeout_s", timeout_s, above(0.0));
    v("sensor_timeout_s", sensor_timeout_s, above(0.0));
    v("moved_max_m", moved_max_m, above(0.0));
    v("moved_max_rad", moved_max_rad, above(0.0));
  }
};

/// One 3D scan from one tilt sweep of a planar laser (paper, section 3): each beam is placed by the
/// tilt and the pose of the body at its own time, the body is levelled by gravity, mixed pixels are
/// left out. The robot is to stand; without readings of its pose it is taken to stand where it was
/// last seen.
///
/// Times that are passed beside readings are bus time, and only of them time-outs are reckoned:
/// sensors may have another clock.
class ScanAssembly {
 public:
  struct Step {
    std::optional<TiltCommand> command;  ///< to be sent to the laser of the sweep
    std::optional<Cloud> cloud;
  };

  explicit ScanAssembly(const ScanAssemblyParams& params);

  /// Where a sweep is under way, or the pose is not known, nothing happens but a complaint. The
  /// request of that sweep may be repeated.
  void begin(const ScanRequest& request, std::int64_t utime);

  // Each false where the reading is not used. While no sweep is under way, only poses and inertia
  // are. What is not finite is refused, and so are scans that do not advance in time; tilts and
  // poses may come in any order.
  bool add(LaserId laser, const LaserScan& scan);
  bool add(LaserId laser, const TiltReading& reading);
  bool add(const ImuReading& reading) { return gravity_.add(reading); }
  bool add(std::int64_t utime, const Pose2& T_odom_body);

  /// To be called at least some ten times per second. A sweep ends with a cloud; one that is cut
  /// short (time-out, silence, a robot that moves) with one that is not complete, or with none
  /// where there is not one line.
  Step advance(std::int64_t utime);

  /// Laser of the sweep that is, or was last, under way.
  [[nodiscard]] LaserId laser() const { return request_.laser; }
  /// What was wrong with the last request or sweep; empty where nothing was.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  [[nodiscard]] const LaserMount& mount() const;
  [[nodiscard]] bool is_repeat(const ScanRequest& request, std::int64_t utime) const;
  [[nodiscard]] bool uses_laser(LaserId laser) const;
  [[nodiscard]] std::string abort_reason(std::int64_t utime) const;
  std::optional<Cloud> abort_sweep(const std::string& reason);
  void start_lines();
  [[nodiscard]] std::optional<Cloud> assemble(bool complete) const;

  ScanAssemblyParams params_;
  SweepMotion sweep_;
  GravityEstimator gravity_;
  ScanRequest request_;
  std::string problem_;

  // Of the sweep that is under way.
  std::vector<LaserScan> scans_;
  InterpolationBuffer<double> tilt_rad_;
  InterpolationBuffer<Pose2> T_odom_body_;
  std::optional<Eigen::Vector3d> up_body_;
  Pose2 T_odom_begin_;
  std::int64_t first_line_utime_ = 0;  ///< before it the laser was on its way to the sweep
  std::int64_t begin_utime_ = 0;       ///< bus time of the request
  std::int64_t scan_utime_ = 0;        ///< bus time at which the laser was last heard
  std::int64_t tilt_utime_ = 0;        ///< the same of its tilt
  std::int64_t cloud_utime_ = 0;       ///< bus time at which it had its cloud

  std::int64_t utime_ = 0;  ///< bus time
  struct LastPose {
    std::int64_t utime = 0;
    Pose2 T_odom_body;
  };
  std::optional<LastPose> last_pose_;
};

}  // namespace adit
