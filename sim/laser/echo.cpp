// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/laser/echo.hpp"

#include <algorithm>
#include <array>

namespace adit {
namespace {

// In the order of Material: rock, timber, rusty steel, wet mud, water, mirror.
constexpr std::array kReflectivity{0.25, 0.40, 0.30, 0.12, 0.0, 0.0};

// Of water at normal incidence: ((n − 1) / (n + 1))² with n = 1.33.
constexpr double kSpecularAtNormalIncidence = 0.02;

}  // namespace

double reflectivity(Material material) { return kReflectivity[static_cast<std::size_t>(material)]; }

double reflectivity_max() { return *std::max_element(kReflectivity.begin(), kReflectivity.end()); }

double specular_share(double cos_incidence) {
  const double grazing = 1.0 - cos_incidence;
  const double grazing2 = grazing * grazing;
  return kSpecularAtNormalIncidence +
         (1.0 - kSpecularAtNormalIncidence) * grazing2 * grazing2 * grazing;
}

namespace {

double total_power(std::span<const Echo> echoes) {
  double power = 0.0;
  for (const Echo& echo : echoes) power += echo.power;
  return power;
}

/// Number of echoes, sorted by range, that merge with the first.
std::size_t count_within_pulse(std::span<const Echo> echoes, double pulse_length_m) {
  std::size_t n = 1;
  while (n < echoes.size() && echoes[n].range_m <= echoes[0].range_m + pulse_length_m) ++n;
  return n;
}

Echo weighted_mean(std::span<const Echo> echoes) {
  Echo sum;
  for (const Echo& echo : echoes) {
    sum.range_m += echo.power * echo.range_m;
    sum.power += echo.power;
  }
  return {sum.range_m / sum.power, sum.power};
}

}  // namespace

std::optional<Echo> merge_echoes(std::span<Echo> echoes, double pulse_length_m,
                                 double first_echo_share) {
  if (echoes.empty()) return std::nullopt;
  std::sort(echoes.begin(), echoes.end(),
            [](const Echo& a, const Echo& b) { return a.range_m < b.range_m; });
  const double enough = first_echo_share * total_power(echoes);
  Echo strongest;
  for (std::span<Echo> rest = echoes; !rest.empty();) {
    const std::size_t n = count_within_pulse(rest, pulse_length_m);
    const Echo together = weighted_mean(rest.first(n));
    if (together.power >= enough) return together;
    if (together.power > strongest.power) strongest = together;
    rest = rest.subspan(n);
  }
  return strongest;
}

}  // namespace adit
