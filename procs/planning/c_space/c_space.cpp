// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/c_space/c_space.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/types/body_outline.hpp"
#include "procs/planning/c_space/footprint.hpp"
#include "procs/planning/c_space/kernel.hpp"

namespace adit {
namespace {

// The roughness and the number of unknown cells share one sum, so that the wheel kernel is applied
// once.
constexpr int kUnknownShift = 20;
constexpr std::uint32_t kRoughnessMask = (1U << kUnknownShift) - 1U;
// Maximum cells of a kernel: their count fits into 12 bits, the sum of 255 for each into 20.
constexpr int kKernelCellsMax = 4095;

constexpr double kRoughnessMax = 255.0;  // stored value of roughness 1

/// Prefix sums of the layers along rows.
struct LayerSums {
  LayerSums(const GroundLayers& layers, int border, std::uint32_t unknown_roughness)
      : lethal_body(layers.columns(), layers.rows(), border, 0, Of{layers, layers.under_body}),
        body(layers.columns(), layers.rows(), border, 0,
             [&](int column, int row) {
               const std::size_t i = layers.index(column, row);
               return std::uint8_t{
                   static_cast<std::uint8_t>(layers.under_body[i] | layers.unknown[i])};
             }),
        lethal_wheels(layers.columns(), layers.rows(), border, 0, Of{layers, layers.under_wheels}),
        roughness(layers.columns(), layers.rows(), border, unknown_roughness,
                  Of{layers, layers.roughness}),
        ground(layers.columns(), layers.rows(), border, (1U << kUnknownShift) + unknown_roughness,
               [&](int column, int row) {
                 const std::size_t i = layers.index(column, row);
                 return (std::uint32_t{layers.unknown[i]} << kUnknownShift) + layers.roughness[i];
               }) {}

  struct Of {
    const GroundLayers& layers;
    const CellLayer& layer;
    std::uint8_t operator()(int column, int row) const { return layer[layers.index(column, row)]; }
  };

  RowSums<std::uint16_t> lethal_body;
  RowSums<std::uint16_t> body;  ///< lethal or unknown
  RowSums<std::uint16_t> lethal_wheels;
  RowSums<std::uint32_t> roughness;
  RowSums<std::uint32_t> ground;
};

/// The sums over all kernels for one row of cells.
struct RowTotals {
  explicit RowTotals(int columns)
      : lethal(static_cast<std::size_t>(columns)),
        marginal(lethal.size()),
        roughness(lethal.size()),
        ground(lethal.size()) {}

  void gather(const LayerSums& sums, const CSpaceKernels::Oriented& kernel, int row) {
    std::fill(lethal.begin(), lethal.end(), std::uint16_t{0});
    std::fill(marginal.begin(), marginal.end(), std::uint16_t{0});
    std::fill(roughness.begin(), roughness.end(), 0U);
    std::fill(ground.begin(), ground.end(), 0U);
    sums.lethal_body.add_row(kernel.lethal_body, row, lethal);
    sums.lethal_wheels.add_row(kernel.lethal_wheels, row, lethal);
    sums.body.add_row(kernel.conservative_body, row, marginal);
    sums.lethal_wheels.add_row(kernel.conservative_wheels, row, marginal);
    sums.roughness.add_row(kernel.body, row, roughness);
    sums.ground.add_row(kernel.wheels, row, ground);
  }

  std::vector<std::uint16_t> lethal;
  std::vector<std::uint16_t> marginal;
  std::vector<std::uint32_t> roughness;
  std::vector<std::uint32_t> ground;
};

int reach_max(const std::vector<CSpaceKernels::Oriented>& kernels) {
  int reach = 0;
  for (const auto& k : kernels) {
    reach = std::max({reach, k.wheels.reach, k.body.reach, k.conservative_wheels.reach,
                      k.conservative_body.reach});
  }
  return reach;
}

/// Sets the cost factors of a kernel. A weight of w between the wheels and 1 under them is a weight
/// of w under the body plus 1 − w under the wheels.
void set_cost_factors(CSpaceKernels::Oriented& kernel, const CSpaceParams& params) {
  if (kernel.conservative_body.cells > kKernelCellsMax) {
    throw std::invalid_argument("the cells of the terrain are too small for this vehicle");
  }
  if (kernel.wheels.cells == 0) {
    throw std::invalid_argument("the cells of the terrain are too large for this vehicle");
  }
  const double w = params.between_weight;
  const double most = kRoughnessMax * (w * kernel.body.cells + (1.0 - w) * kernel.wheels.cells);
  const double unit = std::ldexp(params.rough_factor * CSpace::kEven / most, 32);
  kernel.cost_per_wheels = static_cast<std::uint64_t>((1.0 - w) * unit);
  kernel.cost_per_body = static_cast<std::uint64_t>(w * unit);
  kernel.unknown_max = static_cast<std::uint32_t>(params.unknown_share_max * kernel.wheels.cells);
}

/// The polygons shrunk by a margin, without those that vanish.
std::vector<ConvexPolygon> shrunk(const std::vector<ConvexPolygon>& polygons, double margin_m) {
  std::vector<ConvexPolygon> smaller;
  for (const ConvexPolygon& polygon : polygons) {
    smaller.push_back(polygon.grown(-margin_m));
    if (smaller.back().empty()) smaller.pop_back();
  }
  return smaller;
}

std::uint16_t marginal(std::uint16_t cost) {
  return cost < CSpace::kUnknown ? static_cast<std::uint16_t>(cost + CSpace::kMarginal) : cost;
}

}  // namespace

CSpace::CSpace(int headings, int columns, int rows)
    : headings_(headings),
      slices_(static_cast<std::size_t>(headings / 2),
              Grid2<std::uint16_t>(columns, rows, kLethal)) {}

void CSpace::keep_lower(const CSpace& other) {
  for (std::size_t k = 0; k < slices_.size(); ++k)
    for (std::size_t i = 0; i < slices_[k].size(); ++i)
      slices_[k][i] = std::min(slices_[k][i], other.slices_[k][i]);
}

CSpaceKernels::CSpaceKernels(const Vehicle& vehicle, const CSpaceParams& params, double cell_m)
    : headings_(params.headings),
      cell_m_(cell_m),
      outside_roughness_(static_cast<std::uint32_t>(
          std::lround(kRoughnessMax * params.ground.unknown_roughness))) {
  const auto wheels = wheel_tracks(vehicle);
  const std::vector<ConvexPolygon> body{body_outline(vehicle)};
  for (int k = 0; k < headings_.count() / 2; ++k) {
    Oriented kernel;
    kernel.wheels = covering_kernel(wheels, headings_, k, cell_m);
    kernel.body = covering_kernel(body, headings_, k, cell_m);
    kernel.conservative_wheels = conservative_kernel(wheels, headings_, k, cell_m);
    kernel.conservative_body = conservative_kernel(body, headings_, k, cell_m);
    kernel.lethal_wheels = covering_kernel(shrunk(wheels, cell_m), headings_, k, cell_m);
    kernel.lethal_body = covering_kernel(shrunk(body, cell_m), headings_, k, cell_m);
    kernel.start_wheels = covering_kernel(shrunk(wheels, cell_m / 2.0), headings_, k, cell_m);
    kernel.start_body = covering_kernel(shrunk(body, cell_m / 2.0), headings_, k, cell_m);
    const std::vector<Pose2> pose{{0.0, 0.0, headings_.angle(k)}};
    kernel.exact_wheels = swept_kernel(wheels, pose, cell_m);
    kernel.exact_body = swept_kernel(body, pose, cell_m);
    set_cost_factors(kernel, params);
    oriented_.push_back(std::move(kernel));
  }
}

CSpace CSpaceKernels::convolve(const GroundLayers& layers) const {
  const LayerSums sums(layers, reach_max(oriented_), outside_roughness_);
  CSpace space(headings_.count(), layers.columns(), layers.rows());
  RowTotals totals(layers.columns());
  for (int k = 0; k < headings_.count() / 2; ++k) {
    const Oriented& kernel = oriented(k);
    for (int row = 0; row < layers.rows(); ++row) {
      totals.gather(sums, kernel, row);
      std::uint16_t* costs = &space.slice(k).at({0, row});
      for (std::size_t i = 0; i < totals.lethal.size(); ++i) {
        if (totals.lethal[i] != 0) continue;
        const std::uint16_t cost =
            kernel.cost(totals.ground[i] & kRoughnessMask, totals.roughness[i],
                        totals.ground[i] >> kUnknownShift);
        costs[i] = totals.marginal[i] == 0 ? cost : marginal(cost);
      }
    }
  }
  return space;
}

}  // namespace adit
