// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "sim/world/props/prop_site.hpp"

namespace adit {
namespace {

// A sleeper [m]. Its top is above the floor by less than the thickness of a rail's foot.
constexpr double kSleeperWidth = 0.2;
constexpr double kSleeperThickness = 0.12;
constexpr double kSleeperTop = 0.015;
constexpr double kSleeperOverhang = 0.3;  // beyond each rail

// Fractions of the height of a rail, after profiles of 15 to 30 kg/m.
constexpr double kFootWidth = 0.8;
constexpr double kFootThickness = 0.2;
constexpr double kWebWidth = 0.13;
constexpr double kHeadWidth = 0.45;
constexpr double kHeadThickness = 0.3;

// Half of the length over which a rail bridges the relief of the floor [m].
constexpr double kBridge = 1.0;

constexpr std::size_t kSectionCorners = 12;
using Section = std::array<std::uint32_t, kSectionCorners>;

/// Height of the track bed: the mean of the floor around it.
double bed_height(const PropSite& site, const TunnelLine& tunnel, double s_m, double across_m,
                  double gauge_m) {
  double sum = 0.0;
  for (const double along : {-kBridge, -0.5 * kBridge, 0.0, 0.5 * kBridge, kBridge}) {
    for (const double side : {-0.5, 0.5}) {
      sum += site.heights.floor(tunnel.beside(s_m + along, across_m + side * gauge_m));
    }
  }
  return sum / 10.0;
}

/// Foot, web and head of a rail of height 1 as a ring of corners (aside, up).
std::array<Eigen::Vector2d, kSectionCorners> rail_profile() {
  const double foot = kFootWidth / 2.0;
  const double web = kWebWidth / 2.0;
  const double head = kHeadWidth / 2.0;
  const double low = kFootThickness;
  const double high = 1.0 - kHeadThickness;
  return {Eigen::Vector2d(-foot, 0.0),
          {foot, 0.0},
          {foot, low},
          {web, low},
          {web, high},
          {head, high},
          {head, 1.0},
          {-head, 1.0},
          {-head, high},
          {-web, high},
          {-web, low},
          {-foot, low}};
}

Section rail_section(PropSite& site, const TunnelLine& tunnel, double s_m, double across_m,
                     double bed_m, double height_m) {
  Section section{};
  const auto profile = rail_profile();
  for (std::size_t i = 0; i < kSectionCorners; ++i) {
    const Eigen::Vector2d plan = tunnel.beside(s_m, across_m + height_m * profile[i].x());
    const Eigen::Vector3d p_world(plan.x(), plan.y(), bed_m + height_m * profile[i].y());
    section[i] = site.builder.vertex(p_world.cast<float>());
  }
  return section;
}

void close_end(MeshBuilder& builder, const Section& end) {
  builder.quad(end[0], end[1], end[2], end[11]);
  builder.quad(end[10], end[3], end[4], end[9]);
  builder.quad(end[8], end[5], end[6], end[7]);
}

/// One rail; `side` is 1 for the left rail and −1 for the right rail.
void add_rail(const RailsDescription& rails, const TunnelLine& tunnel, double side,
              PropSite& site) {
  // The gauge is that between the inner faces of the heads.
  const double aside_m = side * (rails.gauge_m + kHeadWidth * rails.height_m) / 2.0;
  const auto section_at = [&](double s_m) {
    const double bed_m = bed_height(site, tunnel, s_m, rails.across_m, rails.gauge_m);
    return rail_section(site, tunnel, s_m, rails.across_m + aside_m, bed_m, rails.height_m);
  };
  const std::vector<double> places = places_between(rails.from_m, rails.to_m, 0.7);
  Section before = section_at(places.front());
  close_end(site.builder, before);
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Section here = section_at(places[i]);
    for (std::size_t k = 0; k < kSectionCorners; ++k) {
      const std::size_t l = (k + 1) % kSectionCorners;
      site.builder.quad(before[k], before[l], here[l], here[k]);
    }
    before = here;
  }
  close_end(site.builder, before);
}

void add_sleeper(const RailsDescription& rails, const TunnelLine& tunnel, double s_m,
                 PropSite& site) {
  const Eigen::Vector2d plan = tunnel.beside(s_m, rails.across_m);
  const double bed_m = bed_height(site, tunnel, s_m, rails.across_m, rails.gauge_m);
  const double half_length = rails.gauge_m / 2.0 + kSleeperOverhang;
  OrientedBox box;
  box.T_world_box =
      tunnel_axes(tunnel, s_m, {plan.x(), plan.y(), bed_m + kSleeperTop - kSleeperThickness / 2.0});
  box.T_world_box.rotate(Eigen::AngleAxisd(site.between(-0.05, 0.05), Eigen::Vector3d::UnitZ()));
  box.half_size = {kSleeperWidth / 2.0, half_length, kSleeperThickness / 2.0};
  site.builder.box(box);
}

}  // namespace

void add_prop(const RailsDescription& rails, PropSite& site) {
  const TunnelLine& tunnel =
      tunnel_with(site.tunnels, rails.tunnel, rails.from_m, rails.to_m, site.what);
  site.builder.begin_part(PartKind::kRail, Material::kSteel, "rails");
  for (const double side : {-1.0, 1.0}) add_rail(rails, tunnel, side, site);
  site.builder.begin_part(PartKind::kSleeper, Material::kTimber, "sleepers");
  const double half_m = kSleeperWidth / 2.0;
  for (double s_m = rails.from_m + half_m; s_m <= rails.to_m - half_m;
       s_m += rails.sleeper_every_m) {
    add_sleeper(rails, tunnel, s_m, site);
  }
}

}  // namespace adit
