// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/section/section_outline.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/segment.hpp"

namespace adit {
namespace {

constexpr double kGapMaxRad = 0.4;      // a wider one may be a side tunnel
constexpr std::size_t kSmallGap = 2;    // rays
constexpr double kGapSdShare = 0.1;     // of the length of the line that closes it
constexpr double kCornerShare = 0.125;  // of its square: half of a right-angled corner behind it

/// The chord through the point inside along two opposite rays.
Measured chord(const SectionOutline::Ray& a, const SectionOutline::Ray& b, double common_sd_m) {
  return {a.distance_m + b.distance_m,
          std::sqrt(a.sd_m * a.sd_m + b.sd_m * b.sd_m + 4.0 * common_sd_m * common_sd_m)};
}

/// The widest angle between seen rays.
double widest_gap_rad(const SectionOutline& outline) {
  constexpr std::size_t kRays = SectionOutline::kRays;
  std::size_t widest = 0;
  std::size_t run = 0;
  for (std::size_t i = 0; i < 2 * kRays; ++i) {  // twice round, as a gap may cover the begin
    run = outline.rays[i % kRays].seen() ? 0 : run + 1;
    widest = std::max(widest, std::min(run, kRays));
  }
  return widest == 0 ? 0.0 : static_cast<double>(widest + 1) * SectionOutline::kStepRad;
}

}  // namespace

Eigen::Vector2d SectionOutline::direction(std::size_t ray) {
  const double angle = kStepRad * static_cast<double>(ray);
  return {std::cos(angle), std::sin(angle)};
}

std::vector<Eigen::Vector2d> SectionOutline::corners() const {
  std::vector<Eigen::Vector2d> corners;
  for (std::size_t i = 0; i < kRays; ++i) {
    if (rays[i].seen()) corners.push_back(rays[i].distance_m * direction(i));
  }
  return corners;
}

void SectionOutline::close_small_gaps() {
  const std::array<Ray, kRays> before = rays;
  for (std::size_t i = 0; i < kRays; ++i) {
    if (!before[i].seen()) continue;
    std::size_t next = 1;
    while (next <= kSmallGap && !before[(i + next) % kRays].seen()) ++next;
    const Ray& end = before[(i + next) % kRays];
    if (next == 1 || !end.seen()) continue;
    const Eigen::Vector2d a = before[i].distance_m * direction(i);
    const Eigen::Vector2d along = end.distance_m * direction((i + next) % kRays) - a;
    const double sd_m = kGapSdShare * along.norm() + std::max(before[i].sd_m, end.sd_m);
    for (std::size_t k = 1; k < next; ++k) {
      const Eigen::Vector2d ray = direction((i + k) % kRays);
      rays[(i + k) % kRays] = {cross(a, along) / cross(ray, along), sd_m};
    }
  }
}

bool SectionMeasures::is_closed() const { return gap_max_rad <= kGapMaxRad; }

/// The area changes by half of the distance between the neighbours of a corner, across its ray, for
/// each metre along it.
SectionMeasures measure(const SectionOutline& outline, double common_sd_m) {
  using Outline = SectionOutline;
  SectionMeasures measures;
  measures.width_m =
      chord(outline.rays[Outline::kLeft], outline.rays[Outline::kRight], common_sd_m);
  measures.height_m = chord(outline.rays[Outline::kUp], outline.rays[Outline::kDown], common_sd_m);
  measures.gap_max_rad = widest_gap_rad(outline);
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < Outline::kRays; ++i) {
    if (outline.rays[i].seen()) seen.push_back(i);
  }
  measures.seen_share = static_cast<double>(seen.size()) / Outline::kRays;
  const std::vector<Eigen::Vector2d> corners = outline.corners();
  double variance = 0.0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::size_t before = (k + corners.size() - 1) % corners.size();
    const std::size_t next = (k + 1) % corners.size();
    measures.area_m2.value += 0.5 * cross(corners[k], corners[next]);
    measures.perimeter_m.value += (corners[next] - corners[k]).norm();
    const Eigen::Vector2d across = corners[next] - corners[before];
    const double rate = 0.5 * std::abs(cross(Outline::direction(seen[k]), across));
    variance += std::pow(rate * outline.rays[seen[k]].sd_m, 2);
    if ((seen[(k + 1) % seen.size()] + Outline::kRays - seen[k]) % Outline::kRays > 1)
      variance += std::pow(kCornerShare * (corners[next] - corners[k]).squaredNorm(), 2);
  }
  const double common_m2 = measures.perimeter_m.value * common_sd_m;
  measures.area_m2.sd = std::sqrt(variance + common_m2 * common_m2);
  measures.perimeter_m.sd = 2.0 * std::numbers::pi * common_sd_m;
  return measures;
}

}  // namespace adit
