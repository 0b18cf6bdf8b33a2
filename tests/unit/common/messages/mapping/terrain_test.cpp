// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mapping/terrain.hpp"

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "common/messages/fields/quantities.hpp"
#include "common/messages/planar_geometry.hpp"
#include "tests/unit/common/messages/map_values.hpp"

namespace adit {
namespace {

using test::kNaN;
using test::kUtime;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// A map of undulating ground with cells of all kinds.
TerrainMap terrain(int columns, int rows, std::int32_t id = 7) {
  TerrainMap map{kUtime, id, {12.0, -3.0, 0.7}, {-4.0, -10.0}, 0.1, {columns, rows}};
  for (int i = 0; i < columns * rows; ++i) {
    const auto height = static_cast<float>(std::sin(0.01 * i));
    TerrainCell cell{static_cast<Ground>(i % 5),
                     static_cast<std::uint16_t>(i % 300),
                     height,
                     height + 0.2F,
                     0.2F,
                     1.8F,
                     0.1F,
                     0.03F,
                     0.07F,
                     static_cast<std::uint16_t>(37 * i)};
    if (cell.ground == Ground::kOccluded) cell = {Ground::kOccluded, 0, kUnknown, kUnknown};
    if (i % 7 == 0) cell.clearance_m = kInfinite;
    map.cells[static_cast<std::size_t>(i)] = cell;
  }
  return map;
}

void expect_near(float a, float b, float tolerance) {
  EXPECT_EQ(std::isnan(a), std::isnan(b));
  EXPECT_EQ(std::isinf(a), std::isinf(b));
  if (std::isfinite(a) && std::isfinite(b)) {
    EXPECT_NEAR(a, b, tolerance);
  }
}

void expect_near(const TerrainCell& a, const TerrainCell& b) {
  constexpr float kM = 0.00051F;     // half a millimetre plus float rounding
  constexpr float kRad = 0.000051F;  // half of 0.1 mrad
  EXPECT_EQ(a.ground, b.ground);
  EXPECT_EQ(a.count, b.count);
  expect_near(a.low_m, b.low_m, kM);
  expect_near(a.high_m, b.high_m, kM);
  expect_near(a.coefficient_m, b.coefficient_m, kM);
  expect_near(a.clearance_m, b.clearance_m, kM);
  expect_near(a.slope_rad, b.slope_rad, kRad);
  expect_near(a.step_m, b.step_m, kM);
  expect_near(a.repulsion_m, b.repulsion_m, kM);
  EXPECT_EQ(a.obstacle_parts, b.obstacle_parts);
}

TerrainCell round_tripped(const TerrainCell& cell) {
  const TerrainMap map{kUtime, 0, {}, {0.0, 0.0}, 0.1, {1, 1, cell}};
  return test::round_trip(split(map).front())->cells.front();
}

std::string_view rejection_after(const std::function<void(terrain_t&)>& change) {
  terrain_t message = to_message(split(terrain(4, 3)).front());
  change(message);
  return from_message(message).rejection();
}

TEST(TerrainFragments, AreReassembledInAnyOrder) {
  const TerrainMap sent = terrain(200, 200);
  auto fragments = split(sent);
  EXPECT_EQ(fragments.size(), 13U);  // 40,000 cells of 19 bytes
  std::rotate(fragments.begin(), fragments.begin() + 3, fragments.end());
  TerrainReassembler reassembler;
  std::optional<TerrainMap> received;
  for (const TerrainFragment& fragment : fragments) {
    const auto bytes = encode(to_message(fragment));
    EXPECT_LE(bytes.size(), kFragmentBytes);
    EXPECT_FALSE(received);
    received = reassembler.add(*from_message(*decode<terrain_t>(bytes)));
  }
  ASSERT_TRUE(received);
  EXPECT_EQ(received->T_odom_level, sent.T_odom_level);
  EXPECT_EQ(received->p_level_corner, sent.p_level_corner);
  ASSERT_EQ(received->cells.size(), sent.cells.size());
  for (std::size_t i = 0; i < sent.cells.size(); ++i) {
    expect_near(received->cells[i], sent.cells[i]);
  }
}

TEST(TerrainFragments, AreOneForAMapWithoutCells) {
  const auto fragments = split(terrain(0, 0));
  ASSERT_EQ(fragments.size(), 1U);
  EXPECT_TRUE(TerrainReassembler().add(*test::round_trip(fragments[0]))->cells.box().empty());
}

TEST(TerrainFragments, ClampValuesOutOfRange) {
  const TerrainCell cell = round_tripped(
      {Ground::kObserved, 60'000, -50.0F, 50.0F, kInfinite, 100.0F, 9.0F, 0.0F, 0.0F});
  EXPECT_EQ(cell.count, 32'767);
  EXPECT_FLOAT_EQ(cell.low_m, -32.766F);
  EXPECT_FLOAT_EQ(cell.high_m, 32.766F);
  EXPECT_FLOAT_EQ(cell.coefficient_m, 32.766F);
  EXPECT_FLOAT_EQ(cell.clearance_m, 32.766F);
  EXPECT_FLOAT_EQ(cell.slope_rad, 3.2766F);
}

TEST(TerrainMessage, IsRejectedWithAnInvalidHeader) {
  using Message = terrain_t;
  EXPECT_EQ(rejection_after([](Message& m) { m.utime = -1; }), kImplausibleTime);
  EXPECT_EQ(rejection_after([](Message& m) { m.id = -1; }), "negative id");
  EXPECT_EQ(rejection_after([](Message& m) { m.T_odom_level[0] = kNaN; }), kImplausiblePosition);
  for (const double x : {kNaN, 1e6}) {
    EXPECT_EQ(rejection_after([x](Message& m) { m.p_level_corner[1] = x; }), "implausible corner");
  }
  for (const double cell : {kNaN, 0.0, -0.1}) {
    EXPECT_EQ(rejection_after([cell](Message& m) { m.cell_m = cell; }), "implausible cell size");
  }
  EXPECT_EQ(rejection_after([](Message& m) { m.columns = -1; }), "negative number of cells");
  EXPECT_EQ(rejection_after([](Message& m) { m.rows = m.columns = INT32_MAX; }),
            "implausible number of cells");
}

TEST(TerrainMessage, IsRejectedWithAnInvalidIndexOrCells) {
  using Message = terrain_t;
  EXPECT_EQ(rejection_after([](Message& m) { m.n_fragments = 0; }), "no fragments");
  EXPECT_EQ(rejection_after([](Message& m) { m.n_fragments = INT32_MAX; }),
            "implausible number of fragments");
  EXPECT_EQ(rejection_after([](Message& m) { m.fragment = 1; }), "fragment index out of range");
  for (const std::int32_t first : {-1, 1, INT32_MAX}) {
    EXPECT_EQ(rejection_after([first](Message& m) { m.first_cell = first; }),
              "cells outside the map");
  }
  for (const std::int8_t ground : {-1, 5}) {
    EXPECT_EQ(rejection_after([ground](Message& m) { m.ground[2] = ground; }), "unknown ground");
  }
  EXPECT_EQ(rejection_after([](Message& m) { m.count[2] = -1; }), "negative count of points");
}

TEST(TerrainReassembler, RejectsAMapWithMissingOrSurplusCells) {
  for (const std::size_t cells : {11U, 13U}) {
    auto fragments = split(terrain(4, 3));
    fragments[0].cells.resize(cells);
    TerrainReassembler reassembler;
    EXPECT_FALSE(reassembler.add(fragments[0]));
    EXPECT_EQ(reassembler.counts().abandoned, 1);
  }
}

TEST(TerrainReassembler, RejectsAFragmentOfAnotherMap) {
  auto fragments = split(terrain(200, 200));
  TerrainReassembler reassembler;
  reassembler.add(fragments[0]);
  fragments[1].header.cell_m = 0.2;
  EXPECT_FALSE(reassembler.add(fragments[1]));
  EXPECT_EQ(reassembler.counts().contradictory, 1);
}

}  // namespace
}  // namespace adit
