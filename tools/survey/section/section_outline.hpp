// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// The outline of a tunnel in a vertical plane across it, by its distance from a point inside in
/// directions at equal angles. In the frame of the section: u to the left of the centre line, z up;
/// both from that point. Angles count from u towards z.
struct SectionOutline {
  static constexpr std::size_t kRays = 120;
  static constexpr double kUnseen = std::numeric_limits<double>::quiet_NaN();
  static constexpr double kStepRad = 2.0 * std::numbers::pi / kRays;
  // In these directions.
  static constexpr std::size_t kLeft = 0;
  static constexpr std::size_t kUp = kRays / 4;
  static constexpr std::size_t kRight = kRays / 2;
  static constexpr std::size_t kDown = 3 * kRays / 4;

  struct Ray {
    double distance_m = kUnseen;
    double sd_m = kUnseen;

    [[nodiscard]] bool seen() const { return distance_m == distance_m; }
  };
  std::array<Ray, kRays> rays;

  /// Unit vector (u, z) of a ray.
  [[nodiscard]] static Eigen::Vector2d direction(std::size_t ray);
  /// Closes gaps of one or two rays between seen ones by a straight line, with a standard deviation
  /// of a tenth of its length.
  void close_small_gaps();
  /// Corners (u, z) of the rays that are seen, counter-clockwise.
  [[nodiscard]] std::vector<Eigen::Vector2d> corners() const;
};

/// A quantity and its standard deviation.
struct Measured {
  double value = 0.0;
  double sd = 0.0;
};

/// What is measured of an outline. A gap of the outline is closed by a straight line.
struct SectionMeasures {
  Measured width_m;   ///< horizontal, through the point inside; NaN if one side is unseen
  Measured height_m;  ///< vertical, through the point inside; NaN if roof or floor is unseen
  Measured area_m2;
  Measured perimeter_m;      ///< of the polygon through the ends of the rays
  double seen_share = 0.0;   ///< of the rays
  double gap_max_rad = 0.0;  ///< widest angle without a ray that is seen

  /// Whether area and perimeter are those of a closed outline, without an opening to the side.
  [[nodiscard]] bool is_closed() const;
};

/// `common_sd_m`: an error that all rays share, as that of the range of the lasers.
SectionMeasures measure(const SectionOutline& outline, double common_sd_m);

}  // namespace adit
