// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check_driver/lidar_checks.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "common/geometry/order_statistics.hpp"

namespace adit {
namespace {

using Verdict = CheckResult::Verdict;

constexpr double kDegrees = 180.0 / std::numbers::pi;

double median_range_m(const LidarRevolution& revolution, std::size_t ring) {
  std::vector<double> ranges_m;
  for (std::size_t column = 0; column < revolution.columns.size(); ++column) {
    const double range_m = revolution.range_m(column, ring);
    if (std::isfinite(range_m) && range_m > 0.0) ranges_m.push_back(range_m);
  }
  return median(std::move(ranges_m));
}

/// A value of each revolution.
template <class Value>
std::vector<double> each(const std::vector<LidarTurn>& turns, const Value& value) {
  std::vector<double> values;
  for (const LidarTurn& turn : turns) values.push_back(value(turn));
  return values;
}

double sum(const std::vector<LidarTurn>& turns, std::size_t LidarTurn::*count) {
  double sum = 0.0;
  for (const LidarTurn& turn : turns) sum += static_cast<double>(turn.*count);
  return sum;
}

CheckResult check_turns(const std::vector<LidarTurn>& turns) {
  constexpr double kWholeShare = 0.1;
  const double turned = median(each(turns, [](const LidarTurn& t) { return t.turned_rad; }));
  const double step = median(each(turns, [](const LidarTurn& t) { return t.step_rad; }));
  const std::string text =
      fmt::format("{:.0f}° {}, in steps of {:.2f}°", kDegrees * std::abs(turned),
                  turned < 0.0 ? "clockwise" : "counter-clockwise", kDegrees * step);
  if (std::abs(std::abs(turned) / (2.0 * std::numbers::pi) - 1.0) > kWholeShare) {
    return {Verdict::kBad, "revolution",
            text + ": publish one whole turn under one utime, and azimuths in radians"};
  }
  const double backwards = std::ranges::max(turns, {}, &LidarTurn::backwards_share).backwards_share;
  if (backwards > 0.01) {
    return {Verdict::kBad, "revolution",
            fmt::format("{}, but {:.0f} % of the steps of one go back: publish the columns in "
                        "order of time",
                        text, 100.0 * backwards)};
  }
  return {Verdict::kGood, "revolution", text};
}

/// The level view, which the stages use as the scan of a planar laser, lies between two rings.
CheckResult check_rings(const std::vector<LidarTurn>& turns) {
  constexpr double kLevelMaxRad = 0.06;
  const auto& elevations = turns.back().elevations_rad;
  const auto nearest = std::ranges::min(elevations, {}, [](double e) { return std::abs(e); });
  const std::string text = fmt::format("{}, {:.1f}° to {:.1f}°", elevations.size(),
                                       kDegrees * elevations.front(), kDegrees * elevations.back());
  if (elevations.back() > std::numbers::pi / 2.0 || elevations.front() < -std::numbers::pi / 2.0)
    return {Verdict::kBad, "rings", text + ": publish radians"};
  if (std::abs(nearest) > kLevelMaxRad)
    return {Verdict::kBad, "rings", text + ": none of them is level, which localization needs"};
  return {Verdict::kGood, "rings", text};
}

CheckResult check_returns(const std::vector<LidarTurn>& turns) {
  constexpr double kReturnsMin = 0.2;
  constexpr double kMissingMax = 0.1;
  const double readings = std::max(1.0, sum(turns, &LidarTurn::readings));
  const double returns = sum(turns, &LidarTurn::returns) / readings;
  const double missing = sum(turns, &LidarTurn::missing) / readings;
  const std::string text = fmt::format("{:.0f} % of the beams, {:.1f} % were not measured",
                                       100.0 * returns, 100.0 * missing);
  if (missing > kMissingMax)
    return {Verdict::kBad, "returns", text + ": datagrams are lost; look for a busy computer"};
  if (returns < kReturnsMin)
    return {Verdict::kBad, "returns", text + ": is the view blocked, or the range limited?"};
  return {Verdict::kGood, "returns", text};
}

CheckResult check_ranges(const std::vector<LidarTurn>& turns) {
  constexpr double kFarM = 0.5;
  double nearest_m = std::numeric_limits<double>::infinity();
  double farthest_m = 0.0;
  for (const LidarTurn& turn : turns) {
    if (turn.returns == 0) continue;
    nearest_m = std::min(nearest_m, turn.nearest_m);
    farthest_m = std::max(farthest_m, turn.farthest_m);
  }
  if (farthest_m == 0.0) return {Verdict::kBad, "ranges", "there are no returns"};
  const std::string text = fmt::format("{:.2f} to {:.2f} m", nearest_m, farthest_m);
  if (farthest_m < kFarM)
    return {Verdict::kBad, "ranges", text + ": publish metres, as multiples of range_unit_m"};
  return {Verdict::kGood, "ranges", text};
}

/// On a vehicle on the ground the lowest ring meets it nearer than the highest one meets the roof,
/// but for a low one.
CheckResult check_upright(const std::vector<LidarTurn>& turns) {
  const double below_m = median(each(turns, [](const LidarTurn& t) { return t.below_m; }));
  const double above_m = median(each(turns, [](const LidarTurn& t) { return t.above_m; }));
  const std::string text = fmt::format(
      "the lowest ring meets something {:.2f} m away, the highest "
      "one {:.2f} m",
      below_m, above_m);
  if (below_m > 0.0 && (above_m == 0.0 || below_m < above_m))
    return {Verdict::kGood, "upright", text};
  return {Verdict::kUnknown, "upright",
          text + ": not checked; on open ground the lowest one is the nearer"};
}

CheckResult check_repetition(const std::vector<LidarTurn>& turns) {
  std::size_t repeated = 0;
  for (std::size_t i = 1; i < turns.size(); ++i)
    repeated += turns[i].hash == turns[i - 1].hash ? 1 : 0;
  const std::string text =
      fmt::format("{} of {} revolutions repeat the one before", repeated, turns.size());
  if (repeated == 0) return {Verdict::kGood, "repetition", text};
  return {Verdict::kBad, "repetition", text + ": publish each revolution once"};
}

}  // namespace

LidarTurn::LidarTurn(const LidarRevolution& revolution)
    : readings(revolution.ranges_m.size()), nearest_m(std::numeric_limits<double>::infinity()) {
  for (const LidarRing& ring : revolution.rings) elevations_rad.push_back(ring.elevation_rad);
  std::vector<double> steps;
  std::size_t forwards = 0;
  for (std::size_t i = 1; i < revolution.columns.size(); ++i) {
    const double step =
        std::remainder(static_cast<double>(revolution.columns[i].azimuth_rad) -
                           static_cast<double>(revolution.columns[i - 1].azimuth_rad),
                       2.0 * std::numbers::pi);
    turned_rad += step;
    forwards += step > 0.0 ? 1 : 0;
    steps.push_back(std::abs(step));
  }
  if (!steps.empty()) {
    const std::size_t backwards = std::min(forwards, steps.size() - forwards);
    backwards_share = static_cast<double>(backwards) / static_cast<double>(steps.size());
  }
  step_rad = median(std::move(steps));
  for (const float range_m : revolution.ranges_m) {
    hash = hash * 31U + std::hash<float>{}(range_m);
    if (std::isnan(range_m)) ++missing;
    if (!std::isfinite(range_m)) continue;
    ++returns;
    nearest_m = std::min(nearest_m, static_cast<double>(range_m));
    farthest_m = std::max(farthest_m, static_cast<double>(range_m));
  }
  if (returns == 0) nearest_m = 0.0;
  if (revolution.rings.empty()) return;
  below_m = median_range_m(revolution, 0);
  above_m = median_range_m(revolution, revolution.rings.size() - 1);
}

CheckResults check_lidar(const std::vector<LidarTurn>& turns) {
  return {check_turns(turns),  check_rings(turns),   check_returns(turns),
          check_ranges(turns), check_upright(turns), check_repetition(turns)};
}

}  // namespace adit
