// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/grade_tunnel.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "common/config/number_text.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr const char* kGradePrefix = "grade:";
constexpr double kGradeMax = 100.0;     // [%]
constexpr double kTunnelLength = 90.0;  // [m]
constexpr double kGradeStart = 20.0;    // [m]
constexpr double kOverMin = 20.0;       // [m]
constexpr double kOverMax = 50.0;       // [m]
constexpr double kCurveLength = 8.0;    // over which a smooth change of slope extends [m]
constexpr double kKnotEvery = 1.0;      // of the profile [m]

[[noreturn]] void fail_grade(const std::string& name, const std::string& problem) {
  throw std::runtime_error(
      fmt::format("world {}: {}; an example with all parts is grade:-12,sudden,rough,30m",
                  quote(name), problem));
}

/// `30m`, if it is a length that the stretch may have.
std::optional<double> length_in(const std::string& text) {
  if (!text.ends_with("m")) return std::nullopt;
  const auto length = parse_number<double>(std::string_view(text).substr(0, text.size() - 1));
  if (!length || !(*length >= kOverMin && *length <= kOverMax)) return std::nullopt;
  return length;
}

/// Height above the start of the stretch at a fraction of a grade of 1: linear, or with a parabola
/// of kCurveLength at each end, as the vertical curves of a road.
double rise_m(double s_m, const GradeTunnelParams& params) {
  if (params.sudden) return s_m;
  const double in_start = std::min(s_m, kCurveLength);
  const double in_end = std::max(0.0, s_m - (params.over_m - kCurveLength));
  return in_start * in_start / (2.0 * kCurveLength) +
         (std::clamp(s_m, kCurveLength, params.over_m) - kCurveLength) -
         in_end * in_end / (2.0 * kCurveLength);
}

std::vector<double> grade_profile(const GradeTunnelParams& params) {
  const int knots = params.sudden ? 1 : static_cast<int>(std::ceil(params.over_m / kKnotEvery));
  std::vector<double> profile{0.0, 0.0};
  for (int i = 0; i <= knots; ++i) {
    const double s_m = params.over_m * i / knots;
    profile.push_back(kGradeStart + s_m);
    profile.push_back(params.grade_percent / 100.0 * rise_m(s_m, params));
  }
  profile.push_back(kTunnelLength);
  profile.push_back(profile[profile.size() - 2]);
  return profile;
}

}  // namespace

std::optional<GradeTunnelParams> parse_grade_tunnel(const std::string& name) {
  if (!name.starts_with(kGradePrefix)) return std::nullopt;
  std::istringstream parts(name.substr(std::string(kGradePrefix).size()));
  GradeTunnelParams params;
  std::string part;
  std::getline(parts, part, ',');
  const auto percent = parse_number<double>(part);
  if (!percent || !(std::abs(*percent) <= kGradeMax)) {
    fail_grade(name, fmt::format("{} is not a grade from -100 to 100 percent", quote(part)));
  }
  params.grade_percent = *percent;
  while (std::getline(parts, part, ',')) {
    if (part == "sudden") {
      params.sudden = true;
    } else if (part == "rough") {
      params.rough = true;
    } else if (const auto length = length_in(part)) {
      params.over_m = *length;
    } else {
      fail_grade(name, fmt::format("{} is neither sudden, nor rough, nor 20m to 50m", quote(part)));
    }
  }
  return params;
}

WorldDescription grade_tunnel(const GradeTunnelParams& params, int seed) {
  WorldDescription description;
  description.name = fmt::format("grade_{}{}{}_{}m", number_text(params.grade_percent),
                                 params.sudden ? "_sudden" : "", params.rough ? "_rough" : "",
                                 number_text(params.over_m));
  description.seed = seed;
  description.T_world_start = {3.0, 0.0, 0.0};
  description.plan.tunnels = {{"main", {0.0, 0.0, kTunnelLength, 0.0}, 3.0, true}};
  description.heights.profile_m = grade_profile(params);
  description.heights.grade = params.sudden ? "sudden" : "smooth";
  description.heights.floor_relief = {.height_m = params.rough ? 0.08 : 0.02, .length_m = 2.5};
  return description;
}

}  // namespace adit
