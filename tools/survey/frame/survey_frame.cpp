// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/frame/survey_frame.hpp"

#include "common/geometry/local_crs.hpp"

namespace adit {

SurveyFrame SurveyFrame::local() {
  const std::string wkt = local_crs_wkt(kLocalGridName, "first pose of the first local map");
  return {Eigen::Vector3d::Zero(), 1.0, wkt, wkt,
          "Local grid, without control: metres from the start of the mission, x along the robot's "
          "heading there, elevations above the ground there. It is tied to no coordinate system, "
          "and its y axis is not north."};
}

}  // namespace adit
