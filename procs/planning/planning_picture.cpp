// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/planning_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "common/types/body_outline.hpp"

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
  const Grid2<std::uint16_t>& costs = space.slice(heading);
  Grid2<std::uint8_t> grey(costs.box());
  std::transform(costs.begin(), costs.end(), grey.begin(), grey_of);
  return {"C-space at " + degrees(headings.angle(heading)), std::move(grey)};
}

void fill(Grid2<std::uint8_t>& cells, const RunKernel& kernel, std::uint8_t grey) {
  for (const RunKernel::Run& run : kernel.runs) {
    for (int column = run.first; column <= run.last; ++column) cells.at({column, run.row}) = grey;
  }
}

GreyCells kernel_of(const CSpaceKernels& kernels, int heading) {
  const auto& oriented = kernels.oriented(heading);
  const int reach = oriented.conservative_body.reach;
  Grid2<std::uint8_t> cells(CellBox{{-reach, -reach}, {reach + 1, reach + 1}}, kWhite);
  fill(cells, oriented.conservative_body, PlanPicture::kMarginGrey);
  fill(cells, oriented.body, PlanPicture::kBetweenGrey);
  fill(cells, oriented.wheels, PlanPicture::kWheelGrey);
  return {degrees(kernels.headings().angle(heading)), std::move(cells)};
}

}  // namespace

PlanPicture planning_picture(const std::string& title, const TerrainMap& terrain,
                             const PlannedPath& path, const Planning& planning,
                             const Vehicle& vehicle, const std::vector<double>& angles_rad) {
  PlanPicture picture;
  picture.title = title;
  picture.terrain = terrain;
  picture.path = path;
  picture.outline = body_outline(vehicle);
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
