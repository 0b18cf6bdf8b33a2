// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/svg/map_svg.hpp"

#include "tools/report/html/text_format.hpp"
#include "tools/report/svg/map_layers.hpp"
#include "tools/report/svg/map_view.hpp"

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
  svg += paths_svg(map.map->path(), map.homeward_utime, view);
  if (map.exploration != nullptr) svg += frontiers_svg(map.exploration->frontiers, view, page);
  svg += scans_svg(map.scans, view, page);
  return svg + start_svg(map.map->path(), view);
}

std::string box(double width, double height) {
  return std::string("viewBox=\"0 0 ") + fixed(width, 1) + " " + fixed(height, 1) + "\"";
}

struct LegendEntry {
  const char* part;
  const char* name;
};
constexpr LegendEntry kLegend[] = {
    {"<path class=\"out\" d=\"M0-4h22\"/>", "way out"},
    {"<path class=\"back\" d=\"M0-4h22\"/>", "way home"},
    {"<g class=\"scan\"><circle cx=\"11\" cy=\"-4\" r=\"7\"/></g>", "3D scan"},
    {"<path class=\"closure\" d=\"M0-4h22\"/>", "place recognised"},
    {"<path class=\"revoked\" d=\"M0-4h22\"/>", "taken back"},
    {"<circle class=\"stub open\" cx=\"11\" cy=\"-4\" r=\"5\"/>", "opening, open"},
    {"<circle class=\"stub closed\" cx=\"11\" cy=\"-4\" r=\"5\"/>", "opening, closed"}};

std::string legend_svg(double y) {
  std::string svg;
  double x = 20.0;
  for (const LegendEntry& entry : kLegend) {
    svg += std::string("<g transform=\"translate(") + fixed(x, 0) + " " + fixed(y, 0) + ")\">" +
           entry.part + "<text x=\"28\">" + entry.name + "</text></g>";
    x += kLegendEntryUnits;
  }
  return svg;
}

}  // namespace

std::string map_svg(const MapContent& map) {
  const MapView view(map.grid, map.map->path());
  return "<svg class=\"mine\" " + box(view.width(), view.height()) + " width=\"" +
         fixed(view.width(), 0) + "\" height=\"" + fixed(view.height(), 0) +
         "\" role=\"group\" aria-label=\"Map of the mine, with the way of the robot\">" +
         layers(map, view, "") + scale_svg(view, {14.0, view.height() - 12.0}) + "</svg>";
}

std::string map_svg_file(const MapContent& map, const std::string& title) {
  const MapView view(map.grid, map.map->path());
  const double width = std::max(view.width(), kFileWidthMin);
  const double height = kHeadUnits + view.height() + kFootUnits;
  return std::string("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n") +
         "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"mine\" " + box(width, height) +
         " width=\"" + fixed(width, 0) + "\" height=\"" + fixed(height, 0) + "\"><style>" +
         map_colours() + map_style() + "</style><title>" + escaped(title) +
         "</title><rect class=\"sheet\" width=\"" + fixed(width, 1) + "\" height=\"" +
         fixed(height, 1) + "\"/><text class=\"title\" x=\"20\" y=\"30\">" + escaped(title) +
         "</text><g transform=\"translate(" + fixed((width - view.width()) / 2.0, 1) + " " +
         fixed(kHeadUnits, 1) + ")\">" + layers(map, view, "mission.html") +
         scale_svg(view, {14.0, view.height() - 12.0}) + "</g>" + legend_svg(height - 16.0) +
         "</svg>\n";
}

const char* map_colours() {
  return R"(:root{--sheet:#e8e5df;--ink:#22262b;--rim:#fff;--out:#1f5fb4;--back:#c2372a;--graph:#6d747c;
--closure:#23831f;--revoked:#d96a00;--corridor:#5b8ec9;--open:#c8102e;--closed:#6b5b95;--done:#3c9a68;
--scan:#22262b;--scan-ink:#fff;--stuck:#c2372a})";
}

const char* map_style() {
  return R"(
.mine{font:11px system-ui,sans-serif;fill:none;stroke-linejoin:round;stroke-linecap:round}
.mine text{fill:var(--ink);stroke:none}
.mine .sheet{fill:var(--sheet)}.mine .title{font-size:17px;font-weight:600}
.mine .scale path{stroke:var(--ink);stroke-width:1.5}.mine .scale text{font-size:12px}
.mine .out{stroke:var(--out);stroke-width:3.2}
.mine .back{stroke:var(--back);stroke-width:1.6;stroke-dasharray:5 4}
.mine .corridor{stroke:var(--corridor);stroke-width:1;stroke-dasharray:1 3}
.mine .junction{fill:var(--corridor)}.mine .dead-end{fill:var(--ink)}
.mine .edge{stroke:var(--graph);stroke-width:.7}.mine .node{fill:var(--graph)}
.mine .closure{stroke:var(--closure);stroke-width:1;opacity:.5}
.mine .revoked{stroke:var(--revoked);stroke-width:1.8;stroke-dasharray:4 3}
.mine .stub{stroke-width:2;stroke:var(--closed);fill:var(--rim)}
.mine .stub.open{stroke:var(--open)}.mine .stub.done{stroke:var(--done);stroke-width:1.4}
.mine .aim{stroke-width:2;stroke:var(--closed)}.mine .aim.open{stroke:var(--open)}
.mine .scan circle{fill:var(--scan);stroke:var(--rim);stroke-width:1}
.mine .scan.stuck circle{fill:var(--stuck)}
.mine .scan path{stroke:var(--ink);stroke-width:.8}
.mine .scan text{fill:var(--scan-ink);font-size:8.5px;font-weight:600;text-anchor:middle}
.mine .home{fill:var(--done);stroke:var(--rim);stroke-width:1.5}
.mine .end{fill:var(--rim);stroke:var(--back);stroke-width:2.5}
)";
}

}  // namespace adit
