// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <vector>

namespace adit {

/// A Velodyne VLP-16 that measures a given surrounding, after the VLP-16 User Manual 63-9243 Rev.
/// E, chapters 8 and 9: sixteen lasers fire one after the other in the order of table 9-1, every
/// 55.296 µs, while the head turns clockwise; a packet of 12 blocks has 24 firings with one return
/// or 12 with two. Times are of the clock of the test [µs].
class Vlp16Emulator {
 public:
  struct Model {
    double rpm = 1200.0;
    std::uint8_t return_mode = 0x37;
    std::uint8_t product = 0x22;
    double clock_rate = 1.0;           ///< of its clock by that of the test
    std::uint32_t first_stamp_us = 0;  ///< after the hour, when it is switched on
    double boot_s = 0.2;
    double latency_us = 60.0;  ///< from the last firing of a packet to its arrival
  };
  struct Packet {
    std::int64_t arrival_us = 0;
    std::vector<std::uint8_t> bytes;
  };
  /// Range along a unit vector (x, y, z) of the frame of the manual: y along azimuth 0, x along
  /// 90°, z along the axis; negative for none [m].
  using Surrounding = std::function<double(double x, double y, double z)>;
  /// The same of a surrounding that moves, at a time.
  using MovingSurrounding = std::function<double(double us, double x, double y, double z)>;

  /// Azimuth of the first firing, `Model::boot_s` after it is switched on.
  static constexpr double kFirstAzimuthDeg = 77.0;

  Vlp16Emulator(const Model& model, MovingSurrounding surrounding)
      : model_(model), surrounding_(std::move(surrounding)) {}
  Vlp16Emulator(const Model& model, Surrounding surrounding)
      : Vlp16Emulator(
            model, [still = std::move(surrounding)](double /*us*/, double x, double y, double z) {
              return still(x, y, z);
            }) {}

  void power_on(std::int64_t now_us);
  void power_off() { on_us_.reset(); }
  /// Sets its clock, as GPS does.
  void set_stamp(std::uint32_t stamp_us) { stamp_offset_us_ = stamp_us - stamp_at(fired_us_); }
  void set_rpm(double rpm);

  /// The packets that arrived since the last call.
  std::vector<Packet> advance(std::int64_t now_us);

 private:
  [[nodiscard]] double stamp_at(double us) const;
  [[nodiscard]] double azimuth_deg(double us) const;
  [[nodiscard]] std::array<std::uint8_t, 48> fire(double us) const;
  Packet packet();

  Model model_;
  MovingSurrounding surrounding_;
  std::optional<std::int64_t> on_us_;
  double fired_us_ = 0.0;  ///< time of the next firing
  double stamp_offset_us_ = 0.0;
  double azimuth_origin_deg_ = 0.0;  ///< at azimuth_origin_us_
  double azimuth_origin_us_ = 0.0;
};

}  // namespace adit
