// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/types/vehicle.hpp"
#include "procs/driving/path_run.hpp"

namespace adit {

struct PassageCentringParams {
  double clearance_m = 0.1;  ///< mean of both sides, below which a passage is narrow
  double offset_max_m = 0.06;

  template <class V>
  void visit(V& v) {
    v("clearance_m", clearance_m, at_least(0.0));
    v("offset_max_m", offset_max_m, within(0.0, 0.5));
  }
};

/// Moves the path to where a narrow passage leaves the body equal room on both sides. A path is
/// planned on a grid, from the terrain of a 3D scan some metres back, and is off by two or three
/// centimetres. Where the walls leave five on either side, the guard then stops each correction of
/// the steering. Both walls are measured over the length of the body, ahead of it and behind it, by
/// the level lasers: in a bend its flank is near the inner wall, and its corners are near the outer
/// one. The offset of the path is a function of the arc length, interpolated beside the body, which
/// the lasers do not see. A passage in which only one wall is near, or both are farther than
/// `clearance_m`, has the offset 0.
class PassageCentring {
 public:
  /// Throws as SteeredPoint does.
  PassageCentring(const Vehicle& vehicle, const PassageCentringParams& params);

  /// Another run begins.
  void reset() { bins_.clear(); }
  /// Adds a scan: its points at the height of obstacles in odom, NaN for none. `s_m` is the arc
  /// length of the robot on the run.
  void add(const std::vector<Eigen::Vector2d>& p_odom, const PathRun& run, double s_m);

  /// The path is to be driven so far to its left: smoothed over 0.6 m.
  [[nodiscard]] double offset_m(double s_m) const;
  /// The derivative of the offset by the arc length.
  [[nodiscard]] double slope(double s_m) const;

 private:
  struct Bin {
    double sum_m = 0.0;
    int count = 0;
  };

  void add_window(const std::vector<Eigen::Vector2d>& p_odom, const PathRun& run, double s_m);
  [[nodiscard]] double clearance_m(std::vector<double>& beside_m) const;
  [[nodiscard]] double bin_offset_m(int bin) const;

  PassageCentringParams params_;
  SteeredPoint steered_;
  double half_width_m_;
  double length_m_;
  std::map<int, Bin> bins_;  ///< by arc length
};

}  // namespace adit
