// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/section/section_sheets.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr double kSigmas = 1.959964;  // 95 % of a normal distribution
constexpr double kMarginMm = 8.0;

std::string svg_document(double width_mm, double height_mm, const std::string& parts) {
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0:.0f}mm" height="{1:.0f}mm" viewBox="0 0 {0:.0f} {1:.0f}">
<style>text{{font:2.6px sans-serif;fill:#222}}.small{{font-size:2.1px;fill:#555}}
.rock{{fill:#eee9df;stroke:#333;stroke-width:.35;stroke-linejoin:round}}.axis{{stroke:#999;stroke-width:.15}}
.dash{{stroke-dasharray:1 1}}.floor{{fill:none;stroke:#333;stroke-width:.35}}.roof{{fill:none;stroke:#06c;stroke-width:.35}}
.band{{fill:#333;opacity:.15}}</style>
<rect width="100%" height="100%" fill="#fff"/>
{2}</svg>
)",
      width_mm, height_mm, parts);
}

std::string interval(const Measured& measured, const char* unit) {
  return fmt::format("{:.2f} ± {:.2f} {}", measured.value, kSigmas * measured.sd, unit);
}

// Cross-sections.

constexpr double kSectionMm = 10.0;  // per metre: 1:100
constexpr int kPerRow = 3;

/// The extent of a section above, below and beside its point inside [m].
struct SectionExtent {
  double side_m = 0.0;
  double up_m = 0.0;
  double down_m = 0.0;
};

SectionExtent extent_of(const std::vector<const CrossSection*>& sections) {
  SectionExtent extent;
  for (const CrossSection* section : sections) {
    for (const Eigen::Vector2d& corner : section->outline.corners()) {
      extent.side_m = std::max(extent.side_m, std::abs(corner.x()));
      extent.up_m = std::max(extent.up_m, corner.y());
      extent.down_m = std::max(extent.down_m, -corner.y());
    }
  }
  return extent;
}

/// Looking along the centre line: its left is on the left.
std::string section_svg(const CrossSection& section, const Eigen::Vector2d& middle_mm,
                        const SectionExtent& extent, const SurveyFrame& frame) {
  std::string points;
  for (const Eigen::Vector2d& corner : section.outline.corners()) {
    fmt::format_to(std::back_inserter(points), "{:.2f},{:.2f} ",
                   middle_mm.x() - kSectionMm * corner.x(),
                   middle_mm.y() - kSectionMm * corner.y());
  }
  const double top = middle_mm.y() - kSectionMm * extent.up_m;
  const double bottom = middle_mm.y() + kSectionMm * extent.down_m;
  std::string text = fmt::format("{:.2f} m", section.plane.chainage_m);
  std::string measures;
  if (section.has_width()) measures += "w " + interval(section.measures.width_m, "m  ");
  if (std::isfinite(section.measures.height_m.value))
    measures += "h " + interval(section.measures.height_m, "m  ");
  std::string area;
  if (section.has_area()) area = "A " + interval(section.measures.area_m2, "m²  ");
  if (std::isfinite(section.floor_m.value)) {
    area += fmt::format("floor {:.2f} ± {:.2f} m", section.floor_m.value + frame.origin().z(),
                        kSigmas * section.floor_m.sd);
  }
  return fmt::format(
      R"(<polygon class="rock" points="{}"/><line class="axis dash" x1="{:.2f}" y1="{:.2f}" x2="{:.2f}" y2="{:.2f}"/>
<text x="{:.2f}" y="{:.2f}" text-anchor="middle">tunnel {} at {}</text><text class="small" x="{:.2f}" y="{:.2f}" text-anchor="middle">{}</text><text class="small" x="{:.2f}" y="{:.2f}" text-anchor="middle">{}</text>
)",
      points, middle_mm.x(), top - 2.0, middle_mm.x(), bottom + 2.0, middle_mm.x(), top - 3.0,
      section.plane.tunnel, text, middle_mm.x(), bottom + 5.0, measures, middle_mm.x(),
      bottom + 8.0, area);
}

// Profiles.

constexpr double kAlongMm = 4.0;  // per metre: 1:250
constexpr double kUpMm = 20.0;    // per metre: five times as much
constexpr double kGridM = 5.0;

struct HeightRange {
  double low_m = std::numeric_limits<double>::infinity();
  double high_m = -std::numeric_limits<double>::infinity();

  void add(double z_m) {
    if (!std::isfinite(z_m)) return;
    low_m = std::min(low_m, z_m);
    high_m = std::max(high_m, z_m);
  }
  [[nodiscard]] bool empty() const { return low_m > high_m; }
};

HeightRange heights_of(const Profile& profile) {
  HeightRange range;
  for (const ProfilePoint& point : profile.points) {
    range.add(point.floor_m.value - kSigmas * point.floor_m.sd);
    range.add(point.roof_m.value);
  }
  return range;
}

/// A line with a gap where a height is unknown.
template <class HeightOf>
std::string profile_line(const char* css_class, const Profile& profile, double left_mm,
                         double low_mm, double low_m, HeightOf height_of) {
  std::string data;
  bool drawing = false;
  for (const ProfilePoint& point : profile.points) {
    const double z_m = height_of(point);
    if (!std::isfinite(z_m)) {
      drawing = false;
      continue;
    }
    fmt::format_to(std::back_inserter(data), "{}{:.2f},{:.2f}", drawing ? "L" : "M",
                   left_mm + kAlongMm * point.chainage_m, low_mm - kUpMm * (z_m - low_m));
    drawing = true;
  }
  return data.empty() ? ""
                      : fmt::format(R"(<path class="{}" d="{}"/>
)",
                                    css_class, data);
}

std::string profile_svg(const Profile& profile, const HeightRange& range, double top_mm,
                        const SurveyFrame& frame) {
  const double left = kMarginMm + 14.0;
  const double low = top_mm + 6.0 + kUpMm * (range.high_m - range.low_m);
  std::string svg = fmt::format(R"(<text x="{:.2f}" y="{:.2f}">tunnel {}</text>
)",
                                left, top_mm + 3.0, profile.tunnel);
  const double right = left + kAlongMm * profile.points.back().chainage_m;
  const double z_m = frame.origin().z();
  for (double z = std::ceil(range.low_m + z_m); z <= range.high_m + z_m; z += 1.0) {
    const double y = low - kUpMm * (z - z_m - range.low_m);
    fmt::format_to(
        std::back_inserter(svg),
        R"(<line class="axis" x1="{0:.2f}" y1="{1:.2f}" x2="{2:.2f}" y2="{1:.2f}"/><text class="small" x="{3:.2f}" y="{4:.2f}" text-anchor="end">{5:.0f} m</text>
)",
        left, y, right, left - 1.0, y + 0.8, z + 0.0);  // no minus sign before zero
  }
  for (const ProfilePoint& point : profile.points) {
    if (std::abs(std::remainder(point.chainage_m, kGridM)) > 1e-6) continue;
    fmt::format_to(
        std::back_inserter(svg),
        R"(<text class="small" x="{0:.2f}" y="{1:.2f}" text-anchor="middle">{2:.0f}</text>
)",
        left + kAlongMm * point.chainage_m, low + 4.0, point.chainage_m);
  }
  for (const ProfilePoint& point : profile.points) {
    if (!std::isfinite(point.floor_m.value) || !std::isfinite(point.floor_m.sd)) continue;
    const double half_mm = kUpMm * kSigmas * point.floor_m.sd;
    fmt::format_to(std::back_inserter(svg),
                   R"(<rect class="band" x="{:.2f}" y="{:.2f}" width="{:.2f}" height="{:.2f}"/>
)",
                   left + kAlongMm * point.chainage_m - 0.2,
                   low - kUpMm * (point.floor_m.value - range.low_m) - half_mm, 0.4, 2.0 * half_mm);
  }
  svg += profile_line("floor", profile, left, low, range.low_m,
                      [](const ProfilePoint& point) { return point.floor_m.value; });
  svg += profile_line("roof", profile, left, low, range.low_m,
                      [](const ProfilePoint& point) { return point.roof_m.value; });
  return svg;
}

}  // namespace

std::string sections_svg(const std::vector<CrossSection>& sections, const SurveyFrame& frame) {
  std::vector<const CrossSection*> shown;
  for (const CrossSection& section : sections) {
    if (section.has_width()) shown.push_back(&section);
  }
  const SectionExtent extent = extent_of(shown);
  const double width_mm = 2.0 * std::max(24.0, kSectionMm * extent.side_m) + kMarginMm;
  const double height_mm = kSectionMm * (extent.up_m + extent.down_m) + 20.0;
  std::string parts;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto column = static_cast<double>(i % kPerRow);
    const std::size_t rows_above = i / kPerRow;
    const auto row = static_cast<double>(rows_above);
    const Eigen::Vector2d middle(kMarginMm + (column + 0.5) * width_mm,
                                 kMarginMm + row * height_mm + 6.0 + kSectionMm * extent.up_m);
    parts += section_svg(*shown[i], middle, extent, frame);
  }
  const double rows = std::ceil(static_cast<double>(shown.size()) / kPerRow);
  parts += fmt::format(
      R"(<text x="{}" y="{:.2f}">Cross-sections, 1:100, looking along the centre line; ± 95 %. {}</text>
)",
      kMarginMm, kMarginMm + rows * height_mm + 4.0, frame.statement());
  return svg_document(2.0 * kMarginMm + kPerRow * width_mm,
                      2.0 * kMarginMm + rows * height_mm + 4.0, parts);
}

std::string profiles_svg(const std::vector<Profile>& profiles, const SurveyFrame& frame) {
  std::string parts;
  double top_mm = kMarginMm;
  double width_mm = 200.0;
  for (const Profile& profile : profiles) {
    const HeightRange range = heights_of(profile);
    if (range.empty() || profile.points.size() < 2) continue;
    parts += profile_svg(profile, range, top_mm, frame);
    top_mm += kUpMm * (range.high_m - range.low_m) + 18.0;
    width_mm = std::max(width_mm, 30.0 + kAlongMm * profile.points.back().chainage_m);
  }
  parts += fmt::format(
      R"(<text x="{}" y="{:.2f}">Longitudinal profiles, lengths 1:250, heights 1:50; floor black with its 95 % interval, roof blue. {}</text>
)",
      kMarginMm, top_mm + 4.0, frame.statement());
  return svg_document(width_mm + kMarginMm, top_mm + 8.0, parts);
}

}  // namespace adit
