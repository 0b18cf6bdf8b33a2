// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/section/profile.hpp"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "common/geometry/order_statistics.hpp"

namespace adit {
namespace {

constexpr double kAroundM = 0.25;  // of a place, whose columns count

/// The median of the surface, with the median of the standard deviations: neighbours share it.
struct SurfaceSample {
  std::vector<double> heights;
  std::vector<double> deviations;

  void add(float height_m, float sd_m) {
    if (!std::isfinite(height_m)) return;
    heights.push_back(height_m);
    deviations.push_back(sd_m);
  }
  [[nodiscard]] Measured measured() const {
    if (heights.empty()) return {SectionOutline::kUnseen, SectionOutline::kUnseen};
    return {median(heights), median(deviations)};
  }
};

ProfilePoint profile_point(const ColumnGrid& grid, double chainage_m, const Eigen::Vector2d& p) {
  SurfaceSample floor;
  SurfaceSample roof;
  const int reach = static_cast<int>(std::round(kAroundM / grid.cell_m));
  const Eigen::Vector2i middle = cell_of(p, grid.cell_m);
  for (int x = -reach; x <= reach; ++x) {
    for (int y = -reach; y <= reach; ++y) {
      const SurveyColumn column = grid.columns.get(middle + Eigen::Vector2i(x, y));
      if (column.kind != SurveyColumn::Kind::kVoid) continue;
      floor.add(column.floor_m, column.floor_sd_m);
      roof.add(column.roof_m, column.roof_sd_m);
    }
  }
  return {chainage_m, p, floor.measured(), roof.measured()};
}

std::string number_or_empty(double value) {
  return std::isfinite(value) ? fmt::format("{:.3f}", value) : std::string();
}

}  // namespace

std::vector<Profile> profiles(const std::vector<CentreLine>& lines, const ColumnGrid& columns,
                              double every_m) {
  std::vector<Profile> all;
  for (const CentreLine& line : lines) {
    Profile profile{line.tunnel, {}};
    const auto count = static_cast<int>(std::floor(line.line.length_m() / every_m));
    for (int i = 0; i <= count; ++i)
      profile.points.push_back(profile_point(columns, i * every_m, line.line.at(i * every_m)));
    all.push_back(std::move(profile));
  }
  return all;
}

std::string profile_table(const std::vector<Profile>& profiles, const SurveyFrame& frame) {
  std::string table = "tunnel,chainage_m,x_m,y_m,floor_m,floor_sd_m,roof_m,roof_sd_m\n";
  const double z_m = frame.origin().z();
  for (const Profile& profile : profiles) {
    for (const ProfilePoint& point : profile.points) {
      const Eigen::Vector2d p = frame.in_grid(point.p_survey);
      fmt::format_to(std::back_inserter(table), "{},{:.2f},{:.3f},{:.3f},{},{},{},{}\n",
                     profile.tunnel, point.chainage_m, p.x(), p.y(),
                     number_or_empty(point.floor_m.value + z_m), number_or_empty(point.floor_m.sd),
                     number_or_empty(point.roof_m.value + z_m), number_or_empty(point.roof_m.sd));
    }
  }
  return table;
}

}  // namespace adit
