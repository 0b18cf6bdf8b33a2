// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/c_space.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "procs/planning/row_sums.hpp"

namespace adit {
namespace {

// Roughness and the number of unseen cells share one sum: the kernel of the wheels is run over
// once.
constexpr int kUnseenShift = 20;
constexpr std::uint32_t kRoughnessMask = (1U << kUnseenShift) - 1U;
constexpr int kMostCells =
    4095;  // of a kernel: 255 each fill 20 bits, and they can be counted in 12

constexpr std::uint32_t kWhole = 255;  // weight under the wheels, and roughness at the limit

using Layer = std::vector<std::uint8_t>;

/// The layers, summed along rows.
struct LayerSums {
  LayerSums(const GroundLayers& layers, int border, std::uint32_t unseen_roughness)
      : lethal_body(layers.columns, layers.rows, border, 0, Of{layers, layers.under_body}),
        lethal_wheels(layers.columns, layers.rows, border, 0, Of{layers, layers.under_wheels}),
        roughness(layers.columns, layers.rows, border, unseen_roughness,
                  Of{layers, layers.roughness}),
        ground(layers.columns, layers.rows, border, (1U << kUnseenShift) + unseen_roughness,
               [&](int column, int row) {
                 const std::size_t i = layers.index(column, row);
                 return (std::uint32_t{layers.unseen[i]} << kUnseenShift) + layers.roughness[i];
               }) {}

  struct Of {
    const GroundLayers& layers;
    const Layer& layer;
    std::uint8_t operator()(int column, int row) const { return layer[layers.index(column, row)]; }
  };

  RowSums<std::uint16_t> lethal_body;
  RowSums<std::uint16_t> lethal_wheels;
  RowSums<std::uint32_t> roughness;
  RowSums<std::uint32_t> ground;
};

/// What the kernels gather over one row of cells.
struct RowTotals {
  explicit RowTotals(int columns)
      : lethal(static_cast<std::size_t>(columns)),
        roughness(lethal.size()),
        ground(lethal.size()) {}

  void gather(const LayerSums& sums, const CSpaceKernels::Oriented& kernel, int row) {
    std::fill(lethal.begin(), lethal.end(), std::uint16_t{0});
    std::fill(roughness.begin(), roughness.end(), 0U);
    std::fill(ground.begin(), ground.end(), 0U);
    sums.lethal_body.add_row(kernel.lethal_body, row, lethal);
    sums.lethal_wheels.add_row(kernel.lethal_wheels, row, lethal);
    sums.roughness.add_row(kernel.body, row, roughness);
    sums.ground.add_row(kernel.wheels, row, ground);
  }

  std::vector<std::uint16_t> lethal;
  std::vector<std::uint32_t> roughness;
  std::vector<std::uint32_t> ground;
};

int greatest_reach(const std::vector<CSpaceKernels::Oriented>& kernels) {
  int reach = 0;
  for (const auto& k : kernels) {
    reach =
        std::max({reach, k.wheels.reach, k.body.reach, k.lethal_wheels.reach, k.lethal_body.reach});
  }
  return reach;
}

}  // namespace

CSpace::CSpace(int headings, int columns, int rows)
    : headings_(headings),
      columns_(columns),
      rows_(rows),
      costs_(static_cast<std::size_t>(headings / 2) * cells(), kLethal) {}

CSpaceKernels::CSpaceKernels(const Vehicle& vehicle, const CSpaceParams& params, double cell_m)
    : params_(params), headings_(params.headings), cell_m_(cell_m) {
  const auto wheels = wheel_tracks(vehicle);
  const std::vector<BodyRectangle> body{body_outline(vehicle)};
  for (int k = 0; k < headings_.count() / 2; ++k) {
    oriented_.push_back({covering_kernel(wheels, headings_, k, cell_m),
                         covering_kernel(body, headings_, k, cell_m),
                         conservative_kernel(wheels, headings_, k, cell_m),
                         conservative_kernel(body, headings_, k, cell_m)});
    if (oriented_.back().lethal_body.cells > kMostCells) {
      throw std::invalid_argument("the cells of the terrain are too small for this vehicle");
    }
    if (oriented_.back().wheels.cells == 0) {
      throw std::invalid_argument("the cells of the terrain are too large for this vehicle");
    }
  }
}

std::uint16_t CSpaceKernels::cost(const Oriented& kernel, std::uint32_t wheel_roughness,
                                  std::uint32_t body_roughness, std::uint32_t unseen) const {
  const auto wheel_cells = static_cast<std::uint32_t>(kernel.wheels.cells);
  const auto body_cells = static_cast<std::uint32_t>(kernel.body.cells);
  if (unseen > params_.unseen_share_max * wheel_cells) return CSpace::kUnseen;
  // Weight w between the wheels and 1 under them is w everywhere and 1 − w more under the wheels.
  const auto between = static_cast<std::uint32_t>(std::lround(params_.between_weight * kWhole));
  const std::uint64_t sum =
      std::uint64_t{between} * body_roughness + std::uint64_t{kWhole - between} * wheel_roughness;
  const std::uint64_t most = kWhole * (std::uint64_t{between} * body_cells +
                                       std::uint64_t{kWhole - between} * wheel_cells);
  const auto factor = static_cast<std::uint64_t>(std::lround(params_.rough_factor * CSpace::kEven));
  return static_cast<std::uint16_t>(CSpace::kEven + factor * sum / most);
}

CSpace CSpaceKernels::convolve(const GroundLayers& layers) const {
  const auto outside =
      static_cast<std::uint32_t>(std::lround(kWhole * params_.ground.unseen_roughness));
  const LayerSums sums(layers, greatest_reach(oriented_), outside);
  CSpace space(headings_.count(), layers.columns, layers.rows);
  RowTotals totals(layers.columns);
  for (int k = 0; k < headings_.count() / 2; ++k) {
    const Oriented& kernel = oriented(k);
    for (int row = 0; row < layers.rows; ++row) {
      totals.gather(sums, kernel, row);
      std::uint16_t* costs = space.slice(k) + space.index(0, row);
      for (std::size_t i = 0; i < totals.lethal.size(); ++i) {
        if (totals.lethal[i] != 0) continue;
        costs[i] = cost(kernel, totals.ground[i] & kRoughnessMask, totals.roughness[i],
                        totals.ground[i] >> kUnseenShift);
      }
    }
  }
  return space;
}

}  // namespace adit
