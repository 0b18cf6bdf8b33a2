// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/association_t.hpp"
#include "adit/cloud_match_t.hpp"
#include "adit/cloud_request_t.hpp"
#include "adit/cloud_t.hpp"
#include "adit/local_map_t.hpp"
#include "adit/map_contradictions_t.hpp"
#include "adit/map_correction_t.hpp"
#include "adit/map_request_t.hpp"
#include "adit/match_doubt_t.hpp"
#include "adit/pose_graph_t.hpp"
#include "adit/pose_t.hpp"
#include "adit/scan_match_t.hpp"
#include "adit/terrain_ready_t.hpp"
#include "adit/terrain_t.hpp"
#include "adit/volume_t.hpp"

#include "common/messages/fields/fields.hpp"
#include "common/messages/fields/sensing_fields.hpp"

/// The fields of the messages of odometry and maps, see Fields.
namespace adit {

inline constexpr Quantity kBeamIndex{0.0, 32767.0, "negative index of a beam"};
inline constexpr Quantity kCloudCoordinate{-1e4, 1e4, "implausible point"};

template <>
struct Fields<pose_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("pos", m.pos[0], kPosition);
    field("pos", m.pos[1], kPosition);
    field("pos", m.pos[2], kHeight);
    field("vel", m.vel, kSpeed.or_nan());
    field("orientation", m.orientation, kComponent.because("orientation is not a unit quaternion"));
    field("rotation_rate", m.rotation_rate, kAngularVelocity.or_nan());
    field("accel", m.accel, kAny);  // not used
  }
};

template <>
struct Fields<scan_match_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("reference_utime", m.reference_utime, kTime);
    field("odom_epoch_utime", m.odom_epoch_utime, kTime);
    field("channel", m.channel, kName);
    field("status", m.status, code(scan_match_t::STATUS_REJECTED, "unknown status"));
    field.pose("T_odom_body", m.T_odom_body);
    field.pose("delta", m.delta);
    field("z_m", m.z_m, kHeight);
    field("has_attitude", m.has_attitude, kFlag);
    field("roll_rad", m.roll_rad, kAttitude);
    field("pitch_rad", m.pitch_rad, kAttitude);
    field("n_ground_beams", m.n_ground_beams, kCount);
    field("ground_beams", m.ground_beams, kBeamIndex);
    field("n_unconfirmed_beams", m.n_unconfirmed_beams, kCount);
    field("unconfirmed_beams", m.unconfirmed_beams, kBeamIndex);
    field("covariance", m.covariance, kCovariance);
    field("inlier_share", m.inlier_share, kShare);
    field("contradiction_share", m.contradiction_share, kShare);
    field("rms_residual_m", m.rms_residual_m, kResidual);
    field("n_degenerate", m.n_degenerate,
          Quantity{0.0, 3.0, "more than three degenerate directions"});
    field("degenerate_directions", m.degenerate_directions,
          kComponent.because("degenerate direction is not a unit vector"));
    field("degenerate_fills", m.degenerate_fills, code(scan_match_t::FILL_IMU, "unknown fill"));
    field("lever_arm_m", m.lever_arm_m, kLeverArm);
    field("wheels_scale_sd", m.wheels_scale_sd, kShare);
    field("iterations", m.iterations, kCount);
    field("searched", m.searched, kFlag);
    field("points", m.points, kCount);
  }
};

template <>
struct Fields<match_doubt_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("from_utime", m.from_utime, kTime);
    field("reason", m.reason, code(match_doubt_t::REASON_CONTRADICTED, "unknown reason"));
    field("n_alternatives", m.n_alternatives, kCount);
    field.pose("T_odom_alternative", m.T_odom_alternative);
    field("scores", m.scores, kScore);
  }
};

template <>
struct Fields<local_scan_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("channel", m.channel, kName);
    field.pose("T_local_body", m.T_local_body);
    field("z_m", m.z_m, kHeight);
    field("has_attitude", m.has_attitude, kFlag);
    field("roll_rad", m.roll_rad, kAttitude);
    field("pitch_rad", m.pitch_rad, kAttitude);
    field("angle_min_rad", m.angle_min_rad, kFirstBearing);
    field("angle_step_rad", m.angle_step_rad, kBearingStep);
    field("nranges", m.nranges, kCount);
    field("ranges", m.ranges, kAny);
    field("n_unconfirmed_beams", m.n_unconfirmed_beams, kCount);
    field("unconfirmed_beams", m.unconfirmed_beams, kBeamIndex);
  }
};

template <>
struct Fields<local_map_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("end_utime", m.end_utime, kTime);
    field("id", m.id, kId.because("negative id or session"));
    field("session", m.session, kId.because("negative id or session"));
    field.pose("T_odom_local", m.T_odom_local);
    field.pose("T_previous_local", m.T_previous_local);
    field("information", m.information, kInformation);
    field("climb_m", m.climb_m, kHeight);
    field("forward_m", m.forward_m, kSignedDistance);
    field("z_odom_m", m.z_odom_m, kHeight);
    field("n_fragments", m.n_fragments, kFragmentCount);
    field("fragment", m.fragment, kFragmentIndex);
    field("n_scans", m.n_scans, kCount);
    field.parts(m.scans);
  }
};

template <>
struct Fields<pose_constraint_t> {
  static void visit(auto& m, auto& field) {
    field("from", m.from, kId.because("constraint of a node outside the graph"));
    field("to", m.to, kId.because("constraint of a node outside the graph"));
    field("kind", m.kind, code(pose_constraint_t::KIND_LOOP_CLOSURE, "unknown constraint kind"));
    field.pose("T_from_to", m.T_from_to);
    field("information", m.information, kInformation);
  }
};

template <>
struct Fields<pose_graph_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("revision", m.revision, kRevision);
    field("n_nodes", m.n_nodes, kCount.because("negative number of nodes"));
    field("n_fragments", m.n_fragments, kFragmentCount);
    field("fragment", m.fragment, kFragmentIndex);
    field("first_node", m.first_node, kId.because("poses of nodes outside the graph"));
    field("n_poses", m.n_poses, kCount);
    field.pose("poses", m.poses);
    field("z_m", m.z_m, kHeight);
    field("z_variance", m.z_variance, kVariance);
    field("n_constraints", m.n_constraints, kCount);
    field.parts(m.constraints);
  }
};

template <>
struct Fields<map_correction_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("revision", m.revision, kRevision);
    field("session", m.session, kId.because("negative id or session"));
    field("local_map", m.local_map, kId.because("negative id or session"));
    field.pose("T_map_odom", m.T_map_odom);
    field("z_map_odom_m", m.z_map_odom_m, kHeight);
    field("z_variance", m.z_variance, kVariance);
    field("body_covariance", m.body_covariance, kVariances);
    field("has_covariance", m.has_covariance, kFlag);
    field("covariance", m.covariance, kPoseCovariance);
  }
};

template <>
struct Fields<map_contradictions_t> {
  static void visit(auto& m, auto& field) {
    constexpr const char* kPair = "pair is not an older and a newer map";
    field("utime", m.utime, kTime);
    field("revision", m.revision, kRevision);
    field("n_pairs", m.n_pairs, Quantity{0.0, 1000.0, "implausible number of pairs"});
    field("older_maps", m.older_maps, kId.because(kPair));
    field("newer_maps", m.newer_maps, kId.because(kPair));
    field("evidence", m.evidence, kLikelihood);
  }
};

template <>
struct Fields<loop_closure_alternative_t> {
  static void visit(auto& m, auto& field) {
    field("older_map", m.older_map, kId.because("alternative is not an older map"));
    field.pose("T_older_newer", m.T_older_newer);
    field("information", m.information, kInformation);
    field("log_likelihood", m.log_likelihood, kLikelihood);
  }
};

template <>
struct Fields<association_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("action", m.action, code(association_t::ACTION_REVISED, "unknown action"));
    field("loop_closure", m.loop_closure, kId);
    field("newer_map", m.newer_map, kId);
    field("n_alternatives", m.n_alternatives,
          Quantity{0.0, 500.0, "implausible number of alternatives"});
    field.parts(m.alternatives);
    field("chosen", m.chosen, kOptionalId.because("choice is not an alternative"));
    field("previously_chosen", m.previously_chosen,
          kOptionalId.because("choice is not an alternative"));
    field("log_likelihood", m.log_likelihood, kLikelihood);
    field("reason", m.reason, kSentence);
  }
};

template <>
struct Fields<cloud_match_t> {
  static void visit(auto& m, auto& field) {
    constexpr Quantity kDeviation{1e-6, 1e4, "invalid standard deviation"};
    constexpr Quantity kTilt{-0.5, 0.5, "implausible tilt"};
    constexpr Quantity kTiltVariance{1e-12, 1.0, "invalid covariance"};
    constexpr Quantity kTiltCovariance{-1.0, 1.0, "invalid covariance"};
    field("utime", m.utime, kTime);
    field("older_utime", m.older_utime, kTime);
    field("older_map", m.older_map, kId);
    field("newer_map", m.newer_map, kId);
    field("older_z_m", m.older_z_m, kHeight);
    field("newer_z_m", m.newer_z_m, kHeight);
    field("older_forward_m", m.older_forward_m, kSignedDistance);
    field("newer_forward_m", m.newer_forward_m, kSignedDistance);
    field.pose("T_older_newer", m.T_older_newer);
    field("turn_rad", m.turn_rad, kHeading);
    field("rise_m", m.rise_m, kHeight);
    field("rise_sd_m", m.rise_sd_m, kDeviation);
    field("lever_x_m", m.lever_x_m, kSignedDistance);
    field("lever_y_m", m.lever_y_m, kSignedDistance);
    field("roll_rad", m.roll_rad, kTilt);
    field("pitch_rad", m.pitch_rad, kTilt);
    field("roll_variance", m.roll_variance, kTiltVariance);
    field("pitch_variance", m.pitch_variance, kTiltVariance);
    field("roll_pitch_covariance", m.roll_pitch_covariance, kTiltCovariance);
  }
};

template <>
struct Fields<map_request_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("requested_by", m.requested_by, required(kName, "no stage"));
  }
};

template <>
struct Fields<cloud_line_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("origin", m.origin, kCloudCoordinate.because("implausible origin"));
    field("n_points", m.n_points, kCount);
    field("points", m.points, kCloudCoordinate);
    field("n_misses", m.n_misses, kCount);
    field("misses", m.misses, kComponent.because("miss direction is not a unit vector"));
  }
};

template <>
struct Fields<cloud_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("id", m.id, kId);
    field.pose("T_odom_level", m.T_odom_level);
    field("z_odom_m", m.z_odom_m, kHeight);
    field("complete", m.complete, kFlag);
    field("n_fragments", m.n_fragments, kFragmentCount);
    field("fragment", m.fragment, kFragmentIndex);
    field("n_lines", m.n_lines, kCount);
    field.parts(m.lines);
  }
};

template <>
struct Fields<cloud_request_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("after_utime", m.after_utime, kTime);
    field("n_received", m.n_received, Quantity{0.0, 1000.0, "implausible number of scans"});
    field("received_utime", m.received_utime, kTime);
  }
};

template <>
struct Fields<terrain_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("id", m.id, kId);
    field.pose("T_odom_level", m.T_odom_level);
    field("p_level_corner", m.p_level_corner, kPosition.because("implausible corner"));
    field("cell_m", m.cell_m, kCell);
    field("columns", m.columns, kCount.because("negative number of cells"));
    field("rows", m.rows, kCount.because("negative number of cells"));
    field("n_fragments", m.n_fragments, kFragmentCount);
    field("fragment", m.fragment, kFragmentIndex);
    field("first_cell", m.first_cell, kId.because("cells outside the map"));
    field("n_cells", m.n_cells, kCount);
    field("ground", m.ground, code(terrain_t::GROUND_NO_RETURN, "unknown ground"));
    field("count", m.count, kCount.because("negative count of points"));
    // Each value of the 16 bits is within ±32.8 m or ±3.28 rad, or stands for "unknown".
    field("low_mm", m.low_mm, kAny);
    field("high_mm", m.high_mm, kAny);
    field("coefficient_mm", m.coefficient_mm, kAny);
    field("clearance_mm", m.clearance_mm, kAny);
    field("slope_tenth_mrad", m.slope_tenth_mrad, kAny);
    field("step_mm", m.step_mm, kAny);
    field("repulsion_mm", m.repulsion_mm, kAny);
    field("obstacle_parts", m.obstacle_parts, kAny);
  }
};

template <>
struct Fields<terrain_ready_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("id", m.id, kId);
    field("complete", m.complete, kFlag);
  }
};

template <>
struct Fields<volume_t> {
  static void visit(auto& m, auto& field) {
    constexpr const char* kCells = "negative number of cells";
    field("utime", m.utime, kTime);
    field("id", m.id, kId);
    field("revision", m.revision, Quantity{1.0, kInt32Max, "revision without a cloud"});
    field("graph_revision", m.graph_revision, kRevision);
    field("local_map", m.local_map, kId);
    field.pose("T_map_volume", m.T_map_volume);
    field("z_map_m", m.z_map_m, kHeight);
    field("cell_m", m.cell_m, kCell);
    field("occupied", m.occupied, kCount.because(kCells));
    field("free", m.free, kCount.because(kCells));
    field("n_fragments", m.n_fragments, kFragmentCount);
    field("fragment", m.fragment, kFragmentIndex);
    field("n_bytes", m.n_bytes, kCount);
    field("octree", m.octree, kAny);
  }
};

}  // namespace adit
