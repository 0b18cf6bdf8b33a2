// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Golden bytes of mapping, planning and exploration messages.
#include "tests/unit/common/messages/golden.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <gtest/gtest.h>

#include "common/messages/exploration.hpp"
#include "common/messages/mapping/association.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/cloud_match.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "common/messages/mapping/volume.hpp"
#include "common/messages/navigation.hpp"

namespace adit {
namespace {

using test::expect_golden;

constexpr std::int64_t kUtime = 0x0005'7d2a'1b2c'3d4e;  // in 2018; all bytes differ

template <std::size_t kSize>
void fill(double (&field)[kSize], const std::array<double, kSize>& numbers) {
  std::ranges::copy(numbers, field);
}

/// Symmetric and positive definite, with distinct entries.
void fill_matrix(double (&rows)[3][3]) {
  fill(rows[0], {400.0, 20.0, 5.0});
  fill(rows[1], {20.0, 300.0, -7.0});
  fill(rows[2], {5.0, -7.0, 10'000.0});
}

Eigen::Matrix3d matrix() {
  Eigen::Matrix3d rows;
  rows << 400.0, 20.0, 5.0, 20.0, 300.0, -7.0, 5.0, -7.0, 10'000.0;
  return rows;
}

TEST(Golden, ScanMatch) {
  scan_match_t message;
  message.utime = kUtime;
  message.reference_utime = kUtime - 1;
  message.odom_epoch_utime = kUtime - 2;
  message.channel = "LASER_FRONT";
  message.status = scan_match_t::STATUS_LOST;
  fill(message.T_odom_body, {1.5, 2.5, 0.5});
  fill(message.delta, {0.25, 0.125, 0.0625});
  fill(message.covariance[0], {10.0, 2.0, 3.0});
  fill(message.covariance[1], {2.0, 11.0, 5.0});
  fill(message.covariance[2], {3.0, 5.0, 12.0});
  message.z_m = -3.5;
  message.has_attitude = 1;
  message.roll_rad = 0.03125;
  message.pitch_rad = -0.1875;
  message.n_ground_beams = 2;
  message.ground_beams = {90, 259};
  message.n_unconfirmed_beams = 3;
  message.unconfirmed_beams = {1, 2, 360};
  message.inlier_share = 0.875;
  message.contradiction_share = 0.375;
  message.rms_residual_m = 0.015625;
  message.n_degenerate = 2;
  message.degenerate_directions = {{0.6, 0.0, 0.8}, {0.0, 0.8, 0.6}};
  message.degenerate_fills = {scan_match_t::FILL_ODOMETRY, scan_match_t::FILL_IMU};
  message.lever_arm_m = 1.25;
  message.wheels_scale_sd = 0.03125;
  message.iterations = 12;
  message.searched = 1;
  message.points = 180;
  ScanMatch match;
  match.utime = kUtime;
  match.reference_utime = kUtime - 1;
  match.odom_epoch_utime = kUtime - 2;
  match.channel = "LASER_FRONT";
  match.status = ScanMatch::Status::kLost;
  match.T_odom_body = {1.5, 2.5, 0.5};
  match.T_reference_body = {0.25, 0.125, 0.0625};
  match.covariance << 10.0, 2.0, 3.0, 2.0, 11.0, 5.0, 3.0, 5.0, 12.0;
  match.z_m = -3.5;
  match.attitude = Attitude{0.03125, -0.1875};
  match.ground_beams = {90, 259};
  match.unconfirmed_beams = {1, 2, 360};
  match.inlier_share = 0.875;
  match.contradiction_share = 0.375;
  match.rms_residual_m = 0.015625;
  match.degenerate = {{{0.6, 0.0, 0.8}, DegenerateDirection::Fill::kOdometry},
                      {{0.0, 0.8, 0.6}, DegenerateDirection::Fill::kImu}};
  match.lever_arm_m = 1.25;
  match.wheels_scale_sd = 0.03125;
  match.iterations = 12;
  match.searched = true;
  match.points = 180;
  expect_golden(message, match);
}

TEST(Golden, LocalMap) {
  local_scan_t scan;
  scan.utime = kUtime + 1;
  scan.channel = "LASER_REAR";
  fill(scan.T_local_body, {0.5, 0.25, 0.125});
  scan.z_m = 0.375;
  scan.has_attitude = 1;
  scan.roll_rad = -0.0625;
  scan.pitch_rad = 0.21875;
  scan.angle_min_rad = -1.5;
  scan.angle_step_rad = 0.75;
  scan.nranges = 2;
  scan.ranges = {3.5F, 4.5F};
  scan.n_unconfirmed_beams = 1;
  scan.unconfirmed_beams = {1};
  local_map_t message;
  message.utime = kUtime;
  message.end_utime = kUtime + 2;
  message.id = 7;
  message.session = 2;
  fill(message.T_odom_local, {12.5, -3.5, 0.75});
  fill(message.T_previous_local, {5.5, 0.625, 0.0625});
  fill_matrix(message.information);
  message.climb_m = 0.9375;
  message.forward_m = 4.75;
  message.z_odom_m = -1.375;
  message.n_fragments = 4;
  message.fragment = 3;
  message.n_scans = 1;
  message.scans = {scan};
  LocalMapFragment fragment;
  fragment.part.utime = kUtime;
  fragment.part.end_utime = kUtime + 2;
  fragment.part.id = 7;
  fragment.part.session = 2;
  fragment.part.T_odom_local = {12.5, -3.5, 0.75};
  fragment.part.T_previous_local = {5.5, 0.625, 0.0625};
  fragment.part.information = matrix();
  fragment.part.climb_m = 0.9375;
  fragment.part.forward_m = 4.75;
  fragment.part.z_odom_m = -1.375;
  LocalScan& local = fragment.part.scans.emplace_back();
  local.channel = "LASER_REAR";
  local.scan = {kUtime + 1, {3.5F, 4.5F}, -1.5, 0.75};
  local.T_local_body = {0.5, 0.25, 0.125};
  local.z_m = 0.375;
  local.attitude = Attitude{-0.0625, 0.21875};
  local.unconfirmed_beams = {1};
  fragment.n_fragments = 4;
  fragment.fragment = 3;
  expect_golden(message, fragment);
}

TEST(Golden, PoseGraph) {
  pose_constraint_t constraint;
  constraint.from = 3;
  constraint.to = 1;
  constraint.kind = pose_constraint_t::KIND_LOOP_CLOSURE;
  fill(constraint.T_from_to, {0.5, 0.25, 0.125});
  fill_matrix(constraint.information);
  pose_graph_t message;
  message.utime = kUtime;
  message.revision = 12;
  message.n_nodes = 9;
  message.n_fragments = 5;
  message.fragment = 4;
  message.first_node = 6;
  message.n_poses = 2;
  message.poses = {{1.5, 2.5, 0.5}, {3.5, 4.5, 0.25}};
  message.z_m = {-0.5, 0.75};
  message.z_variance = {0.0625, 0.03125};
  message.n_constraints = 1;
  message.constraints = {constraint};
  const PoseGraphFragment fragment{
      kUtime,
      12,
      9,
      5,
      4,
      6,
      {{1.5, 2.5, 0.5}, {3.5, 4.5, 0.25}},
      {-0.5, 0.75},
      {0.0625, 0.03125},
      {{{3, 1, {0.5, 0.25, 0.125}, matrix()}, MapConstraint::Kind::kLoopClosure}}};
  expect_golden(message, fragment);
}

TEST(Golden, MapCorrection) {
  map_correction_t message;
  message.utime = kUtime;
  message.revision = 12;
  message.session = 1;
  message.local_map = 40;
  fill(message.T_map_odom, {0.5, -0.25, 0.125});
  message.z_map_odom_m = -2.5;
  message.z_variance = 0.046875;
  fill_matrix(message.body_covariance);
  message.has_covariance = 1;
  fill_matrix(message.covariance);
  expect_golden(
      message,
      MapCorrection{kUtime, 12, 1, 40, {0.5, -0.25, 0.125}, matrix(), -2.5, 0.046875, matrix()});
}

TEST(Golden, MapRequest) {
  map_request_t message;
  message.utime = kUtime;
  message.requested_by = "exploration";
  expect_golden(message, MapRequest{kUtime, "exploration"});
}

TEST(Golden, Association) {
  loop_closure_alternative_t first;
  first.older_map = 7;
  fill(first.T_older_newer, {0.5, 0.25, 0.125});
  fill_matrix(first.information);
  first.log_likelihood = 31.5;
  loop_closure_alternative_t second = first;
  second.older_map = 9;
  fill(second.T_older_newer, {1.5, 1.25, 1.125});
  second.log_likelihood = 12.5;
  association_t message;
  message.utime = kUtime;
  message.action = association_t::ACTION_REVISED;
  message.loop_closure = 3;
  message.newer_map = 40;
  message.n_alternatives = 2;
  message.alternatives = {first, second};
  message.chosen = association_t::NONE;
  message.previously_chosen = 1;
  message.log_likelihood = -120.5;
  message.reason = "the corner disagrees";
  Association association;
  association.utime = kUtime;
  association.action = Association::Action::kRevised;
  association.loop_closure = {
      3, 40, {{7, {0.5, 0.25, 0.125}, matrix(), 31.5}, {9, {1.5, 1.25, 1.125}, matrix(), 12.5}}};
  association.chosen = Association::kNone;
  association.previously_chosen = 1;
  association.log_likelihood = -120.5;
  association.reason = "the corner disagrees";
  expect_golden(message, association);
}

TEST(Golden, MapContradictions) {
  map_contradictions_t message;
  message.utime = kUtime;
  message.revision = 12;
  message.n_pairs = 2;
  message.older_maps = {3, 4};
  message.newer_maps = {40, 41};
  message.evidence = {55.5, 31.25};
  expect_golden(message, MapContradictions{kUtime, 12, {{3, 40, 55.5}, {4, 41, 31.25}}});
}

TEST(Golden, CloudMatch) {
  cloud_match_t message;
  message.utime = kUtime;
  message.older_utime = kUtime - 5;
  message.older_map = 3;
  message.newer_map = 40;
  message.older_z_m = 0.5;
  message.newer_z_m = 0.25;
  message.older_forward_m = 2.5;
  message.newer_forward_m = 1.25;
  std::ranges::copy(std::array{0.5, 0.25, 0.125}, message.T_older_newer);
  message.turn_rad = 0.75;
  message.rise_m = 1.5;
  message.rise_sd_m = 0.0625;
  message.lever_x_m = 7.5;
  message.lever_y_m = -0.5;
  message.roll_rad = 0.125;
  message.pitch_rad = -0.25;
  message.roll_variance = 0.5;
  message.pitch_variance = 0.25;
  message.roll_pitch_covariance = 0.125;
  CloudMatch match{{kUtime - 5, 3, 0.5, 2.5}, {kUtime, 40, 0.25, 1.25}, {0.5, 0.25, 0.125}};
  match.turn_rad = 0.75;
  match.rise_m = 1.5;
  match.rise_sd_m = 0.0625;
  match.lever_m = {7.5, -0.5};
  match.tilt_rad = {0.125, -0.25};
  match.tilt_covariance << 0.5, 0.125, 0.125, 0.25;
  expect_golden(message, match);
  message.older_map = 40;
  EXPECT_FALSE(from_message(message));
  message.older_map = 3;
  message.roll_pitch_covariance = 0.5;
  EXPECT_FALSE(from_message(message));
}

TEST(Golden, Cloud) {
  cloud_line_t line;
  line.utime = kUtime - 5;
  std::ranges::copy(std::array{1.5F, 0.25F, 0.625F}, line.origin);
  line.n_points = 2;
  line.points = {{3.5F, 1.25F, 0.5F}, {4.5F, 2.25F, 0.75F}};
  line.n_misses = 1;
  line.misses = {{0.0F, 0.6F, 0.8F}};
  cloud_t message;
  message.utime = kUtime;
  message.id = 3;
  fill(message.T_odom_level, {12.5, -3.5, 0.75});
  message.z_odom_m = -1.375;
  message.complete = 0;
  message.n_fragments = 6;
  message.fragment = 5;
  message.n_lines = 1;
  message.lines = {line};
  const CloudLine expected{kUtime - 5,
                           {1.5F, 0.25F, 0.625F},
                           {{3.5F, 1.25F, 0.5F}, {4.5F, 2.25F, 0.75F}},
                           {{0.0F, 0.6F, 0.8F}}};
  expect_golden(message,
                CloudFragment{{kUtime, 3, {12.5, -3.5, 0.75}, false, {expected}, -1.375}, 6, 5});
}

TEST(Golden, CloudRequest) {
  cloud_request_t message;
  message.utime = kUtime;
  message.after_utime = kUtime - 9;
  message.n_received = 2;
  message.received_utime = {kUtime - 2, kUtime - 1};
  expect_golden(message, CloudRequest{kUtime, kUtime - 9, {kUtime - 2, kUtime - 1}});
}

TEST(Golden, Terrain) {
  terrain_t message;
  message.utime = kUtime;
  message.id = 3;
  fill(message.T_odom_level, {12.5, -3.5, 0.75});
  fill(message.p_level_corner, {-4.5, -10.5});
  message.cell_m = 0.125;
  message.columns = 30;
  message.rows = 20;
  message.n_fragments = 8;
  message.fragment = 7;
  message.first_cell = 500;
  message.n_cells = 2;
  message.ground = {terrain_t::GROUND_OBSERVED, terrain_t::GROUND_NO_RETURN};
  message.count = {12, 0};
  message.low_mm = {11, terrain_t::UNKNOWN};
  message.high_mm = {112, -13};
  message.coefficient_mm = {101, 14};
  message.clearance_mm = {1715, terrain_t::INFINITE};
  message.slope_tenth_mrad = {216, 17};
  message.step_mm = {57, 18};
  message.repulsion_mm = {38, 19};
  message.obstacle_parts = {-32767, 0};  // the first and the last of 16 bits
  const float unknown = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  TerrainFragment fragment;
  fragment.header = {kUtime, 3, {12.5, -3.5, 0.75}, {-4.5, -10.5}, 0.125, 30, 20};
  fragment.cells = {
      {Ground::kObserved, 12, 0.011F, 0.112F, 0.101F, 1.715F, 0.0216F, 0.057F, 0.038F, 0x8001},
      {Ground::kNoReturn, 0, unknown, -0.013F, 0.014F, infinite, 0.0017F, 0.018F, 0.019F}};
  fragment.n_fragments = 8;
  fragment.fragment = 7;
  fragment.first_cell = 500;
  expect_golden(message, fragment);
}

TEST(Golden, TerrainReady) {
  terrain_ready_t message;
  message.utime = kUtime;
  message.id = 4;
  message.complete = 1;
  expect_golden(message, TerrainReady{kUtime, 4, true});
}

TEST(Golden, Volume) {
  volume_t message;
  message.utime = kUtime;
  message.id = 4;
  message.revision = 2;
  message.graph_revision = 12;
  message.local_map = 7;
  fill(message.T_map_volume, {12.5, -3.5, 0.75});
  message.z_map_m = -2.25;
  message.cell_m = 0.125;
  message.occupied = 35;
  message.free = 36;
  message.n_fragments = 9;
  message.fragment = 8;
  message.n_bytes = 3;
  message.octree = {0x01, 0x80, 0x7f};
  expect_golden(
      message,
      VolumeFragment{
          {kUtime, 4, 2, 12, 7, {12.5, -3.5, 0.75}, 0.125, 35, 36, {0x01, 0x80, 0x7f}, -2.25},
          9,
          8});
}

TEST(Golden, PlanGoal) {
  plan_goal_t message;
  message.utime = kUtime;
  message.id = 4;
  message.kind = plan_goal_t::KIND_REJOIN;
  fill(message.T_odom_goal, {20.5, -3.5, 0.125});
  message.distance_max_m = 12.5;
  message.n_route = 2;
  message.route_odom = {{1.5, 2.5}, {3.5, 4.5}};
  message.n_traversed_path = 2;
  message.traversed_path_odom = {{5.5, 6.5, 0.25}, {7.5, 8.5, 0.375}};
  const PlanGoal goal{kUtime,
                      4,
                      PlanGoal::Kind::kRejoin,
                      {20.5, -3.5, 0.125},
                      12.5,
                      {{1.5, 2.5}, {3.5, 4.5}},
                      {{5.5, 6.5, 0.25}, {7.5, 8.5, 0.375}}};
  expect_golden(message, goal);
}

TEST(Golden, PlannedPath) {
  path_point_t point;
  fill(point.T_odom_body, {1.5, 2.5, 0.75});
  point.curvature_1_m = 0.25;
  point.reverse = 1;
  point.clearance_m = 0.375;
  point.cost = 9.5;
  blocking_cell_t cell;
  fill(cell.p_odom, {14.5, 1.25});
  cell.reason = blocking_cell_t::REASON_WATER;
  cell.height_m = 0.625;
  planned_path_t message;
  message.utime = kUtime;
  message.id = 4;
  message.outcome = planned_path_t::OUTCOME_FOUND;
  message.reason = "free space";
  message.reached_m = 9.625;
  message.n_points = 1;
  message.points = {point};
  message.n_blocking_found = 1;
  message.n_blocking = 1;
  message.blocking = {cell};
  const PlannedPath path{kUtime,
                         4,
                         PlanOutcome::kFound,
                         "free space",
                         {{{1.5, 2.5, 0.75}, 0.25, true, 0.375, 9.5}},
                         9.625,
                         {{{14.5, 1.25}, BlockingCell::Reason::kWater, 0.625}}};
  expect_golden(message, path);
}

frontier_t frontier_message(int id, std::int8_t state) {
  frontier_t message;
  message.id = id;
  message.local_map = 30 + id;
  fill(message.p_map, {5.5 + id, 1.5 + id});
  fill(message.direction_map, {0.6, 0.8});
  message.width_m = 2.75 + id;
  message.state = state;
  message.utime = kUtime - id;
  message.evidence = "a beam";
  return message;
}

Frontier frontier(int id, FrontierState state) {
  return {id, 30 + id, {5.5 + id, 1.5 + id}, {0.6, 0.8}, 2.75 + id, state, kUtime - id, "a beam"};
}

TEST(Golden, Exploration) {
  corridor_node_t start;
  fill(start.p_map, {0.5, 0.25});
  start.kind = corridor_node_t::KIND_DEAD_END;
  corridor_node_t end;
  fill(end.p_map, {20.5, -3.5});
  end.kind = corridor_node_t::KIND_OPEN_END;
  corridor_t corridor;
  corridor.from = 0;
  corridor.to = 1;
  corridor.length_m = 20.25;
  corridor.width_m = 2.875;
  corridor.n_points = 2;
  corridor.points_map = {{0.5F, 0.25F}, {20.5F, -3.5F}};
  exploration_t message;
  message.utime = kUtime;
  message.revision = 12;
  message.request = 6;
  message.kind = exploration_t::KIND_ALONG;
  fill(message.T_map_goal, {20.5, -3.5, 0.125});
  fill(message.T_odom_goal, {20.75, -2.5, 0.25});
  message.n_route = 2;
  message.route_odom = {{12.5F, -3.5F}, {16.5F, -2.5F}};
  message.distance_m = 12.75;
  message.frontier = 2;
  message.complete = 0;
  message.reason = "straight on";
  message.remaining_m = 800.5;
  message.explored_m = 310.5;
  message.n_frontiers_found = 2;
  message.n_frontiers = 2;
  message.frontiers = {frontier_message(2, frontier_t::STATE_OPEN),
                       frontier_message(1, frontier_t::STATE_BLOCKED)};  // closed ones last
  message.n_nodes = 2;
  message.nodes = {start, end};
  message.n_corridors_found = 1;
  message.n_corridors = 1;
  message.corridors = {corridor};
  ExplorationReport report;
  report.utime = kUtime;
  report.revision = 12;
  report.request = 6;
  report.decision = {
      ExplorationDecision::Kind::kAlong, {20.5, -3.5, 0.125}, 12.75, 2, false, "straight on"};
  report.T_odom_goal = {20.75, -2.5, 0.25};
  report.route_odom = {{12.5, -3.5}, {16.5, -2.5}};
  report.budget = {800.5, 310.5};
  report.frontiers = {frontier(1, FrontierState::kBlocked), frontier(2, FrontierState::kOpen)};
  report.corridors = {
      {{{0.5, 0.25}, CorridorNode::Kind::kDeadEnd}, {{20.5, -3.5}, CorridorNode::Kind::kOpenEnd}},
      {{0, 1, 20.25, 2.875, {{0.5, 0.25}, {20.5, -3.5}}}}};
  expect_golden(message, report);
}

}  // namespace
}  // namespace adit
