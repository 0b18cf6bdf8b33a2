// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/polyline.hpp"
#include "common/types/exploration.hpp"
#include "tools/survey/frame/registered_cloud.hpp"
#include "tools/survey/section/section_outline.hpp"

namespace adit {

/// The centre line of a tunnel, in the frame of the survey.
struct CentreLine {
  int tunnel = 0;  ///< number, from 1
  int from = 0;    ///< nodes of the corridor graph
  int to = 0;
  double width_m = 0.0;  ///< median, by the level lasers
  bool from_junction = false;
  bool to_junction = false;
  Polyline line;

  /// Whether a place is in the opening of a junction at an end, where the tunnel has no walls.
  [[nodiscard]] bool is_in_junction(double chainage_m) const;
};

/// The corridors of the exploration, each point placed by the local map nearest to it.
std::vector<CentreLine> centre_lines(const CorridorGraph& corridors, const SurveyGraph& graph);

/// A vertical plane across a centre line.
struct SectionPlane {
  int tunnel = 0;
  double chainage_m = 0.0;  ///< along the centre line from its first node
  Eigen::Vector2d p_survey{0.0, 0.0};
  Eigen::Vector2d along{1.0, 0.0};  ///< unit vector
  double z_path_m = 0.0;            ///< of the ground, by the nearest place of the path
  double width_expected_m = 0.0;    ///< of the tunnel, by the level lasers
  bool in_junction = false;

  [[nodiscard]] Eigen::Vector2d left() const { return {-along.y(), along.x()}; }
};

struct SectionParams {
  double every_m = 5.0;        ///< distance between sections
  double half_slab_m = 0.2;    ///< returns this close to the plane count
  double reach_m = 10.0;       ///< from the centre line, to either side
  double middle_m = 0.7;       ///< height over the path at which the space is taken to be open
  double range_max_m = 15.0;   ///< returns from farther away are sparse
  double common_sd_m = 0.004;  ///< error of ranges that all returns share
};

/// A section with what was measured in it.
struct CrossSection {
  SectionPlane plane;
  double z_middle_m = 0.0;  ///< height of the point inside of the outline
  SectionOutline outline;
  SectionMeasures measures;
  Measured floor_m;  ///< heights at the centre line; NaN where unseen
  Measured roof_m;
  double plan_sd_m = 0.0;  ///< of the place in survey, in the worst direction

  /// Whether both walls are those of the tunnel: not in a junction or at the opening of a niche.
  [[nodiscard]] bool has_width() const;
  /// Whether area and perimeter are those of the tunnel.
  [[nodiscard]] bool has_area() const { return has_width() && measures.is_closed(); }
};

/// Planes at multiples of `every_m` along each line, also at its end. `path`: places of the body on
/// the ground, in survey.
std::vector<SectionPlane> section_planes(const std::vector<CentreLine>& lines,
                                         const std::vector<Eigen::Vector3d>& path, double every_m);

/// Measures a section in each plane from the returns beside it, those without a return left out.
/// Along each ray the nearest surface counts: a line is fitted to the distances of its returns by
/// their angle and their offset from the plane.
std::vector<CrossSection> cross_sections(const RegisteredCloud& cloud,
                                         const std::vector<SectionPlane>& planes,
                                         const SectionParams& params = {});

}  // namespace adit
