// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "common/config/bounds.hpp"
#include "common/sensing/laser_mount.hpp"

namespace adit {

/// What the laser is set to. Scans of 180° have beams 1° or 0.5° apart, those of 100° also 0.25°.
/// The mirror measures one beam for each degree of a turn, so a scan takes 1, 2 or 4 turns.
struct LmsSettings {
  int baud = 38400;
  int field_of_view_deg = 180;
  double angle_step_deg = 1.0;
  std::string unit = "cm";  ///< of the readings: cm reaches 80 m, mm 8 m
  std::string password = "SICK_LMS";
  double mirror_hz = 75.0;

  template <class V>
  void visit(V& v) {
    v("baud", baud, within(9600, 500000));
    v("field_of_view_deg", field_of_view_deg, within(100, 180));
    v("angle_step_deg", angle_step_deg, within(0.25, 1.0));
    v("unit", unit, OneOf({"cm", "mm"}));
    v("password", password);
    v("mirror_hz", mirror_hz, within(50.0, 100.0));
  }

  /// Throws std::invalid_argument, with the remedy, for what no LMS can be set to.
  void require_valid() const;

  [[nodiscard]] int beams() const;
  [[nodiscard]] double unit_m() const { return unit == "mm" ? 0.001 : 0.01; }
  /// The largest distance that is not a code [m].
  [[nodiscard]] double range_max_m() const;
  [[nodiscard]] int turns() const;
  [[nodiscard]] double scan_period_us() const { return 1e6 * turns() / mirror_hz; }
  /// From the first beam of a scan to the last [µs].
  [[nodiscard]] double scan_duration_us() const;
  /// Bytes of a telegram with the readings.
  [[nodiscard]] int telegram_bytes() const { return 10 + 2 * beams(); }
  /// Time on the line [µs]; a byte has a start and a stop bit.
  [[nodiscard]] double byte_us() const { return 1e7 / baud; }
  [[nodiscard]] double telegram_us() const { return byte_us() * telegram_bytes(); }
};

/// The section of one laser.
struct SickLms2xxParams {
  std::string device = "/dev/ttyS0";
  LmsSettings laser;
  bool upside_down = false;  ///< mounted so; its beams are then published in reverse order
  double delay_ms = 0.0;     ///< least time from the last beam to the first byte on the line
  Lasers lasers;

  template <class V>
  void visit(V& v) {
    v("device", device);
    laser.visit(v);
    v("upside_down", upside_down);
    v("delay_ms", delay_ms, within(0.0, 1000.0));
    v.shared(Lasers::kSection, lasers);
  }
};

}  // namespace adit
