// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "tools/survey/control/control_file.hpp"
#include "tools/survey/files/grid_system.hpp"
#include "tools/survey/frame/registered_cloud.hpp"
#include "tools/survey/frame/survey_graph.hpp"
#include "tools/survey/input/survey_input.hpp"

namespace adit {

/// A control point as the mission saw it.
struct ControlPoint {
  ControlRow row;
  std::size_t node = 0;                    ///< of the free network, to which it is attached
  Eigen::Vector3d p_local{0.0, 0.0, 0.0};  ///< in the frame of that local map
  Eigen::Vector3d p_map{0.0, 0.0, 0.0};
  double z_sd_m = 0.0;  ///< of its height above the local map: levelling of its 3D scan
};

/// Finds the places of control points in the free network of a mission. Throws std::runtime_error
/// for a scan that it does not have, and a time outside of it. `file`: named by errors.
std::vector<ControlPoint> find_control(const std::vector<ControlRow>& rows,
                                       const SurveyInput& input, const SurveyGraph& free_network,
                                       const std::string& file);

/// Throws std::runtime_error, one line that names the likely mistake, for coordinates that cannot
/// be those of the mission in this grid: degrees, feet, exchanged axes, the system of another
/// place, too few points.
void require_plausible(const std::vector<ControlPoint>& points, const GridSystem& grid,
                       const std::string& file);

/// The rigid motion from points in one frame of the plan to those in another with the least sum of
/// squares (Horn 1987, in the plan), and what remains.
struct PlanFit {
  Pose2 T_to_from;
  double rms_m = 0.0;
  double scale = 1.0;  ///< of lengths in `to` over those in `from`, which the motion leaves out
};
PlanFit fit_plan(const std::vector<Eigen::Vector2d>& from, const std::vector<Eigen::Vector2d>& to);

}  // namespace adit
