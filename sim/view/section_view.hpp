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

/// The line of a section: that of the options; by default the tunnel at the start, along its
/// consecutive edges; in a world without a tunnel graph, a straight line through the start from
/// wall to wall. Its name is a caption.
TunnelLine section_line(const Site& site, const ViewOptions& options);

/// A window of a section and its scales.
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
  /// Distance along the line and height [m].
  [[nodiscard]] std::pair<double, double> place(const Eigen::Vector2d& uv) const;
};

/// Renders a vertical section along a line, seen from its right side: rock is dark, and the opening
/// shows the surfaces behind the cut.
class SectionView {
 public:
  static constexpr unsigned kRock = 0x3c3834;  ///< of rock that is cut through, as on the web

  /// Both must outlive this.
  SectionView(const Site& site, const TunnelLine& line) : site_(site), line_(line) {}

  /// Up to four windows of one scale for the complete line, placed below each other. Heights are
  /// exaggerated equally in all windows if the opening would be too flat otherwise.
  [[nodiscard]] std::vector<SectionWindow> windows(int width) const;

  [[nodiscard]] RgbImage draw(const SectionWindow& window) const;

 private:
  /// Floor and roof above one place of the line [m].
  struct Clearance {
    double floor_m = 0.0;
    double roof_m = 0.0;
  };

  /// Empty in rock.
  [[nodiscard]] std::optional<Clearance> clearance_at(double s_m) const;
  /// Opening at the centre of each of `count` equal parts of a window.
  [[nodiscard]] std::vector<std::optional<Clearance>> clearances(const SectionWindow& window,
                                                                 int count) const;

  const Site& site_;
  const TunnelLine& line_;
};

}  // namespace adit
