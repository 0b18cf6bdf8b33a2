// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mapping/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "common/messages/fields/mapping_fields.hpp"
#include "common/messages/fragments.hpp"
#include "common/messages/planar_geometry.hpp"

namespace adit {
namespace {

static_assert(static_cast<int>(Ground::kObserved) == terrain_t::GROUND_OBSERVED);
static_assert(static_cast<int>(Ground::kNeverObserved) == terrain_t::GROUND_NEVER_OBSERVED);
static_assert(static_cast<int>(Ground::kOccluded) == terrain_t::GROUND_OCCLUDED);
static_assert(static_cast<int>(Ground::kBelowRay) == terrain_t::GROUND_BELOW_RAY);
static_assert(static_cast<int>(Ground::kNoReturn) == terrain_t::GROUND_NO_RETURN);

constexpr int kLargest = 32766;
constexpr int kCountMax = 32767;
constexpr float kPerMetre = 1000.0F;
constexpr float kPerRadian = 10'000.0F;

std::int16_t rounded(float number, float per_unit) {
  if (std::isnan(number)) return terrain_t::UNKNOWN;
  const float limit = static_cast<float>(kLargest);
  return static_cast<std::int16_t>(std::lround(std::clamp(number * per_unit, -limit, limit)));
}

float number_from(std::int16_t rounded, float per_unit) {
  if (rounded == terrain_t::UNKNOWN) return std::numeric_limits<float>::quiet_NaN();
  return static_cast<float>(rounded) / per_unit;
}

std::int16_t rounded_clearance(float clearance_m) {
  if (std::isinf(clearance_m) && clearance_m > 0.0F) return terrain_t::INFINITE;
  return rounded(clearance_m, kPerMetre);
}

float clearance_from(std::int16_t rounded) {
  if (rounded == terrain_t::INFINITE) return std::numeric_limits<float>::infinity();
  return number_from(rounded, kPerMetre);
}

void append(const TerrainCell& cell, terrain_t& message) {
  message.ground.push_back(static_cast<std::int8_t>(cell.ground));
  message.count.push_back(static_cast<std::int16_t>(std::min<int>(cell.count, kCountMax)));
  message.low_mm.push_back(rounded(cell.low_m, kPerMetre));
  message.high_mm.push_back(rounded(cell.high_m, kPerMetre));
  message.coefficient_mm.push_back(rounded(cell.coefficient_m, kPerMetre));
  message.clearance_mm.push_back(rounded_clearance(cell.clearance_m));
  message.slope_tenth_mrad.push_back(rounded(cell.slope_rad, kPerRadian));
  message.step_mm.push_back(rounded(cell.step_m, kPerMetre));
  message.repulsion_mm.push_back(rounded(cell.repulsion_m, kPerMetre));
  message.obstacle_parts.push_back(static_cast<std::int16_t>(cell.obstacle_parts));
}

TerrainCell cell_from(const terrain_t& message, std::size_t i) {
  return {static_cast<Ground>(message.ground[i]),
          static_cast<std::uint16_t>(message.count[i]),
          number_from(message.low_mm[i], kPerMetre),
          number_from(message.high_mm[i], kPerMetre),
          number_from(message.coefficient_mm[i], kPerMetre),
          clearance_from(message.clearance_mm[i]),
          number_from(message.slope_tenth_mrad[i], kPerRadian),
          number_from(message.step_mm[i], kPerMetre),
          number_from(message.repulsion_mm[i], kPerMetre),
          static_cast<std::uint16_t>(message.obstacle_parts[i])};
}

std::string_view map_rejection_reason(const terrain_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return reason;
  if (std::int64_t{message.columns} * message.rows > TerrainFragment::kCellsMax) {
    return "implausible number of cells";
  }
  return {};
}

/// Requires a valid map header.
std::string_view run_rejection_reason(const terrain_t& message) {
  const auto reason = fragment_rejection_reason(message, TerrainFragment::kFragmentsMax);
  if (!reason.empty()) return reason;
  const int cells = message.columns * message.rows;
  if (message.first_cell > cells - message.n_cells) {
    return "cells outside the map";
  }
  return {};
}

}  // namespace

terrain_t to_message(const TerrainFragment& fragment) {
  const TerrainHeader& header = fragment.header;
  terrain_t message;
  message.utime = header.utime;
  message.id = header.id;
  set_pose(header.T_odom_level, message.T_odom_level);
  message.p_level_corner[0] = header.p_level_corner.x();
  message.p_level_corner[1] = header.p_level_corner.y();
  message.cell_m = header.cell_m;
  message.columns = header.columns;
  message.rows = header.rows;
  message.n_fragments = fragment.n_fragments;
  message.fragment = fragment.fragment;
  message.first_cell = fragment.first_cell;
  message.n_cells = static_cast<std::int32_t>(fragment.cells.size());
  for (const TerrainCell& cell : fragment.cells) append(cell, message);
  return message;
}

Result<TerrainFragment> from_message(const terrain_t& message) {
  if (const auto reason = map_rejection_reason(message); !reason.empty()) return Rejected{reason};
  if (const auto reason = run_rejection_reason(message); !reason.empty()) return Rejected{reason};
  TerrainFragment fragment;
  fragment.header = {message.utime,
                     message.id,
                     pose_from(message.T_odom_level),
                     Eigen::Vector2d(message.p_level_corner),
                     message.cell_m,
                     message.columns,
                     message.rows};
  fragment.n_fragments = message.n_fragments;
  fragment.fragment = message.fragment;
  fragment.first_cell = message.first_cell;
  fragment.cells.reserve(message.ground.size());
  for (std::size_t i = 0; i < message.ground.size(); ++i) {
    fragment.cells.push_back(cell_from(message, i));
  }
  return fragment;
}

namespace {

// Encoded sizes.
constexpr std::size_t kHeaderBytes = 128;
constexpr std::size_t kCellBytes = 1 + 9 * sizeof(std::int16_t);
constexpr std::size_t kCellsPerFragment = (kFragmentBytes - kHeaderBytes) / kCellBytes;

TerrainHeader header_of(const TerrainMap& map) {
  return {map.utime,           map.id,          map.T_odom_level, map.p_level_corner, map.cell_m,
          map.cells.columns(), map.cells.rows()};
}

/// Whether each run of cells begins where the one before ends, and all are `n_cells` long.
bool are_contiguous(const FragmentSet<TerrainFragment>& fragments, std::size_t n_cells) {
  std::size_t end = 0;
  for (const auto& fragment : fragments.fragments()) {
    if (static_cast<std::size_t>(fragment->first_cell) != end) return false;
    end += fragment->cells.size();
  }
  return end == n_cells;
}

}  // namespace

std::vector<TerrainFragment> split(const TerrainMap& map) {
  const std::size_t n = map.cells.size();
  const std::size_t n_fragments =
      std::max<std::size_t>(1, (n + kCellsPerFragment - 1) / kCellsPerFragment);
  std::vector<TerrainFragment> fragments;
  for (std::size_t i = 0; i < n_fragments; ++i) {
    const std::size_t first = i * kCellsPerFragment;
    const std::size_t end = std::min(n, first + kCellsPerFragment);
    TerrainFragment fragment{header_of(map),
                             static_cast<int>(n_fragments),
                             static_cast<int>(i),
                             static_cast<int>(first),
                             {}};
    fragment.cells.assign(map.cells.begin() + static_cast<std::ptrdiff_t>(first),
                          map.cells.begin() + static_cast<std::ptrdiff_t>(end));
    fragments.push_back(std::move(fragment));
  }
  return fragments;
}

std::size_t bytes_in_memory(const TerrainFragment& fragment) {
  return sizeof(TerrainCell) * fragment.cells.size();
}

std::optional<TerrainMap> reassemble(const FragmentSet<TerrainFragment>& fragments) {
  const TerrainHeader& header = fragments.fragments().front()->header;
  const CellBox box{{0, 0}, {header.columns, header.rows}};
  if (!are_contiguous(fragments, box.count())) return std::nullopt;
  TerrainMap map{header.utime,          header.id,     header.T_odom_level,
                 header.p_level_corner, header.cell_m, Grid2<TerrainCell>(box)};
  auto next = map.cells.begin();
  for (const auto& fragment : fragments.fragments()) {
    next = std::copy(fragment->cells.begin(), fragment->cells.end(), next);
  }
  return map;
}

terrain_ready_t to_message(const TerrainReady& ready) {
  terrain_ready_t message;
  message.utime = ready.utime;
  message.id = ready.id;
  message.complete = ready.complete ? 1 : 0;
  return message;
}

Result<TerrainReady> from_message(const terrain_ready_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  return TerrainReady{message.utime, message.id, message.complete != 0};
}

}  // namespace adit
