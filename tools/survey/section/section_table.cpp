// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/section/section_table.hpp"

#include <cmath>
#include <cstddef>
#include <iterator>

#include <fmt/format.h>

#include "common/geometry/pose2.hpp"

namespace adit {
namespace {

std::string number(double value, int digits = 3) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : std::string();
}

std::string pair(const Measured& measured, bool known = true) {
  if (!known || !std::isfinite(measured.value)) return ",";
  return number(measured.value) + "," + number(measured.sd);
}

const char* place_of(const CrossSection& section) {
  if (section.plane.in_junction) return "junction";
  if (!section.has_width()) return "open side";
  return section.has_area() ? "tunnel" : "partly unseen";
}

}  // namespace

std::string section_table(const std::vector<CrossSection>& sections, const SurveyFrame& frame) {
  std::string table =
      "tunnel,chainage_m,x_m,y_m,bearing_deg,floor_m,floor_sd_m,roof_m,roof_sd_m,plan_sd_m,"
      "width_m,width_sd_m,height_m,height_sd_m,area_m2,area_sd_m2,perimeter_m,perimeter_sd_m,"
      "seen_share,place\n";
  for (const CrossSection& section : sections) {
    const SectionPlane& plane = section.plane;
    const SectionMeasures& measures = section.measures;
    const Eigen::Vector2d p = frame.in_grid(plane.p_survey);
    const double bearing =
        std::fmod(rad_to_deg(std::atan2(plane.along.x(), plane.along.y())) + 360.0, 360.0);
    const bool closed = section.has_area();
    const double z_m = frame.origin().z();
    fmt::format_to(std::back_inserter(table), "{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                   plane.tunnel, number(plane.chainage_m, 2), number(p.x()), number(p.y()),
                   number(bearing, 2), pair({section.floor_m.value + z_m, section.floor_m.sd}),
                   pair({section.roof_m.value + z_m, section.roof_m.sd}), number(section.plan_sd_m),
                   pair(measures.width_m, section.has_width()), pair(measures.height_m),
                   pair(measures.area_m2, closed), pair(measures.perimeter_m, closed),
                   number(measures.seen_share), place_of(section));
  }
  return table;
}

std::string outline_table(const std::vector<CrossSection>& sections, const SurveyFrame& frame) {
  std::string table = "tunnel,chainage_m,offset_left_m,elevation_m,x_m,y_m,sd_m\n";
  for (const CrossSection& section : sections) {
    for (std::size_t i = 0; i < SectionOutline::kRays; ++i) {
      const SectionOutline::Ray& ray = section.outline.rays[i];
      if (!ray.seen()) continue;
      const Eigen::Vector2d corner = ray.distance_m * SectionOutline::direction(i);
      const Eigen::Vector2d p = frame.in_grid(
          Eigen::Vector2d(section.plane.p_survey + corner.x() * section.plane.left()));
      fmt::format_to(std::back_inserter(table), "{},{},{},{},{},{},{}\n", section.plane.tunnel,
                     number(section.plane.chainage_m, 2), number(corner.x()),
                     number(section.z_middle_m + corner.y() + frame.origin().z()), number(p.x()),
                     number(p.y()), number(ray.sd_m));
    }
  }
  return table;
}

}  // namespace adit
