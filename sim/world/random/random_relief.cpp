// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/random/random_relief.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/random/topologies.hpp"
#include "sim/world/surface/height_profile.hpp"

namespace adit {
namespace {

constexpr double kReliefMax = 25.0;      // of the seam, above or below the entrance [m]
constexpr double kCurveLength = 6.0;     // of a smooth change of grade [m]
constexpr double kKnotEvery = 1.0;       // of a smooth change of grade [m]
constexpr double kPortalGrade = 0.03;    // greatest grade behind the entrance
constexpr double kFromJunction = 2.0;    // of a rise, beyond the walls of the other tunnel [m]
constexpr double kStretchMin = 14.0;     // between junctions, to have a rise of its own [m]
constexpr double kStretchShare = 0.45;   // of the stretches that have a rise
constexpr double kTooSteepShare = 0.25;  // of the mines that have a stretch that is too steep
constexpr double kStepWidth = 0.05;      // over which a sill rises [m]
constexpr double kWaterGradeMax = 0.03;  // on more, water would be a pit
constexpr double kCarGradeMax = 0.12;    // on more, a car would roll

/// Appends points to a list s, z, s, z, .. with given grades.
class ProfileWriter {
 public:
  explicit ProfileWriter(double s_m, double z_m = 0.0) : s_m_(s_m), z_m_(z_m) { add(); }

  [[nodiscard]] double s_m() const { return s_m_; }
  [[nodiscard]] double z_m() const { return z_m_; }
  std::vector<double> take() { return std::move(profile_m_); }

  /// At the grade of the last call first, from which it turns to `grade` over `curve_m`.
  void go(double length_m, double grade, double curve_m) {
    const double in_curve = std::min(curve_m, length_m);
    const int knots = static_cast<int>(std::ceil(in_curve / kKnotEvery));
    const double from = grade_;
    for (int i = 0; i < knots; ++i) {
      const double middle = (i + 0.5) / knots;  // the mean grade of a parabola between two points
      advance(in_curve / knots, std::lerp(from, grade, middle));
    }
    if (length_m > in_curve) advance(length_m - in_curve, grade);
    grade_ = grade;
  }

 private:
  void advance(double length_m, double grade) {
    s_m_ += length_m;
    z_m_ += grade * length_m;
    add();
  }
  void add() { profile_m_.insert(profile_m_.end(), {s_m_, z_m_}); }

  double s_m_;
  double z_m_;
  double grade_ = 0.0;
  std::vector<double> profile_m_;
};

/// What a mine is like.
struct Character {
  double grade_max = 0.1;  ///< of the seam
  bool sudden = false;
};

Character random_character(RandomGenerator& rng) {
  constexpr std::array<double, 4> kGrades{0.06, 0.12, 0.20, 0.26};
  const int kind = rng.between(0, static_cast<int>(kGrades.size()) - 1);
  return {kGrades[static_cast<std::size_t>(kind)], rng.chance(0.4)};
}

/// Largest distance of a tunnel from the origin along a direction.
double extent_m(const std::vector<TunnelLine>& tunnels, const Eigen::Vector2d& direction) {
  double extent = 0.0;
  for (const TunnelLine& tunnel : tunnels) {
    for (const Eigen::Vector2d& p : tunnel.points) extent = std::max(extent, direction.dot(p));
  }
  return extent;
}

/// The grades of a seam from the entrance: a dip that changes every few tens of metres, and turns
/// back before the relief becomes too great.
std::vector<double> seam_profile(double level_to_m, double extent_m, const Character& character,
                                 RandomGenerator& rng) {
  const double curve_m = character.sudden ? 0.0 : kCurveLength;
  const double dip = rng.side();
  ProfileWriter writer(0.0);
  writer.go(level_to_m, rng.between(-kPortalGrade, kPortalGrade), curve_m);
  while (writer.s_m() < extent_m) {
    const double length_m = rng.between(12.0, 45.0);
    double grade = rng.between(0.3, 1.0) * character.grade_max * (rng.chance(0.75) ? dip : -dip);
    if (std::abs(writer.z_m() + grade * length_m) > kReliefMax) {
      grade = -std::copysign(grade, writer.z_m());
    }
    writer.go(length_m, rng.chance(0.1) ? 0.0 : grade, curve_m);
  }
  return writer.take();
}

void add_seam(const std::vector<TunnelLine>& tunnels, const Character& character,
              RandomGenerator& rng, HeightsDescription& heights) {
  // Across the main tunnel, the dip becomes its cross slope.
  const bool across = rng.chance(0.3);
  const double off = across ? rng.side() * rng.between(0.9, 1.3) : rng.between(-0.5, 0.5);
  heights.heading_rad = off;
  heights.grade = "sudden";  // its points are dense where it is smooth
  const Eigen::Vector2d direction(std::cos(off), std::sin(off));
  const double level_to_m =
      kUndamagedLength * direction.x() + tunnels.front().width_m * std::abs(direction.y());
  heights.profile_m = seam_profile(level_to_m, extent_m(tunnels, direction), character, rng);
  // The noise is steeper than 1.5 heights in a length at few places, and nowhere than 3.
  heights.rolls.length_m = rng.between(15.0, 40.0);
  heights.rolls.height_m = 0.01 * heights.rolls.length_m * (rng.chance(0.5) ? 1.0 : 0.3);
  if (rng.chance(0.3)) {
    const double height_m = rng.between(0.05, 0.10);
    heights.clearance_m += height_m - heights.floor_relief.height_m;
    heights.floor_relief.height_m = height_m;
  }
}

/// A part of a tunnel without junctions.
struct FreeStretch {
  std::size_t tunnel = 0;
  double from_m = 0.0;
  double to_m = 0.0;
  bool to_end = false;  ///< to the end of the tunnel, where it meets none
};

/// Whether another tunnel is near the walls at a distance along a tunnel.
bool is_at_junction(const std::vector<TunnelLine>& tunnels, std::size_t tunnel, double s_m) {
  const TunnelLine& line = tunnels[tunnel];
  const Eigen::Vector2d p_world = line.at(s_m).p_world;
  for (std::size_t i = 0; i < tunnels.size(); ++i) {
    const double room_m = (tunnels[i].width_m + line.width_m) / 2.0 + kFromJunction;
    if (i != tunnel && tunnels[i].distance_m(p_world) < room_m) return true;
  }
  return false;
}

std::vector<FreeStretch> free_stretches(const std::vector<TunnelLine>& tunnels, std::size_t count) {
  constexpr double kStep = 0.5;
  std::vector<FreeStretch> stretches;
  for (std::size_t i = 0; i < count; ++i) {
    const TunnelLine& line = tunnels[i];
    const bool ring = line.points.front() == line.points.back();
    const double first_m = i == 0 ? kUndamagedLength + 2.0
                           : ring ? line.width_m + kFromJunction
                                  : 0.0;
    const double last_m = line.length_m() - (ring ? line.width_m + kFromJunction : 0.0);
    std::optional<double> begin_m;
    for (double s_m = first_m;; s_m += kStep) {
      const bool over = s_m > last_m;
      const bool is_free = !over && !is_at_junction(tunnels, i, s_m);
      if (is_free && !begin_m) begin_m = s_m;
      if (!is_free && begin_m) {
        stretches.push_back({i, *begin_m, s_m - kStep, over && !ring});
        begin_m.reset();
      }
      if (over) break;
    }
  }
  std::erase_if(stretches, [](const FreeStretch& stretch) {
    return stretch.to_m - stretch.from_m < kStretchMin;
  });
  return stretches;
}

/// Greatest grade of the seam along a tunnel between two distances, either sign.
double grade_along(const TunnelLine& tunnel, double from_m, double to_m,
                   const HeightsDescription& heights) {
  const HeightProfile profile(heights.profile_m, HeightProfile::grade_named(heights.grade));
  const Eigen::Vector2d direction(std::cos(heights.heading_rad), std::sin(heights.heading_rad));
  constexpr double kStep = 0.5;
  double steepest = 0.0;
  for (double s_m = from_m; s_m < to_m; s_m += kStep) {
    const double a = profile.at(direction.dot(tunnel.at(s_m).p_world));
    const double b = profile.at(direction.dot(tunnel.at(s_m + kStep).p_world));
    steepest = std::max(steepest, std::abs(b - a) / kStep);
  }
  return steepest + 1.5 * heights.rolls.height_m / heights.rolls.length_m;
}

/// Up or down at a grade, then level, and back unless the tunnel ends.
void add_ramps(const FreeStretch& stretch, double grade, bool sudden, RandomGenerator& rng,
               std::vector<double>& rise_m) {
  const double curve_m = sudden ? 0.0 : 3.0;
  const double level_m = std::max(1.0, curve_m);
  const double left_m = stretch.to_m - stretch.from_m - (stretch.to_end ? 1.0 : 3.0) * level_m;
  const double ramp_m = left_m * (stretch.to_end ? rng.between(0.5, 1.0) : rng.between(0.3, 0.5));
  ProfileWriter writer(stretch.from_m);
  writer.go(ramp_m, grade, curve_m);
  writer.go(level_m, 0.0, curve_m);
  if (!stretch.to_end) {
    writer.go(level_m, 0.0, 0.0);
    writer.go(ramp_m, -grade, curve_m);
    writer.go(level_m, 0.0, curve_m);
  }
  const std::vector<double> profile = writer.take();
  rise_m.insert(rise_m.end(), profile.begin(), profile.end());
}

/// A step over the whole width, and one back, unless the tunnel ends.
void add_sill(const FreeStretch& stretch, double height_m, RandomGenerator& rng,
              std::vector<double>& rise_m) {
  const double length_m = stretch.to_m - stretch.from_m;
  const double up_m = stretch.from_m + rng.between(0.1, 0.4) * length_m;
  rise_m.insert(rise_m.end(), {up_m, 0.0, up_m + kStepWidth, height_m});
  if (stretch.to_end) return;
  const double down_m = stretch.from_m + rng.between(0.6, 0.9) * length_m;
  rise_m.insert(rise_m.end(), {down_m, height_m, down_m + kStepWidth, 0.0});
}

/// Gives a stretch a ramp, a hump or a sill. The total grade stays below `kRandomGradeMax`, or
/// exceeds `kTooSteepMin`. Returns whether there is room for one.
bool add_rise(const FreeStretch& stretch, const TunnelLine& line, bool too_steep,
              const WorldDescription& mine, RandomGenerator& rng, std::vector<double>& rise_m) {
  const double seam = grade_along(line, stretch.from_m, stretch.to_m, mine.heights);
  if (too_steep) {
    add_ramps(stretch, rng.side() * (seam + rng.between(kTooSteepMin, kTooSteepMin + 0.08)), true,
              rng, rise_m);
    return true;
  }
  if (rng.chance(0.25)) {
    add_sill(stretch, rng.side() * rng.between(0.06, 0.13), rng, rise_m);
    return true;
  }
  const double left = kRandomGradeMax - seam;
  if (left < 0.06) return false;
  add_ramps(stretch, rng.side() * rng.between(0.05, left), rng.chance(0.4), rng, rise_m);
  return true;
}

/// Rises of tunnels, and the stretches that have them.
std::vector<FreeStretch> add_rises(const std::vector<TunnelLine>& tunnels, RandomGenerator& rng,
                                   WorldDescription& mine) {
  std::vector<FreeStretch> stretches = free_stretches(tunnels, mine.plan.tunnels.size());
  std::vector<FreeStretch> used;
  bool too_steep = rng.chance(kTooSteepShare);
  // From the last stretch on, so that what is too steep cuts off little of the mine.
  for (auto stretch = stretches.rbegin(); stretch != stretches.rend(); ++stretch) {
    const bool steep_here = too_steep && stretch->to_end;
    if (!steep_here && !rng.chance(kStretchShare)) continue;
    // A long stretch has a rise in a part of it.
    stretch->to_m = stretch->to_end
                        ? stretch->to_m
                        : std::min(stretch->to_m, stretch->from_m + rng.between(20.0, 60.0));
    if (stretch->to_end) {
      stretch->from_m = std::max(stretch->from_m, stretch->to_m - rng.between(kStretchMin, 50.0));
    }
    used.push_back(*stretch);
    if (steep_here) too_steep = false;
    std::vector<double> rise_m;
    if (!add_rise(*stretch, tunnels[stretch->tunnel], steep_here, mine, rng, rise_m)) {
      used.pop_back();
      continue;
    }
    TunnelDescription& tunnel = mine.plan.tunnels[stretch->tunnel];
    tunnel.rise_grade = "sudden";  // its points are dense where it is smooth
    tunnel.rise_m.insert(tunnel.rise_m.begin(), rise_m.begin(), rise_m.end());
  }
  return used;
}

/// Removes the props of a list of which `is_wrong` holds for their extent along their tunnel.
template <class Prop, class Extent, class IsWrong>
void remove_props(std::vector<Prop>& props, const Extent& extent, const IsWrong& is_wrong) {
  std::erase_if(props, [&](const Prop& prop) {
    const std::pair<double, double> along = extent(prop);
    return is_wrong(prop.tunnel, along.first, along.second);
  });
}

void remove_unfit_props(const std::vector<TunnelLine>& tunnels,
                        const std::vector<FreeStretch>& rises, const HeightsDescription& heights,
                        PropDescriptions& props) {
  const auto on_rise = [&](const std::string& name, double from_m, double to_m) {
    return std::any_of(rises.begin(), rises.end(), [&](const FreeStretch& rise) {
      return tunnels[rise.tunnel].name == name && to_m > rise.from_m - 1.0 &&
             from_m < rise.to_m + 1.0;
    });
  };
  const auto steeper_than = [&](double grade) {
    return [&, grade](const std::string& name, double from_m, double to_m) {
      return on_rise(name, from_m, to_m) ||
             grade_along(find_tunnel(tunnels, name, "a prop"), from_m, to_m, heights) > grade;
    };
  };
  const auto section = [](const auto& prop) { return std::pair(prop.from_m, prop.to_m); };
  const auto around = [](const auto& prop) { return std::pair(prop.at_m - 2.5, prop.at_m + 2.5); };
  remove_props(props.posts, section, on_rise);
  remove_props(props.cribs, around, on_rise);
  remove_props(props.rubble, around, on_rise);
  remove_props(props.beams, around, on_rise);
  remove_props(props.low_roofs, section, on_rise);
  remove_props(props.pits, around, on_rise);
  remove_props(props.mud, around, on_rise);
  remove_props(props.cars, around, steeper_than(kCarGradeMax));
  remove_props(props.water, section, steeper_than(kWaterGradeMax));
}

}  // namespace

void add_relief(WorldDescription& mine, RandomGenerator& rng) {
  const std::vector<TunnelLine> tunnels = tunnel_lines(mine.plan);
  add_seam(tunnels, random_character(rng), rng, mine.heights);
  const std::vector<FreeStretch> rises = add_rises(tunnels, rng, mine);
  remove_unfit_props(tunnels, rises, mine.heights, mine.props);
}

}  // namespace adit
