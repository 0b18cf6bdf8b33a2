// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/laser/echo.hpp"

#include <algorithm>

namespace adit {
namespace {

double total_power(std::span<const Echo> echoes) {
  double power = 0.0;
  for (const Echo& echo : echoes) power += echo.power;
  return power;
}

/// How many of the echoes, in the order of range, run together with the first.
std::size_t count_within_pulse(std::span<const Echo> echoes, double pulse_length_m) {
  std::size_t n = 1;
  while (n < echoes.size() && echoes[n].range_m <= echoes[0].range_m + pulse_length_m) ++n;
  return n;
}

Echo merged(std::span<const Echo> echoes) {
  Echo sum;
  for (const Echo& echo : echoes) {
    sum.range_m += echo.power * echo.range_m;
    sum.power += echo.power;
  }
  return {sum.range_m / sum.power, sum.power};
}

}  // namespace

std::optional<Echo> seen_as_one(std::span<Echo> echoes, double pulse_length_m, double first_share) {
  if (echoes.empty()) return std::nullopt;
  std::sort(echoes.begin(), echoes.end(),
            [](const Echo& a, const Echo& b) { return a.range_m < b.range_m; });
  const double enough = first_share * total_power(echoes);
  Echo strongest;
  for (std::span<Echo> rest = echoes; !rest.empty();) {
    const std::size_t n = count_within_pulse(rest, pulse_length_m);
    const Echo together = merged(rest.first(n));
    if (together.power >= enough) return together;
    if (together.power > strongest.power) strongest = together;
    rest = rest.subspan(n);
  }
  return strongest;
}

}  // namespace adit
