// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mapping/cloud_match.hpp"

#include "common/messages/fields/mapping_fields.hpp"
#include "common/messages/planar_geometry.hpp"

namespace adit {

cloud_match_t to_message(const CloudMatch& match) {
  cloud_match_t message;
  message.older_utime = match.older.utime;
  message.utime = match.newer.utime;
  message.older_map = match.older.map;
  message.newer_map = match.newer.map;
  message.older_z_m = match.older.z_m;
  message.newer_z_m = match.newer.z_m;
  message.older_forward_m = match.older.forward_m;
  message.newer_forward_m = match.newer.forward_m;
  set_pose(match.T_older_newer, message.T_older_newer);
  message.turn_rad = match.turn_rad;
  message.rise_m = match.rise_m;
  message.rise_sd_m = match.rise_sd_m;
  message.lever_x_m = match.lever_m.x();
  message.lever_y_m = match.lever_m.y();
  message.roll_rad = match.tilt_rad.x();
  message.pitch_rad = match.tilt_rad.y();
  message.roll_variance = match.tilt_covariance(0, 0);
  message.pitch_variance = match.tilt_covariance(1, 1);
  message.roll_pitch_covariance = match.tilt_covariance(0, 1);
  return message;
}

Result<CloudMatch> from_message(const cloud_match_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  if (message.older_map >= message.newer_map) return Rejected{"not an older and a newer map"};
  CloudMatch match;
  match.tilt_covariance << message.roll_variance, message.roll_pitch_covariance,
      message.roll_pitch_covariance, message.pitch_variance;
  if (!(match.tilt_covariance.determinant() > 0.0)) return Rejected{"invalid covariance"};
  match.older = {message.older_utime, message.older_map, message.older_z_m,
                 message.older_forward_m};
  match.newer = {message.utime, message.newer_map, message.newer_z_m, message.newer_forward_m};
  match.T_older_newer = pose_from(message.T_older_newer);
  match.turn_rad = message.turn_rad;
  match.rise_m = message.rise_m;
  match.rise_sd_m = message.rise_sd_m;
  match.lever_m = {message.lever_x_m, message.lever_y_m};
  match.tilt_rad = {message.roll_rad, message.pitch_rad};
  return match;
}

}  // namespace adit
