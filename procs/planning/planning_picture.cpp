// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/planning_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace adit {
namespace {

constexpr int kKernels = 8;  // over half a turn
constexpr std::uint8_t kWhite = 255;
constexpr double kHalfGreyCost = 60.0;  // cost above even ground at half of the brightness

std::string degrees(double angle_rad) {
  return std::to_string(std::lround(rad_to_deg(angle_rad))) + "°";
}

std::uint8_t grey_of(std::uint16_t cost) {
  if (cost == CSpace::kLethal) return PlanPicture::kLethalGrey;
  if (cost == CSpace::kUnknown) return PlanPicture::kUnknownGrey;
  const double share = kHalfGreyCost / (kHalfGreyCost + CSpace::unmarked(cost) - CSpace::kEven);
  return static_cast<std::uint8_t>(
      std::lround(std::lerp(PlanPicture::kCostlyGrey, PlanPicture::kFlatGrey, share)));
}

GreyCells slice_of(const CSpace& space, const HeadingSet& headings, double angle_rad) {
  const int heading = headings.nearest(angle_rad);
  GreyCells slice{"C-space at " + degrees(headings.angle(heading)), space.columns(), {}};
  const std::vector<std::uint16_t>& costs = space.slice(heading).cells();
  std::transform(costs.begin(), costs.end(), std::back_inserter(slice.grey), grey_of);
  return slice;
}

void fill(GreyCells& cells, const RunKernel& kernel, int reach, std::uint8_t grey) {
  const auto side = static_cast<std::size_t>(cells.columns);
  for (const RunKernel::Run& run : kernel.runs) {
    for (int column = run.first; column <= run.last; ++column) {
      cells.grey[static_cast<std::size_t>(run.row + reach) * side +
                 static_cast<std::size_t>(column + reach)] = grey;
    }
  }
}

GreyCells kernel_of(const CSpaceKernels& kernels, int heading) {
  const auto& oriented = kernels.oriented(heading);
  const int reach = oriented.conservative_body.reach;
  GreyCells cells{degrees(kernels.headings().angle(heading)), 2 * reach + 1, {}};
  const auto side = static_cast<std::size_t>(cells.columns);
  cells.grey.assign(side * side, kWhite);
  fill(cells, oriented.conservative_body, reach, PlanPicture::kMarginGrey);
  fill(cells, oriented.body, reach, PlanPicture::kBetweenGrey);
  fill(cells, oriented.wheels, reach, PlanPicture::kWheelGrey);
  return cells;
}

}  // namespace

PlanPicture planning_picture(const std::string& title, const TerrainMap& terrain,
                             const PlannedPath& path, const Planning& planning,
                             const Vehicle& vehicle, const std::vector<double>& angles_rad) {
  PlanPicture picture;
  picture.title = title;
  picture.terrain = terrain;
  picture.path = path;
  picture.length_m = vehicle.length_m;
  picture.width_m = vehicle.width_m;
  if (!planning.kernels() || !planning.ground()) return picture;
  picture.reached = planning.ground()->reached;
  const CSpaceKernels& kernels = *planning.kernels();
  for (const double angle : angles_rad) {
    picture.slices.push_back(slice_of(planning.ground()->space, kernels.headings(), angle));
  }
  for (int i = 0; i < kKernels; ++i) {
    picture.kernels.push_back(kernel_of(kernels, i * kernels.headings().count() / (2 * kKernels)));
  }
  return picture;
}

}  // namespace adit
