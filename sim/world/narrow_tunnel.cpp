// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/narrow_tunnel.hpp"

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include <Eigen/Core>
#include <fmt/format.h>

#include "common/config/number_text.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr const char* kNarrowPrefix = "narrow:";
constexpr double kWidthMin = 1.2;                      // [m]
constexpr double kWidthMax = 3.0;                      // [m]
constexpr double kWide = 3.0;                          // width at both ends [m]
constexpr double kBeforeLength = 12.0;                 // [m]
constexpr double kNarrowLength = 15.0;                 // [m]
constexpr double kAfterLength = 10.0;                  // [m]
constexpr double kNeckLength = 4.0;                    // [m]
constexpr double kBesideNeck = 0.3;                    // [m]
constexpr double kBendRadius = 20.0;                   // [m]
constexpr double kBendAngle = std::numbers::pi / 6.0;  // [rad]
constexpr int kBendSteps = 15;
constexpr double kWallRelief = 0.01;  // [m]

[[noreturn]] void fail_narrow(const std::string& name, const std::string& problem) {
  throw std::runtime_error(
      fmt::format("world {}: {}; an example is narrow:1.5,bent", quote(name), problem));
}

/// A centre line under construction.
class CentreLine {
 public:
  explicit CentreLine(const Eigen::Vector2d& start)
      : points_m_{start.x(), start.y()}, end_(start) {}

  void ahead(double length_m) {
    end_ += length_m * Eigen::Vector2d(std::cos(heading_rad_), std::sin(heading_rad_));
    points_m_.push_back(end_.x());
    points_m_.push_back(end_.y());
  }
  void bend(double angle_rad) {
    const double half_rad = angle_rad / kBendSteps / 2.0;
    for (int i = 0; i < kBendSteps; ++i) {
      heading_rad_ += half_rad;
      ahead(2.0 * kBendRadius * std::sin(half_rad));
      heading_rad_ += half_rad;
    }
  }
  /// The line so far; the next one begins at its end.
  std::vector<double> take() {
    std::vector<double> taken{end_.x(), end_.y()};
    taken.swap(points_m_);
    return taken;
  }

 private:
  std::vector<double> points_m_;
  Eigen::Vector2d end_;
  double heading_rad_ = 0.0;
};

}  // namespace

std::optional<NarrowTunnelParams> parse_narrow_tunnel(const std::string& name) {
  if (!name.starts_with(kNarrowPrefix)) return std::nullopt;
  std::istringstream parts(name.substr(std::string(kNarrowPrefix).size()));
  NarrowTunnelParams params;
  std::string part;
  std::getline(parts, part, ',');
  const auto width = parse_number<double>(part);
  if (!width || !(*width >= kWidthMin && *width <= kWidthMax)) {
    fail_narrow(name, fmt::format("{} is not a width from 1.2 to 3 m", quote(part)));
  }
  params.width_m = *width;
  while (std::getline(parts, part, ',')) {
    if (part == "straight") {
      params.shape = NarrowTunnelParams::Shape::kStraight;
    } else if (part == "bent") {
      params.shape = NarrowTunnelParams::Shape::kBent;
    } else if (part == "necked") {
      params.shape = NarrowTunnelParams::Shape::kNecked;
    } else {
      fail_narrow(name, fmt::format("{} is neither straight, nor bent, nor necked", quote(part)));
    }
  }
  return params;
}

WorldDescription narrow_tunnel(const NarrowTunnelParams& params, int seed) {
  using Shape = NarrowTunnelParams::Shape;
  const bool bent = params.shape == Shape::kBent;
  const bool necked = params.shape == Shape::kNecked;
  const double width_m = params.width_m + 2.0 * kWallRelief;
  WorldDescription description;
  description.name = fmt::format("narrow_{}{}", number_text(params.width_m),
                                 bent     ? "_bent"
                                 : necked ? "_necked"
                                          : "");
  description.seed = seed;
  description.T_world_start = {3.0, 0.0, 0.0};
  auto& tunnels = description.plan.tunnels;
  CentreLine line({0.0, 0.0});
  line.ahead(kBeforeLength);
  tunnels.push_back({"before", line.take(), kWide, true});
  if (necked) {
    const double beside_m = (kNarrowLength - kNeckLength) / 2.0;
    line.ahead(beside_m);
    tunnels.push_back({"narrow_before", line.take(), width_m + kBesideNeck});
    line.ahead(kNeckLength);
    tunnels.push_back({"neck", line.take(), width_m});
    line.ahead(beside_m);
    tunnels.push_back({"narrow_after", line.take(), width_m + kBesideNeck});
  } else {
    const double bend_m = bent ? kBendRadius * kBendAngle : 0.0;
    line.ahead((kNarrowLength - bend_m) / 2.0);
    if (bent) line.bend(kBendAngle);
    line.ahead((kNarrowLength - bend_m) / 2.0);
    tunnels.push_back({"narrow", line.take(), width_m});
  }
  line.ahead(kAfterLength);
  tunnels.push_back({"after", line.take(), kWide});
  description.wall_relief = {.height_m = kWallRelief, .length_m = 1.5};
  description.heights.floor_relief = {.height_m = 0.02, .length_m = 2.5};
  return description;
}

}  // namespace adit
