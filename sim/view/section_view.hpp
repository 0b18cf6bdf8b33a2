// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/picture/rgb_image.hpp"
#include "sim/view/view_options.hpp"
#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// The line along which a mine is cut: that of the options; where they name none, the drift at the
/// start, over all its edges that follow each other; in a world that knows no drifts, straight
/// ahead through the start from wall to wall. Its name is for people.
TunnelLine section_line(const Site& site, const ViewOptions& options);

/// A stretch of a section and its scales.
struct SectionWindow {
  double from_m = 0.0;  ///< along the line
  double to_m = 0.0;
  double z_low_m = 0.0;  ///< in world
  double z_high_m = 0.0;
  double pixels_per_metre = 1.0;  ///< along the line
  double exaggeration = 1.0;      ///< of heights

  [[nodiscard]] int width() const;   ///< [pixels]
  [[nodiscard]] int height() const;  ///< [pixels]
  /// (u, v) as in Camera.
  [[nodiscard]] Eigen::Vector2d pixel(double s_m, double z_m) const;
  /// The distance along the line and the height there [m].
  [[nodiscard]] std::pair<double, double> place(const Eigen::Vector2d& uv) const;
};

/// A mine cut open along a line, seen from its right side: rock is dark, and within the opening
/// shows what lies behind the cut.
class SectionView {
 public:
  static constexpr unsigned kRock = 0x3c3834;  ///< of rock that is cut through, as on the web

  /// Both must outlive this.
  SectionView(const Site& site, const TunnelLine& line) : site_(site), line_(line) {}

  /// The whole line in up to four windows of one scale, to be put below each other. Heights are
  /// exaggerated where the opening would be a line else, by as much in all.
  [[nodiscard]] std::vector<SectionWindow> windows(int width) const;

  [[nodiscard]] RgbImage draw(const SectionWindow& window) const;

 private:
  /// Floor and roof above one place of the line [m].
  struct Clearance {
    double floor_m = 0.0;
    double roof_m = 0.0;
  };

  /// Nothing in rock.
  [[nodiscard]] std::optional<Clearance> clearance_at(double s_m) const;
  /// Openings at `count` places within a window, in the middle of as many equal parts.
  [[nodiscard]] std::vector<std::optional<Clearance>> clearances(const SectionWindow& window,
                                                                 int count) const;

  const Site& site_;
  const TunnelLine& line_;
};

}  // namespace adit
