// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/mixed_pixels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <vector>

namespace adit {
namespace {

float valid_range_m(float range_m, const LaserMount& mount) {
  if (range_m >= mount.range_max_m) return std::numeric_limits<float>::infinity();
  if (range_m >= mount.range_min_m) return range_m;
  return std::numeric_limits<float>::quiet_NaN();
}

enum class Kind {
  kSurface,  // or no return
  kMixture,
  kIsolated,
};

using Row = std::vector<float>;
using Kinds = std::vector<std::vector<Kind>>;

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

float at(const Row& row, std::ptrdiff_t beam) {
  const bool exists = beam >= 0 && beam < std::ssize(row);
  return exists ? row[static_cast<std::size_t>(beam)] : kNothing;
}

/// NaN differs from no value, infinity from all finite values.
bool differs(float a, float b, const MixedPixelParams& params) {
  return std::abs(a - b) > params.jump_min_m;
}

/// Whether a beam continues the line through the beams at `step` and 2 · `step` from it. The
/// inverse ranges of a line at equal angular steps Δ satisfy u₀ + u₂ = 2 cos Δ u₁. The
/// approximation cos Δ = 1 has an error of 0.03 % of the range at one degree.
bool continues_line(const Row& row, std::ptrdiff_t beam, std::ptrdiff_t step,
                    const MixedPixelParams& params) {
  const float next = at(row, beam + step);
  const float second = at(row, beam + 2 * step);
  if (!std::isfinite(next) || !std::isfinite(second)) return false;
  const float inverse = 2.0F / next - 1.0F / second;
  return inverse > 0.0F && !differs(1.0F / inverse, at(row, beam), params);
}

/// Whether a beam belongs to the surface of the beams at `step` to either side.
bool is_of_surface(const Row& row, std::ptrdiff_t beam, std::ptrdiff_t step,
                   const MixedPixelParams& params) {
  const float range = at(row, beam);
  return !differs(range, at(row, beam - step), params) ||
         !differs(range, at(row, beam + step), params) ||
         continues_line(row, beam, -step, params) || continues_line(row, beam, step, params);
}

Kind kind_of(const Row& row, std::ptrdiff_t beam, int turns, const MixedPixelParams& params) {
  const float range = at(row, beam);
  const float left = at(row, beam - 1);
  const float right = at(row, beam + 1);
  if (!std::isfinite(range)) return Kind::kSurface;
  if (is_of_surface(row, beam, 1, params)) return Kind::kSurface;
  if (is_of_surface(row, beam, turns, params)) return Kind::kSurface;
  const bool between = (left < range) == (range < right);
  if (!between) return Kind::kIsolated;
  return std::abs(left - right) <= params.span_max_m ? Kind::kMixture : Kind::kSurface;
}

Kinds kinds_of(const RangeImage& image, int turns, const MixedPixelParams& params) {
  Kinds kinds;
  for (const Row& row : image) {
    std::vector<Kind>& of_row = kinds.emplace_back(row.size());
    for (std::size_t i = 0; i < row.size(); ++i) {
      of_row[i] = kind_of(row, static_cast<std::ptrdiff_t>(i), turns, params);
    }
  }
  return kinds;
}

/// Number of returns near `beam` in a row that have the same range and are no mixtures.
int support_count(const Row& row, const std::vector<Kind>& kinds, std::size_t beam, float range,
                  const MixedPixelParams& params) {
  int n = 0;
  const std::size_t end = std::min(row.size(), beam + 2);
  for (std::size_t i = beam > 0 ? beam - 1 : 0; i < end; ++i) {
    const bool counts = std::isfinite(row[i]) && kinds[i] != Kind::kMixture;
    if (counts && !differs(row[i], range, params)) ++n;
  }
  return n;
}

bool is_supported(const RangeImage& image, const Kinds& kinds, std::size_t line, std::size_t beam,
                  const MixedPixelParams& params) {
  int n = 0;
  const float range = image[line][beam];
  if (line > 0) n += support_count(image[line - 1], kinds[line - 1], beam, range, params);
  if (line + 1 < image.size()) {
    n += support_count(image[line + 1], kinds[line + 1], beam, range, params);
  }
  return n >= params.support_min;
}

}  // namespace

RangeImage range_image(std::span<const LaserScan> scans, const LaserMount& mount) {
  RangeImage image;
  image.reserve(scans.size());
  for (const LaserScan& scan : scans) {
    std::vector<float>& row = image.emplace_back();
    std::ranges::transform(scan.ranges_m, std::back_inserter(row),
                           [&](float range_m) { return valid_range_m(range_m, mount); });
  }
  return image;
}

RangeImage range_image(const LidarRevolution& revolution, const LaserMount& mount) {
  RangeImage image(revolution.rings.size());
  for (std::size_t ring = 0; ring < image.size(); ++ring) {
    for (std::size_t column = 0; column < revolution.columns.size(); ++column) {
      image[ring].push_back(valid_range_m(revolution.range_m(column, ring), mount));
    }
  }
  return image;
}

void remove_mixed_pixels(RangeImage& image, int turns, const MixedPixelParams& params) {
  const RangeImage measured = image;
  const Kinds kinds = kinds_of(measured, turns, params);
  for (std::size_t line = 0; line < measured.size(); ++line) {
    for (std::size_t beam = 0; beam < measured[line].size(); ++beam) {
      if (kinds[line][beam] == Kind::kSurface) continue;
      if (!is_supported(measured, kinds, line, beam, params)) image[line][beam] = kNothing;
    }
  }
}

}  // namespace adit
