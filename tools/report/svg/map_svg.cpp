// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/svg/map_svg.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "tools/report/svg/map_layers.hpp"
#include "tools/report/svg/markup.hpp"
#include "tools/report/text_format.hpp"

namespace adit {
namespace {

constexpr double kHeadUnits = 46.0;
constexpr double kFootUnits = 44.0;
constexpr double kLegendEntryUnits = 126.0;
constexpr double kFileWidthMin = 900.0;

std::string layers(const MapContent& map, const MapView& view, const std::string& page) {
  std::string svg;
  if (map.grid != nullptr) svg += ground_svg(*map.grid, view);
  if (map.exploration != nullptr) svg += corridors_svg(map.exploration->corridors, view);
  svg += graph_svg(*map.map, view);
  svg += paths_svg(map.map->path(), map.return_home_utime, view);
  if (map.exploration != nullptr) svg += frontiers_svg(map.exploration->frontiers, view, page);
  svg += scans_svg(map.scans, view, page);
  return svg + ends_svg(map.map->path(), view);
}

/// Attributes of an <svg> of that size.
std::string size_attributes(double width, double height) {
  return fmt::format(R"(viewBox="0 0 {} {}" width="{}" height="{}")", fixed(width, 1),
                     fixed(height, 1), fixed(width, 0), fixed(height, 0));
}

struct LegendEntry {
  const char* symbol;
  const char* name;
};
constexpr LegendEntry kLegend[] = {
    {R"(<path class="outbound" d="M0-4h22"/>)", "outbound path"},
    {R"(<path class="return" d="M0-4h22"/>)", "return path"},
    {R"(<g class="scan"><circle cx="11" cy="-4" r="7"/></g>)", "3D scan"},
    {R"(<path class="loop-closure" d="M0-4h22"/>)", "loop closure"},
    {R"(<path class="revoked" d="M0-4h22"/>)", "revoked"},
    {R"(<circle class="frontier open" cx="11" cy="-4" r="5"/>)", "open frontier"},
    {R"(<circle class="frontier closed" cx="11" cy="-4" r="5"/>)", "closed frontier"}};

std::string legend_svg(double y) {
  std::string svg;
  double x = 20.0;
  for (const LegendEntry& entry : kLegend) {
    svg += fmt::format(R"svg(<g transform="translate({} {})">{}<text x="28">{}</text></g>)svg",
                       fixed(x, 0), fixed(y, 0), entry.symbol, entry.name);
    x += kLegendEntryUnits;
  }
  return svg;
}

}  // namespace

std::string map_svg_file(const MapContent& map, const std::string& title) {
  const MapView view(map.grid, map.map->path());
  const double width = std::max(view.width(), kFileWidthMin);
  const double height = kHeadUnits + view.height() + kFootUnits;
  return fmt::format(R"svg(<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" class="mine" {}>
<style>{}</style>
<title>{}</title>
<rect class="sheet" width="{}" height="{}"/>
<text class="title" x="20" y="30">{}</text>
<g transform="translate({} {})">{}{}</g>
{}
</svg>
)svg",
                     size_attributes(width, height), style_file("map"), escaped(title),
                     fixed(width, 1), fixed(height, 1), escaped(title),
                     fixed((width - view.width()) / 2.0, 1), fixed(kHeadUnits, 1),
                     layers(map, view, "mission.html"),
                     scale_svg(view, {14.0, view.height() - 12.0}), legend_svg(height - 16.0));
}

}  // namespace adit
