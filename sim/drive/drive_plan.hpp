// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/geometry/pose2.hpp"
#include "sim/drive/way.hpp"
#include "sim/drive/waypoint_file.hpp"

namespace adit {

/// Legs that are driven in one direction, to a stand at the end.
struct DriveLegs {
  LeggedWay way;
  std::vector<double> speeds_m_s;  ///< of the legs
  bool reverse = false;
};

/// How waypoints are to be driven through.
struct DrivePlanParams {
  double speed_m_s = 0.0;      ///< where a waypoint says nothing else
  double speed_max_m_s = 0.0;  ///< whatever it says
  bool reverse = false;        ///< back up to waypoints within 45° of straight back
};

/// The way from where the body is through all waypoints in order, cut where the direction of
/// driving changes. Waypoints less than a millimetre from the one before are left out.
std::vector<DriveLegs> plan_drive(const std::vector<Waypoint>& waypoints, const Pose2& T_world_body,
                                  const DrivePlanParams& params);

}  // namespace adit
