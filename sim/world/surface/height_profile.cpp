// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/surface/height_profile.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace adit {
namespace {

constexpr double kHeightMax = 5000.0;  // deeper than any mine [m]

}  // namespace

HeightProfile::HeightProfile(const std::vector<double>& profile_m, Grade grade,
                             const std::string& what)
    : grade_(grade) {
  if (profile_m.size() % 2 != 0) {
    throw std::invalid_argument(what + " has an s without a z");
  }
  for (std::size_t i = 0; i < profile_m.size(); i += 2) {
    if (!std::isfinite(profile_m[i]) || !std::isfinite(profile_m[i + 1])) {
      throw std::invalid_argument(what + " has a number that is not finite");
    }
    if (std::abs(profile_m[i + 1]) > kHeightMax) {
      throw std::invalid_argument(what + " has a height beyond 5000 m");
    }
    if (!knots_.empty() && profile_m[i] <= knots_.back().s_m) {
      throw std::invalid_argument(what + " has distances that do not ascend");
    }
    knots_.push_back({profile_m[i], profile_m[i + 1], 0.0});
  }
  set_slopes();
}

void HeightProfile::set_slopes() {
  for (std::size_t i = 1; i + 1 < knots_.size(); ++i) {
    const double before = knots_[i].s_m - knots_[i - 1].s_m;
    const double after = knots_[i + 1].s_m - knots_[i].s_m;
    const double in = (knots_[i].z_m - knots_[i - 1].z_m) / before;
    const double out = (knots_[i + 1].z_m - knots_[i].z_m) / after;
    if (in * out <= 0.0) continue;  // slope 0 at a local extremum
    const double share = (before + 2.0 * after) / (3.0 * (before + after));
    knots_[i].slope = in * out / (share * out + (1.0 - share) * in);
  }
}

double HeightProfile::at(double s_m) const {
  if (knots_.empty()) return 0.0;
  const auto next = std::upper_bound(knots_.begin(), knots_.end(), s_m,
                                     [](double s, const Knot& knot) { return s < knot.s_m; });
  if (next == knots_.begin()) return knots_.front().z_m;
  if (next == knots_.end()) return knots_.back().z_m;
  const Knot& a = *(next - 1);
  const Knot& b = *next;
  const double length = b.s_m - a.s_m;
  const double t = (s_m - a.s_m) / length;
  if (grade_ == Grade::kSudden) return std::lerp(a.z_m, b.z_m, t);
  const double rest = 1.0 - t;
  return rest * rest * ((1.0 + 2.0 * t) * a.z_m + t * length * a.slope) +
         t * t * ((1.0 + 2.0 * rest) * b.z_m - rest * length * b.slope);
}

}  // namespace adit
