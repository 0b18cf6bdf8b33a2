// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/sensing/motion_correction.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "common/geometry/pose2.hpp"
#include "common/sensing/range_on_line.hpp"

namespace adit {
namespace {

constexpr double kLongS = 0.03;
constexpr double kSameSurface = 0.03;  // of the range, that of the next beam differs by
constexpr double kSameChange = 0.01;   // and by which two such differences differ
constexpr double kStillM = 5e-4;       // of motion during a scan, negligible
constexpr double kFarM = 10.0;         // of ends that a turn moves
constexpr double kFullTurn = 2.0 * std::numbers::pi;

/// A measured beam, seen from where the laser was at the first one.
struct SeenBeam {
  double bearing_rad = 0.0;
  double range_m = 0.0;
  std::int32_t beam = 0;
};

/// A reading without a return keeps its range and turns with the body.
SeenBeam seen_beam(const LaserScan& scan, const LaserMount& mount, std::int32_t beam,
                   const Pose2& T_first_laser) {
  const double range_m = scan.ranges_m[static_cast<std::size_t>(beam)];
  const double bearing = scan.angle_min_rad + beam * scan.angle_step_rad;
  const bool is_return = range_m >= mount.range_min_m && range_m < mount.range_max_m;
  if (!is_return) return {bearing + T_first_laser.theta, range_m, beam};
  const Eigen::Vector2d p =
      T_first_laser * Eigen::Vector2d(range_m * std::cos(bearing), range_m * std::sin(bearing));
  // The same turn as before: a scan may cover more than one.
  const double turned = wrap_angle(std::atan2(p.y(), p.x()) - bearing);
  return {bearing + turned, p.norm(), beam};
}

/// Range at a bearing of the straight line between two ends.
double on_line_m(const SeenBeam& a, const SeenBeam& b, double bearing_rad) {
  const double before = bearing_rad - a.bearing_rad;
  const double after = b.bearing_rad - bearing_rad;
  if (before + after < 1e-9) return a.range_m;
  return range_on_line_m(a.range_m, before, b.range_m, after);
}

/// Whether both ends of beams lie on one surface: their ranges hardly differ, or differ as those of
/// the beam before or after them do, along a wall that the beams graze (1 / r is then a sinusoid of
/// the bearing).
class Surfaces {
 public:
  Surfaces(const std::vector<SeenBeam>& seen, const LaserMount& mount, double step_rad)
      : seen_(seen), mount_(mount), spacing_max_rad_(2.0 * step_rad) {}

  [[nodiscard]] bool joins_next(std::size_t i) const {
    if (!is_pair(i)) return false;
    const double change = inverse(i + 1) - inverse(i);
    if (std::abs(change) < kSameSurface * inverse(i)) return true;
    const bool as_before =
        i > 0 && is_pair(i - 1) && is_alike(change, inverse(i) - inverse(i - 1), i);
    return as_before || (is_pair(i + 1) && is_alike(change, inverse(i + 2) - inverse(i + 1), i));
  }

 private:
  [[nodiscard]] double inverse(std::size_t i) const { return 1.0 / seen_[i].range_m; }
  [[nodiscard]] bool is_return(std::size_t i) const {
    return seen_[i].range_m >= mount_.range_min_m && seen_[i].range_m < mount_.range_max_m;
  }
  [[nodiscard]] bool is_pair(std::size_t i) const {
    return i + 1 < seen_.size() && is_return(i) && is_return(i + 1) &&
           seen_[i + 1].bearing_rad - seen_[i].bearing_rad < spacing_max_rad_;
  }
  [[nodiscard]] bool is_alike(double change, double other, std::size_t i) const {
    return std::abs(change - other) < kSameChange * inverse(i);
  }

  const std::vector<SeenBeam>& seen_;
  const LaserMount& mount_;
  double spacing_max_rad_;
};

}  // namespace

StillScan without_motion(const LaserScan& scan, const LaserMount& mount,
                         const Eigen::Vector3d& velocity) {
  const auto beams = static_cast<std::int32_t>(scan.ranges_m.size());
  const double last_s = mount.timing.last_beam_time_s(beams, scan.angle_step_rad);
  const double moved_m = last_s * (velocity.head<2>().norm() + kFarM * std::abs(velocity.z()));
  const bool is_valid = velocity.allFinite() && scan.angle_step_rad > 0.0;
  if (!is_valid || last_s <= kLongS || moved_m < kStillM) return {scan, {}};
  std::vector<SeenBeam> seen;
  for (std::int32_t beam = 0; beam < beams; ++beam) {
    const double time_s = mount.timing.beam_time_s(beam, beams, scan.angle_step_rad);
    const Pose2 T_first_body{time_s * velocity.x(), time_s * velocity.y(), time_s * velocity.z()};
    const Pose2 T_first_laser = mount.T_body_laser.inverse() * T_first_body * mount.T_body_laser;
    const SeenBeam moved = seen_beam(scan, mount, beam, T_first_laser);
    seen.push_back(moved);
    // Those beside the seam of a full turn show it on the other side, too.
    if (beam < beams / 8) seen.push_back({moved.bearing_rad + kFullTurn, moved.range_m, beam});
    if (beam >= beams - beams / 8)
      seen.push_back({moved.bearing_rad - kFullTurn, moved.range_m, beam});
  }
  std::ranges::sort(seen, {}, &SeenBeam::bearing_rad);
  const Surfaces surfaces(seen, mount, scan.angle_step_rad);
  StillScan still{scan, std::vector<std::int32_t>(scan.ranges_m.size(), -1)};
  for (std::int32_t beam = 0; beam < beams; ++beam) {
    const double bearing = scan.angle_min_rad + beam * scan.angle_step_rad;
    float& range_m = still.scan.ranges_m[static_cast<std::size_t>(beam)];
    range_m = std::numeric_limits<float>::quiet_NaN();
    const auto next = std::ranges::lower_bound(seen, bearing, {}, &SeenBeam::bearing_rad);
    if (next == seen.begin() || next == seen.end()) continue;
    const SeenBeam& before = *std::prev(next);
    const SeenBeam& after = *next;
    const bool is_before = bearing - before.bearing_rad < after.bearing_rad - bearing;
    const SeenBeam& nearest = is_before ? before : after;
    if (std::abs(nearest.bearing_rad - bearing) > scan.angle_step_rad) continue;
    still.beam_of[static_cast<std::size_t>(beam)] = nearest.beam;
    const bool joined = surfaces.joins_next(static_cast<std::size_t>(next - seen.begin()) - 1);
    range_m = static_cast<float>(joined ? on_line_m(before, after, bearing) : nearest.range_m);
  }
  return still;
}

}  // namespace adit
