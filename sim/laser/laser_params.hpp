// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include "common/config/bounds.hpp"
#include "common/sensing/laser_scan.hpp"

namespace adit {

/// Model of a planar laser with its errors, by default of a SICK LMS-200. Sources of the values:
/// docs/decisions/simulator.md.
struct LaserParams {
  int beams = 361;  ///< over the field of view; a SICK LMS-200 has 361, or 181 at twice the rate
  double unit_m =
      0.01;  ///< resolution of a reading; of 13 bits, 0.01 reaches 81.91 m, 0.001 reaches 8.191 m
  int reading_max = 8191;    ///< the reading for no return, in units
  double range_min_m = 0.2;  ///< shorter ranges read no return
  /// Maximum range of a surface of reflectivity 0.1 at normal incidence. That of other surfaces
  /// follows from the returned power, reflectivity · cos(incidence) / range².
  double range_at_10_percent_m = 30.0;
  /// True bearings as multiples of the reported ones: a calibration error that makes scan matching
  /// over- or underestimate turns.
  double bearing_scale = 1.0;
  double noise_sd_m = 0.005;    ///< of a single range, normal
  double offset_max_m = 0.015;  ///< systematic error, drawn for each laser, uniform within ± this
  int subrays = 1;              ///< across the beam, for mixed pixels: 1 or 9
  double spot_m = 0.008;        ///< diameter of a beam at the laser
  double divergence_rad = 0.0044;  ///< of the beam, full angle
  /// Surfaces within one pulse length merge into one echo between them. Of surfaces farther apart,
  /// the nearer one is measured if it returns at least `first_echo_share` of the power.
  double pulse_length_m = 0.5;
  double first_echo_share = 0.2;
  double scan_loss = 0.0;   ///< fraction of the scans that is lost, 0 to 1
  int scan_decimation = 1;  ///< only each n-th scan is simulated
  // Of the laser's mount (LaserMount), where the stages find them as well.
  double field_of_view_rad = std::numbers::pi;
  ScanTiming timing;

  template <class V>
  void visit(V& v) {
    v("beams", beams, within(2, 4096));
    v("unit_m", unit_m, within(0.0001, 0.1));
    v("reading_max", reading_max, within(100, 1'000'000));
    v("range_min_m", range_min_m, at_least(0.0));
    v("range_at_10_percent_m", range_at_10_percent_m, above(0.0));
    v("bearing_scale", bearing_scale, within(0.9, 1.1));
    v("noise_sd_m", noise_sd_m, at_least(0.0));
    v("offset_max_m", offset_max_m, at_least(0.0));
    v("subrays", subrays, within(1, 9));
    v("spot_m", spot_m, at_least(0.0));
    v("divergence_rad", divergence_rad, at_least(0.0));
    v("pulse_length_m", pulse_length_m, at_least(0.0));
    v("first_echo_share", first_echo_share, within(0.0, 1.0));
    v("scan_loss", scan_loss, within(0.0, 1.0));
    v("scan_decimation", scan_decimation, at_least(1));
  }

  /// The reading for no return: the maximum.
  [[nodiscard]] double no_return_m() const { return reading_max * unit_m; }
  /// Angle between two beams.
  [[nodiscard]] double angle_step_rad() const { return field_of_view_rad / (beams - 1); }
};

}  // namespace adit
