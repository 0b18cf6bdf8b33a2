// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/map_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "common/geometry/order_statistics.hpp"
#include "common/picture/canvas.hpp"
#include "common/picture/map_layout.hpp"
#include "common/picture/palette.hpp"

namespace adit {
namespace {

using Edge = GraphPicture::Edge;

struct Pen {
  Colour colour;
  double width;  // units
  double end;    // radius of the dots at its ends, units
  bool dashed = false;
};

constexpr double kNodeRadius = 3.4;  // units
constexpr Pen kSequentialPen{kGraph, 1.2, 0.0};
constexpr Pen kLoopClosurePen{kLoopClosure, 3.2, 4.2};
constexpr Pen kRevokedPen{kRevoked, 2.6, 3.6, true};

void trace(const Canvas& canvas, const Edge& edge) {
  cairo_move_to(canvas.cairo(), edge.a.x(), edge.a.y());
  cairo_line_to(canvas.cairo(), edge.b.x(), edge.b.y());
}

void stroke(const Canvas& canvas, std::span<const Edge> edges, const Colour& colour, double width) {
  cairo_new_path(canvas.cairo());
  for (const Edge& edge : edges) trace(canvas, edge);
  canvas.colour(colour);
  cairo_set_line_width(canvas.cairo(), width);
  cairo_stroke(canvas.cairo());
}

/// Draws edges given in pixels; emphasised ones have a pale rim, so that they are visible on walls
/// and path.
void draw_edges(const Canvas& canvas, std::span<const Edge> edges, const Pen& pen, double unit) {
  cairo_t* cairo = canvas.cairo();
  cairo_set_line_cap(cairo, pen.dashed ? CAIRO_LINE_CAP_BUTT : CAIRO_LINE_CAP_ROUND);
  if (pen.end > 0.0) {
    stroke(canvas, edges, kRim, (pen.width + 2.4) * unit);
    for (const Edge& edge : edges) {
      for (const Eigen::Vector2d& p : {edge.a, edge.b}) {
        canvas.disc(p.x(), p.y(), (pen.end + 1.2) * unit);
      }
    }
  }
  const std::array<double, 2> dashes = {8.0 * unit, 5.0 * unit};
  if (pen.dashed) cairo_set_dash(cairo, dashes.data(), 2, 0.0);
  stroke(canvas, edges, pen.colour, pen.width * unit);
  cairo_set_dash(cairo, nullptr, 0, 0.0);
  if (pen.end == 0.0) return;
  for (const Edge& edge : edges) {
    for (const Eigen::Vector2d& p : {edge.a, edge.b}) canvas.disc(p.x(), p.y(), pen.end * unit);
  }
}

std::vector<Edge> on_sheet(const MapLayout& layout, const std::vector<Edge>& edges) {
  std::vector<Edge> pixels;
  for (const Edge& edge : edges) pixels.push_back({layout.pixel(edge.a), layout.pixel(edge.b)});
  return pixels;
}

void draw_node(const Canvas& canvas, const Eigen::Vector2d& p, double radius) {
  canvas.colour(kOpen);
  canvas.disc(p.x(), p.y(), 1.4 * radius);
  canvas.colour(kGraph);
  canvas.disc(p.x(), p.y(), radius);
}

/// Scale of the graph relative to the legend, so that nodes at their median distance stay apart: at
/// most 1.
double fineness(const MapLayout& layout, const std::vector<Pose2>& nodes) {
  constexpr double kFinest = 0.4;
  std::vector<double> gaps;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    gaps.push_back((nodes[i].translation() - nodes[i - 1].translation()).norm());
  }
  if (gaps.empty()) return 1.0;
  const double desired_radius = 0.12 * median(std::move(gaps)) * layout.pixels_per_metre;
  return std::clamp(desired_radius / (kNodeRadius * layout.unit), kFinest, 1.0);
}

/// Draws a pose graph, finer where its nodes are dense on the sheet.
void draw_graph(const Canvas& canvas, const MapLayout& layout, const GraphPicture& graph) {
  const double unit = fineness(layout, graph.nodes) * layout.unit;
  draw_edges(canvas, on_sheet(layout, graph.sequential), kSequentialPen, unit);
  for (const Pose2& node : graph.nodes) {
    draw_node(canvas, layout.pixel(node.translation()), kNodeRadius * unit);
  }
  // Loop closures are reduced less, to stay readable.
  const double loop_closure_unit = std::sqrt(unit * layout.unit);
  draw_edges(canvas, on_sheet(layout, graph.revoked), kRevokedPen, loop_closure_unit);
  draw_edges(canvas, on_sheet(layout, graph.loop_closures), kLoopClosurePen, loop_closure_unit);
}

using Place = MapPicture::Place;

struct PlaceMark {
  Place::Kind kind;
  const char* name;
  Colour colour;
  double radius;  // units
};

// In the order of drawing: what must be seen comes last.
constexpr std::array<PlaceMark, 8> kPlaceMarks = {
    PlaceMark{Place::Kind::kScan, "3D scans", kScanMark, 2.6},
    PlaceMark{Place::Kind::kJunction, "junctions", kJunctionMark, 5.0},
    PlaceMark{Place::Kind::kDeadEnd, "dead ends", kDeadEndMark, 5.0},
    PlaceMark{Place::Kind::kBlockedFrontier, "blocked", kBlockedMark, 7.0},
    PlaceMark{Place::Kind::kOpenFrontier, "open", kOpenMark, 7.0},
    PlaceMark{Place::Kind::kDiffers, "differs", kDiffersMark, 3.0},
    PlaceMark{Place::Kind::kVanished, "vanished", kVanishedMark, 3.0},
    PlaceMark{Place::Kind::kAppeared, "appeared", kAppearedMark, 3.0}};

bool has(const std::vector<Place>& places, Place::Kind kind) {
  return std::any_of(places.begin(), places.end(),
                     [&](const Place& place) { return place.kind == kind; });
}

void draw_place(const Canvas& canvas, const Eigen::Vector2d& p, const PlaceMark& mark, double unit,
                bool with_rim = true, bool with_disc = true) {
  if (with_rim) {
    canvas.colour(kOpen);
    canvas.disc(p.x(), p.y(), (mark.radius + 1.6) * unit);
  }
  if (!with_disc) return;
  canvas.colour(mark.colour);
  canvas.disc(p.x(), p.y(), mark.radius * unit);
}

void draw_places(const Canvas& canvas, const MapLayout& layout, const std::vector<Place>& places) {
  for (const PlaceMark& mark : kPlaceMarks) {
    for (const bool rims : {true, false}) {  // all rims first: marks of one kind may touch
      for (const Place& place : places) {
        if (place.kind != mark.kind) continue;
        draw_place(canvas, layout.pixel(place.p_map), mark, layout.unit, rims, !rims);
      }
    }
  }
}

/// Draws the legend entries of the places side by side in the footer, ending at `right`. Returns
/// their left end [pixels].
double draw_place_keys(const Canvas& canvas, const MapLayout& layout,
                       const std::vector<Place>& places, double right) {
  const double unit = layout.unit;
  for (auto mark = kPlaceMarks.rbegin(); mark != kPlaceMarks.rend(); ++mark) {
    if (!has(places, mark->kind)) continue;
    const double centre = right - kGraphKey / 2.0 * unit;
    draw_place(canvas, {centre, foot(layout)}, *mark, unit);
    canvas.colour(kInk);
    canvas.text(mark->name, centre, foot(layout) + 24.0 * unit, 15.0 * unit, false, Align::kCentre);
    right -= kGraphKey * unit;
  }
  return right;
}

/// Draws the legend entries of its non-empty parts side by side in the footer, ending at `right`
/// [pixels].
void draw_graph_keys(const Canvas& canvas, const MapLayout& layout, const GraphPicture& graph,
                     double right) {
  const double unit = layout.unit;
  const double y = foot(layout);
  double centre = right - kGraphKey / 2.0 * unit;
  const auto key = [&](const char* name, const Pen& pen, bool with_nodes) {
    const Edge edge{{centre - 26.0 * unit, y}, {centre + 26.0 * unit, y}};
    draw_edges(canvas, std::span(&edge, 1), pen, unit);
    if (with_nodes) {
      for (const double share : {-1.0, 0.0, 1.0}) {
        draw_node(canvas, {centre + 26.0 * share * unit, y}, kNodeRadius * unit);
      }
    }
    canvas.colour(kInk);
    canvas.text(name, centre, y + 24.0 * unit, 15.0 * unit, false, Align::kCentre);
    centre -= kGraphKey * unit;
  };
  if (!graph.revoked.empty()) key("revoked", kRevokedPen, false);
  if (!graph.loop_closures.empty()) key("loop closures", kLoopClosurePen, false);
  if (!graph.nodes.empty()) key("local maps", kSequentialPen, true);
}

constexpr double kThinCell = 1.3;  // pixels; below, one-cell walls would fade

std::uint32_t pixel_of(const Colour& colour) {
  const auto channel = [](double value) {
    return static_cast<std::uint32_t>(std::lround(255.0 * value));
  };
  return channel(colour.red) << 16U | channel(colour.green) << 8U | channel(colour.blue);
}

Colour ground(const OccupancyGrid& grid, const Eigen::Vector2i& cell, bool thicken) {
  double occupancy = grid.occupancy(cell);
  if (thicken) {
    for (const auto& [i, j] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
      occupancy = std::max(occupancy, grid.occupancy(cell + Eigen::Vector2i(i, j)));
    }
  }
  if (occupancy == 0.0 && grid.state(cell) == CellState::kUnknown) return kPaper;
  return blend(kOpen, kWall, std::min(1.0, occupancy / 0.4));
}

void draw_ground(const Canvas& canvas, const MapLayout& layout, const OccupancyGrid& grid) {
  if (layout.cells.empty()) return;
  const double scale = grid.resolution_m() * layout.pixels_per_metre;
  const Eigen::Vector2i size = layout.cells.size();
  const Canvas image(size.x(), size.y());
  cairo_surface_t* surface = cairo_get_target(image.cairo());
  cairo_surface_flush(surface);
  auto* bytes = cairo_image_surface_get_data(surface);
  if (bytes == nullptr) return;
  for (int row = 0; row < size.y(); ++row) {
    auto* pixels = reinterpret_cast<std::uint32_t*>(
        bytes + static_cast<std::ptrdiff_t>(row) * cairo_image_surface_get_stride(surface));
    for (int column = 0; column < size.x(); ++column) {
      const Eigen::Vector2i cell(layout.cells.from.x() + column, layout.cells.to.y() - 1 - row);
      pixels[column] = pixel_of(ground(grid, cell, scale < kThinCell));
    }
  }
  cairo_surface_mark_dirty(surface);
  const Eigen::Vector2d corner = layout.pixel(
      grid.resolution_m() * Eigen::Vector2d(layout.cells.from.x(), layout.cells.to.y()));
  cairo_t* cairo = canvas.cairo();
  cairo_save(cairo);
  cairo_translate(cairo, corner.x(), corner.y());
  cairo_scale(cairo, scale, scale);
  cairo_set_source_surface(cairo, surface, 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(cairo), CAIRO_FILTER_GOOD);
  cairo_paint(cairo);
  cairo_restore(cairo);
}

/// Strokes the segments [i, i + 1] of the path with `selected(i)`, joined where they touch.
template <class Selected>
void stroke_path(const Canvas& canvas, const MapLayout& layout, const std::vector<Pose2>& path,
                 double line_width, const Selected& selected) {
  cairo_t* cairo = canvas.cairo();
  cairo_set_line_width(cairo, line_width);
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  cairo_new_path(cairo);
  bool drawing = false;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (selected(i)) {
      const Eigen::Vector2d from = layout.pixel(path[i].translation());
      const Eigen::Vector2d to = layout.pixel(path[i + 1].translation());
      if (!drawing) cairo_move_to(cairo, from.x(), from.y());
      cairo_line_to(cairo, to.x(), to.y());
    }
    drawing = selected(i);
  }
  cairo_stroke(cairo);
}

void draw_path(const Canvas& canvas, const MapLayout& layout, const MapPicture& picture) {
  const std::vector<Pose2>& path = picture.path;
  const auto connected = [&](std::size_t i) {
    const auto& jumps = picture.jumps;
    return std::find(jumps.begin(), jumps.end(), i + 1) == jumps.end();
  };
  const auto flagged = [&](std::size_t i) {
    return i < picture.degenerate.size() && picture.degenerate[i] && connected(i);
  };
  canvas.colour(kDegenerate);
  stroke_path(canvas, layout, path, 12.0 * layout.unit, flagged);
  canvas.colour(kDoubtful);
  stroke_path(canvas, layout, path, 18.0 * layout.unit, [&](std::size_t i) {
    return i < picture.doubtful.size() && picture.doubtful[i] && connected(i);
  });
  // The colour changes in small steps, each one stroke with proper joins.
  constexpr std::size_t kShades = 128;
  const std::size_t segments = path.size() > 1 ? path.size() - 1 : 0;
  for (std::size_t shade = 0; shade < kShades; ++shade) {
    canvas.colour(along_path((static_cast<double>(shade) + 0.5) / kShades));
    const std::size_t first = segments * shade / kShades;
    const std::size_t end = segments * (shade + 1) / kShades;
    stroke_path(canvas, layout, path, 2.6 * layout.unit,
                [&](std::size_t i) { return i >= first && i < end && connected(i); });
  }
}

MapLayout layout_of(const OccupancyGrid& grid, const MapPicture& picture) {
  const GraphPicture& graph = picture.graph;
  std::vector<Pose2> poses = picture.path;
  poses.insert(poses.end(), graph.nodes.begin(), graph.nodes.end());
  const bool doubtful =
      std::find(picture.doubtful.begin(), picture.doubtful.end(), true) != picture.doubtful.end();
  const int keys = int(doubtful) + int(!graph.nodes.empty()) + int(!graph.loop_closures.empty()) +
                   int(!graph.revoked.empty()) +
                   static_cast<int>(std::count_if(
                       kPlaceMarks.begin(), kPlaceMarks.end(),
                       [&](const PlaceMark& mark) { return has(picture.places, mark.kind); }));
  return {grid, poses, keys};
}

}  // namespace

void write_map_png(const OccupancyGrid& grid, const MapPicture& picture,
                   const std::filesystem::path& path) {
  const MapLayout layout = layout_of(grid, picture);
  const double unit = layout.unit;
  const Canvas canvas(layout.width, layout.height);
  canvas.colour(kPaper);
  canvas.fill_rectangle(0, 0, layout.width, layout.height);
  draw_ground(canvas, layout, grid);
  draw_path(canvas, layout, picture);
  draw_graph(canvas, layout, picture.graph);
  draw_places(canvas, layout, picture.places);
  double keys_end = layout.width - kPageMargin * unit;
  if (!picture.path.empty()) {
    draw_start(canvas, layout.pixel(picture.path.front().translation()), unit);
    draw_end(canvas, layout.pixel(picture.path.back().translation()), unit);
    const auto& flags = picture.degenerate;
    const bool with_degenerate = std::find(flags.begin(), flags.end(), true) != flags.end();
    const auto& doubtful = picture.doubtful;
    const bool with_doubtful = std::find(doubtful.begin(), doubtful.end(), true) != doubtful.end();
    keys_end = draw_path_keys(canvas, layout, with_degenerate, with_doubtful);
  }
  keys_end = draw_place_keys(canvas, layout, picture.places, keys_end);
  draw_graph_keys(canvas, layout, picture.graph, keys_end);
  canvas.colour(kInk);
  canvas.text(picture.title, kPageMargin * unit, 48.0 * unit, 24.0 * unit, true, Align::kLeft);
  draw_scale_bar(canvas, layout);
  canvas.write_png(path);
}

}  // namespace adit
