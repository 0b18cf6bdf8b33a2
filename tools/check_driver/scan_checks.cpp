// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check_driver/scan_checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include <fmt/format.h>

namespace adit {
namespace {

using Verdict = CheckResult::Verdict;

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr double kNearestM = 0.05;

bool is_return(float range_m, double range_max_m) {
  return std::isfinite(range_m) && range_m > kNearestM && range_m < range_max_m;
}

CheckResult check_frame(const LaserScan& scan) {
  constexpr double kMiddleMaxDeg = 2.0;
  const double first_deg = scan.angle_min_rad * kDegPerRad;
  const double step_deg = scan.angle_step_rad * kDegPerRad;
  const double last_deg = first_deg + step_deg * static_cast<double>(scan.ranges_m.size() - 1);
  const std::string text = fmt::format("{} beams from {:.2f}° to {:.2f}°, {:.3f}° apart",
                                       scan.ranges_m.size(), first_deg, last_deg, step_deg);
  if (step_deg * static_cast<double>(scan.ranges_m.size()) > 361.0) {
    return {Verdict::kBad, "frame",
            fmt::format("{}: more than a turn; rad0 and radstep are in radians", text)};
  }
  if (std::abs(first_deg + last_deg) > 2.0 * kMiddleMaxDeg) {
    return {Verdict::kBad, "frame",
            fmt::format("{}: the x axis of a laser points along its middle beam, so that rad0 is "
                        "minus half of the field of view (docs/frames.md)",
                        text)};
  }
  return {Verdict::kGood, "frame", text};
}

CheckResult check_beams(const std::vector<LaserScan>& scans) {
  const auto others = std::ranges::count_if(scans, [&](const LaserScan& scan) {
    return scan.ranges_m.size() != scans.front().ranges_m.size() ||
           scan.angle_min_rad != scans.front().angle_min_rad ||
           scan.angle_step_rad != scans.front().angle_step_rad;
  });
  if (others == 0) return {Verdict::kGood, "beams", "the same in every scan"};
  return {Verdict::kBad, "beams",
          fmt::format("{} of {} scans have other beams than the first: publish whole scans of one "
                      "setting",
                      others, scans.size())};
}

CheckResult check_ranges(const std::vector<LaserScan>& scans, double range_max_m) {
  constexpr double kReturnsMin = 0.1;
  constexpr double kUnitsMedianM = 100.0;
  std::vector<float> returns;
  std::size_t beams = 0;
  std::size_t absent = 0;
  for (const LaserScan& scan : scans) {
    for (const float range : scan.ranges_m) {
      ++beams;
      if (is_return(range, range_max_m)) returns.push_back(range);
      if (std::isfinite(range) && range > kUnitsMedianM) ++absent;
    }
  }
  const double share = static_cast<double>(returns.size()) / static_cast<double>(beams);
  if (share < kReturnsMin && absent > beams / 2) {
    return {Verdict::kBad, "ranges",
            fmt::format("{:.0f} % of the ranges are above {} : publish metres, not millimetres",
                        100.0 * static_cast<double>(absent) / static_cast<double>(beams),
                        kUnitsMedianM)};
  }
  if (share < kReturnsMin) {
    return {Verdict::kBad, "ranges",
            fmt::format("{:.0f} % of the beams return a range below range_max_m, {} m: is the "
                        "window covered, the unit metres, and range_max_m right?",
                        100.0 * share, range_max_m)};
  }
  std::ranges::nth_element(returns,
                           returns.begin() + static_cast<std::ptrdiff_t>(returns.size() / 2));
  return {Verdict::kGood, "ranges",
          fmt::format("{:.0f} % of the beams return, half of them from within {:.2f} m",
                      100.0 * share, returns[returns.size() / 2])};
}

/// The noise of a laser makes every scan another one.
CheckResult check_frozen(const std::vector<LaserScan>& scans) {
  constexpr double kRepeatedMax = 0.2;
  std::size_t repeated = 0;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    if (std::ranges::equal(scans[i].ranges_m, scans[i - 1].ranges_m, [](float a, float b) {
          return a == b || (std::isnan(a) && std::isnan(b));
        })) {
      ++repeated;
    }
  }
  const double share = static_cast<double>(repeated) / static_cast<double>(scans.size());
  const std::string text =
      fmt::format("{} of {} scans repeat the one before", repeated, scans.size());
  if (share <= kRepeatedMax) return {Verdict::kGood, "repetition", text};
  return {
      Verdict::kBad, "repetition",
      fmt::format("{}: publish each scan once, and nothing while the device sends nothing", text)};
}

/// Mean distance between the ranges of neighbours, each at most a metre.
double roughness(const std::vector<float>& ranges, double range_max_m) {
  double sum = 0.0;
  int pairs = 0;
  for (std::size_t i = 1; i < ranges.size(); ++i) {
    if (!is_return(ranges[i], range_max_m) || !is_return(ranges[i - 1], range_max_m)) continue;
    sum += std::min(1.0, std::abs(static_cast<double>(ranges[i]) - ranges[i - 1]));
    ++pairs;
  }
  return pairs > 0 ? sum / pairs : 0.0;
}

/// The first half between the second: as two turns that were appended instead of interlaced.
std::vector<float> interlaced(const std::vector<float>& ranges) {
  const std::size_t half = (ranges.size() + 1) / 2;
  std::vector<float> other;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    other.push_back(ranges[i % 2 == 0 ? i / 2 : half + i / 2]);
  }
  return other;
}

std::vector<float> pairs_swapped(std::vector<float> ranges) {
  for (std::size_t i = 0; i + 1 < ranges.size(); i += 2) std::swap(ranges[i], ranges[i + 1]);
  return ranges;
}

/// Walls are smooth: in the right order neighbours differ less than in another one.
CheckResult check_beam_order(const std::vector<LaserScan>& scans, double range_max_m) {
  constexpr double kSmootherShare = 0.7;
  double as_is = 0.0;
  double as_interlaced = 0.0;
  double as_swapped = 0.0;
  for (const LaserScan& scan : scans) {
    as_is += roughness(scan.ranges_m, range_max_m);
    as_interlaced += roughness(interlaced(scan.ranges_m), range_max_m);
    as_swapped += roughness(pairs_swapped(scan.ranges_m), range_max_m);
  }
  if (as_interlaced < kSmootherShare * as_is) {
    return {Verdict::kBad, "neighbours",
            "walls are smoother if the beams of the second half are put between those of the "
            "first: the scan has two turns that must be interlaced"};
  }
  if (as_swapped < kSmootherShare * as_is) {
    return {Verdict::kBad, "neighbours",
            "walls are smoother if each second beam is exchanged with the one before: publish "
            "beams by increasing bearing"};
  }
  return {Verdict::kGood, "neighbours",
          fmt::format("beside each other differ by {:.3f} m",
                      as_is / static_cast<double>(scans.size()))};
}

std::optional<double> yaw_at(const YawHistory& yaw, std::int64_t utime) {
  const auto next = std::ranges::lower_bound(yaw, utime, {}, &YawHistory::value_type::first);
  if (next == yaw.begin() || next == yaw.end()) return std::nullopt;
  const auto before = next - 1;
  const double share = static_cast<double>(utime - before->first) /
                       static_cast<double>(std::max<std::int64_t>(1, next->first - before->first));
  return before->second + share * (next->second - before->second);
}

/// By how many beams the second scan is turned to the left against the first.
int turned_beams(const LaserScan& first, const LaserScan& second) {
  constexpr double kTurnMaxRad = 0.4;
  constexpr double kRangeMaxM = 60.0;
  const int beams = static_cast<int>(first.ranges_m.size());
  const int most = std::min(beams / 3, static_cast<int>(kTurnMaxRad / first.angle_step_rad));
  int best = 0;
  double best_cost = 1e9;
  for (int shift = -most; shift <= most; ++shift) {
    double cost = 0.0;
    int pairs = 0;
    for (int i = std::max(0, -shift); i < std::min(beams, beams - shift); ++i) {
      const int turned = i + shift;
      const float before = first.ranges_m[static_cast<std::size_t>(turned)];
      const float after = second.ranges_m[static_cast<std::size_t>(i)];
      if (!is_return(before, kRangeMaxM) || !is_return(after, kRangeMaxM)) continue;
      cost += std::min(0.5, std::abs(static_cast<double>(before) - after));
      ++pairs;
    }
    if (pairs < beams / 5 || cost / pairs >= best_cost) continue;
    best_cost = cost / pairs;
    best = shift;
  }
  return best;
}

}  // namespace

CheckResults check_scans(const std::vector<LaserScan>& scans, double range_max_m) {
  return {check_frame(scans.front()), check_beams(scans), check_ranges(scans, range_max_m),
          check_frozen(scans), check_beam_order(scans, range_max_m)};
}

CheckResult check_turn(const std::vector<LaserScan>& scans, const YawHistory& yaw) {
  constexpr std::int64_t kApartUs = 200'000;
  constexpr double kTurnMinRad = 0.03;
  constexpr double kTurnMaxRad = 0.3;
  constexpr double kTurnedMinRad = 0.3;  // in all
  constexpr double kAgreementMin = 0.5;
  double product = 0.0;
  double square = 0.0;
  double turned_rad = 0.0;
  const LaserScan* first = nullptr;
  for (const LaserScan& scan : scans) {
    if (first == nullptr || scan.ranges_m.size() != first->ranges_m.size()) first = &scan;
    if (scan.utime - first->utime < kApartUs) continue;
    const auto from = yaw_at(yaw, first->utime);
    const auto to = yaw_at(yaw, scan.utime);
    const double turn_rad = from && to ? *to - *from : 0.0;
    if (std::abs(turn_rad) > kTurnMinRad && std::abs(turn_rad) < kTurnMaxRad) {
      product += turn_rad * turned_beams(*first, scan) * scan.angle_step_rad;
      square += turn_rad * turn_rad;
      turned_rad += std::abs(turn_rad);
    }
    first = &scan;
  }
  if (turned_rad < kTurnedMinRad) {
    return {Verdict::kUnknown, "sign",
            "not checked: turn the vehicle on the spot while this runs, with IMU or "
            "WHEEL_ODOMETRY"};
  }
  const double agreement = product / square;
  if (agreement > kAgreementMin) {
    return {Verdict::kGood, "sign",
            fmt::format("scans turn with the vehicle, by {:.2f} of its rotation", agreement)};
  }
  if (agreement < -kAgreementMin) {
    return {Verdict::kBad, "sign",
            "scans turn against the vehicle: publish beams counter-clockwise (a laser upside down "
            "has them clockwise), or the yaw of the other sensor has the wrong sign"};
  }
  return {Verdict::kUnknown, "sign",
          fmt::format("not known: scans turn by {:.2f} of the rotation of the vehicle", agreement)};
}

}  // namespace adit
