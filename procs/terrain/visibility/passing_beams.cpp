// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/visibility/passing_beams.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <tuple>

#include "procs/terrain/visibility/beams.hpp"

namespace adit {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr float kBeyondM = 0.3F;  // by which a beam ends beyond the places that it passes over
constexpr float kUnevenM = 0.3F;  // before the places that a beam shows to be free
constexpr float kFarM = 1e3F;
constexpr float kRangeLeastM = 0.05F;  // below it a slope is not significant

/// A beam in its vertical plane.
struct Beam {
  float slope;
  float range_m;  ///< horizontal
  float z_m;      ///< of its end, in level
};

std::vector<std::vector<Beam>> beams_by_sector(std::span<const CloudLine* const> lines) {
  std::vector<std::vector<Beam>> sectors(SectorBeams::kSectors);
  for (const CloudLine* line : lines) {
    for (const Eigen::Vector3f& p : line->points) {
      if (!is_usable(p)) continue;
      const Eigen::Vector3f away = p - line->origin;
      const float range_m = away.head<2>().norm();
      if (range_m < kRangeLeastM) continue;
      sectors[SectorBeams::sector(away.x(), away.y())].push_back(
          {away.z() / range_m, range_m, p.z()});
    }
  }
  return sectors;
}

/// From the steepest beam upwards: at each distance the second beam that reaches it counts.
void set_heights_of_second(std::vector<Beam>& beams, float cell_m, std::span<float> heights_m) {
  std::sort(beams.begin(), beams.end(), [](const Beam& a, const Beam& b) {
    return std::tie(a.slope, a.range_m, a.z_m) < std::tie(b.slope, b.range_m, b.z_m);
  });
  std::size_t once = 0;
  std::size_t twice = 0;
  for (const Beam& beam : beams) {
    const float passed_m = std::max(beam.range_m - kBeyondM, 0.0F);
    const auto end = std::min(static_cast<std::size_t>(passed_m / cell_m), heights_m.size());
    for (; twice < std::min(once, end); ++twice) {
      const float range_m = (static_cast<float>(twice) + 0.5F) * cell_m;
      heights_m[twice] = beam.z_m - beam.slope * (beam.range_m - range_m);
    }
    once = std::max(once, end);
  }
}

/// From the highest beam downwards: at each distance the second beam that reaches it counts, or the
/// end of the one above, whichever is higher: a roof continues between two beams. Not limited where
/// the highest two reach.
void set_highest(std::vector<Beam>& beams, float cell_m, std::span<float> heights_m) {
  std::sort(beams.begin(), beams.end(), [](const Beam& a, const Beam& b) {
    return std::tie(b.slope, a.range_m, a.z_m) < std::tie(a.slope, b.range_m, b.z_m);
  });
  std::size_t once = 0;
  std::size_t twice = 0;
  std::size_t farthest = 0;  // the beam that reaches `once`; all others so far end at `twice`
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const Beam& beam = beams[i];
    const std::size_t above = farthest + 1 == i ? 2 : 1;
    const float ended_z_m = i < above ? kNone : beams[i - above].z_m;
    const float reached_m = std::min(beam.range_m + kUnevenM, kFarM);
    const auto end = std::min(static_cast<std::size_t>(reached_m / cell_m), heights_m.size());
    for (; twice < std::min(once, end); ++twice) {
      const float range_m = (static_cast<float>(twice) + 0.5F) * cell_m;
      heights_m[twice] = std::max(ended_z_m, beam.z_m - beam.slope * (beam.range_m - range_m));
    }
    if (end > once) {
      once = end;
      farthest = i;
    }
  }
}

/// Beams without a return reach any distance.
void add_misses(std::span<const CloudLine* const> lines, std::vector<std::vector<Beam>>& sectors) {
  for (const CloudLine* line : lines) {
    for (const Eigen::Vector3f& direction : line->misses) {
      const float horizontal = direction.head<2>().norm();
      if (!is_usable(direction) || !(horizontal > 0.0F)) continue;
      const float slope = direction.z() / horizontal;
      sectors[SectorBeams::sector(direction.x(), direction.y())].push_back(
          {slope, kFarM, line->origin.z() + slope * kFarM});
    }
  }
}

}  // namespace

PassingBeams::PassingBeams(const Cloud& cloud, const TerrainMap& map, double margin_m)
    : cell_m_(static_cast<float>(map.cell_m)), margin_m_(static_cast<float>(margin_m)) {
  for (const auto& lines : lines_by_viewpoint(cloud)) {
    const Eigen::Vector3f origin = mean_origin(lines);
    const auto bins = static_cast<std::size_t>(reach_m(map, origin) / cell_m_) + 2;
    Viewpoint viewpoint{origin.head<2>(), bins,
                        std::vector<float>(SectorBeams::kSectors * bins, kNone),
                        std::vector<float>(SectorBeams::kSectors * bins, -kNone)};
    auto sectors = beams_by_sector(lines);
    for (std::size_t i = 0; i < sectors.size(); ++i) {
      set_heights_of_second(sectors[i], cell_m_,
                            std::span(viewpoint.heights_m).subspan(i * bins, bins));
    }
    add_misses(lines, sectors);
    for (std::size_t i = 0; i < sectors.size(); ++i) {
      set_highest(sectors[i], cell_m_, std::span(viewpoint.highest_m).subspan(i * bins, bins));
    }
    viewpoints_.push_back(std::move(viewpoint));
  }
}

Eigen::Vector2d PassingBeams::p_level_laser() const {
  if (viewpoints_.empty()) return Eigen::Vector2d::Zero();
  return viewpoints_.front().origin.cast<double>();
}

std::optional<std::size_t> PassingBeams::Viewpoint::index(const Eigen::Vector2f& p_level,
                                                          float cell_m) const {
  const Eigen::Vector2f d = p_level - origin;
  const auto bin = static_cast<std::size_t>(d.norm() / cell_m);
  if (bin >= bins) return std::nullopt;
  return SectorBeams::sector(d.x(), d.y()) * bins + bin;
}

float PassingBeams::Viewpoint::free_up_to_m(const Eigen::Vector2f& p_level, float cell_m) const {
  const auto i = index(p_level, cell_m);
  if (!i || highest_m[*i] == -kNone) return kNone;
  const std::size_t all = highest_m.size();
  return std::max(
      {highest_m[*i], highest_m[(*i + bins) % all], highest_m[(*i + all - bins) % all]});
}

float PassingBeams::height_m(const Eigen::Vector2f& p_level) const {
  float least = kNone;
  for (const Viewpoint& viewpoint : viewpoints_) {
    const auto i = viewpoint.index(p_level, cell_m_);
    if (i) least = std::min(least, viewpoint.heights_m[*i]);
  }
  return least;
}

/// From any of the viewpoints.
float PassingBeams::free_up_to_m(const Eigen::Vector2f& p_level) const {
  float most = viewpoints_.empty() ? kNone : -kNone;
  for (const Viewpoint& viewpoint : viewpoints_)
    most = std::max(most, viewpoint.free_up_to_m(p_level, cell_m_));
  return most;
}

}  // namespace adit
