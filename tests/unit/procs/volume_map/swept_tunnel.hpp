// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/geometry/pose2.hpp"
#include "common/types/cloud.hpp"
#include "sim/sweep/tilt_sweep.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit::test {

/// A sweep in the tunnel of tests/support/worlds/box_tunnel.hpp from a pose, by a laser without
/// noise and with a resolution of 1 mm.
inline Cloud sweep_of_tunnel(const Pose2& T_world_level, int lines = 60) {
  static const Site site(box_tunnel());
  TiltSweep sweep;
  sweep.scans = lines;
  sweep.laser.noise_sd_m = 0.0;
  sweep.laser.offset_max_m = 0.0;
  sweep.laser.unit_m = 0.001;
  sweep.laser.range_at_10_percent_m = 1000.0;
  sweep.mount.range_max_m = 8.0;  // 8.191 m means no return
  Cloud cloud = tilt_sweep(site, level_on_floor(site.world(), T_world_level), sweep);
  cloud.utime = 1'600'000'000'000'000;
  return cloud;
}

}  // namespace adit::test
