// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/laser/reflectance.hpp"

#include <algorithm>
#include <array>

namespace adit {
namespace {

// In the order of Material: rock, timber, rusty steel, wet mud, water, mirror.
constexpr std::array kReflectivity{0.25, 0.40, 0.30, 0.12, 0.0, 0.0};

// Of water, at right angles: ((n − 1) / (n + 1))² with n = 1.33.
constexpr double kMirroredAtRightAngles = 0.02;

}  // namespace

double reflectivity(Material material) { return kReflectivity[static_cast<std::size_t>(material)]; }

double reflectivity_max() { return *std::max_element(kReflectivity.begin(), kReflectivity.end()); }

double mirrored_share(double cos_incidence) {
  const double grazing = 1.0 - cos_incidence;
  const double grazing2 = grazing * grazing;
  return kMirroredAtRightAngles + (1.0 - kMirroredAtRightAngles) * grazing2 * grazing2 * grazing;
}

}  // namespace adit
