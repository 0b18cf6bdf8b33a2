// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/map_correction.hpp"

#include "common/messages/planar.hpp"

namespace adit {

map_correction_t to_message(const MapCorrection& correction) {
  map_correction_t message;
  message.utime = correction.utime;
  message.revision = correction.revision;
  message.session = correction.session;
  message.local_map = correction.local_map;
  set_pose(correction.T_map_odom, message.T_map_odom);
  message.has_covariance = static_cast<std::int8_t>(correction.covariance.has_value());
  set_matrix(correction.covariance.value_or(Eigen::Matrix3d::Zero()), message.covariance);
  return message;
}

Result<MapCorrection> from_message(const map_correction_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (message.revision < 0) return Refused{"negative revision"};
  if (message.local_map < 0 || message.session < 0) return Refused{"negative id or session"};
  if (!all_finite(message.T_map_odom)) return Refused{kPoseNotFinite};
  MapCorrection correction{message.utime,
                           message.revision,
                           message.session,
                           message.local_map,
                           pose_from(message.T_map_odom),
                           {}};
  if (message.has_covariance == 0) return correction;
  if (!is_information(message.covariance)) return Refused{"no covariance matrix"};
  correction.covariance = matrix_from(message.covariance);
  return correction;
}

}  // namespace adit
