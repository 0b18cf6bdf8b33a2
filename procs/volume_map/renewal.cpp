// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/renewal.hpp"

#include <cmath>
#include <optional>

namespace adit {
namespace {

constexpr double kSameWayRad = 0.5;  // between the headings of two scans that see much the same

Pose2 place(const PlacedVolume& placed) { return placed.T_map_volume * placed.T_volume_place; }

}  // namespace

Pose2 look_of(const Cloud& cloud) {
  Eigen::Vector2f ahead(0.0F, 0.0F);
  for (const CloudLine& line : cloud.lines) ahead += line.origin.head<2>();
  return {0.0, 0.0, std::atan2(double{ahead.y()}, double{ahead.x()})};
}

bool is_same_look(const Pose2& T_a, const Pose2& T_b, double renew_m) {
  const Pose2 apart = between(T_a, T_b);
  return std::abs(apart.theta) <= kSameWayRad && apart.translation().norm() <= renew_m;
}

void mark_what_was_left(std::vector<PlacedVolume>& volumes, const Pose2& T_map_look,
                        double renew_m) {
  for (PlacedVolume& placed : volumes) {
    const double apart_m = (place(placed).translation() - T_map_look.translation()).norm();
    placed.was_left = placed.was_left || apart_m > renew_m;
  }
}

std::vector<std::size_t> looks_to_replace(const std::vector<PlacedVolume>& volumes,
                                          const Pose2& T_map_look, double renew_m) {
  std::vector<std::size_t> older;
  const auto apart_m = [&](std::size_t i) {
    return (place(volumes[i]).translation() - T_map_look.translation()).norm();
  };
  std::optional<std::size_t> of_this_visit;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    const bool placed = volumes[i].tie && !volumes[i].left_out && !volumes[i].volume.is_empty();
    if (!placed || !is_same_look(place(volumes[i]), T_map_look, renew_m)) continue;
    if (volumes[i].was_left) {
      older.push_back(i);
    } else if (!of_this_visit || apart_m(i) < apart_m(*of_this_visit)) {
      of_this_visit = i;
    }
  }
  if (of_this_visit) older.insert(older.begin(), *of_this_visit);
  return older;
}

}  // namespace adit
