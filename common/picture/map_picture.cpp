// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/map_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "common/picture/canvas.hpp"
#include "common/picture/graph_overlay.hpp"
#include "common/picture/map_keys.hpp"
#include "common/picture/map_layout.hpp"
#include "common/picture/palette.hpp"

namespace adit {
namespace {

constexpr double kThinCell = 1.3;  // pixels; walls one cell thick fade if drawn finer than this

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

/// Strokes the pieces [i, i + 1] of the path for which `wanted(i)`, joined where they touch.
template <class Wanted>
void stroke_path(const Canvas& canvas, const MapLayout& layout, const std::vector<Pose2>& path,
                 double line_width, const Wanted& wanted) {
  cairo_t* cairo = canvas.cairo();
  cairo_set_line_width(cairo, line_width);
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  cairo_new_path(cairo);
  bool drawing = false;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (wanted(i)) {
      const Eigen::Vector2d from = layout.pixel(path[i].translation());
      const Eigen::Vector2d to = layout.pixel(path[i + 1].translation());
      if (!drawing) cairo_move_to(cairo, from.x(), from.y());
      cairo_line_to(cairo, to.x(), to.y());
    }
    drawing = wanted(i);
  }
  cairo_stroke(cairo);
}

void draw_path(const Canvas& canvas, const MapLayout& layout, const MapPicture& picture) {
  const std::vector<Pose2>& path = picture.path;
  const auto joined = [&](std::size_t i) {
    const auto& jumps = picture.jumps;
    return std::find(jumps.begin(), jumps.end(), i + 1) == jumps.end();
  };
  const auto flagged = [&](std::size_t i) {
    return i < picture.degenerate.size() && picture.degenerate[i] && joined(i);
  };
  canvas.colour(kDegenerate);
  stroke_path(canvas, layout, path, 12.0 * layout.unit, flagged);
  // The colour changes in small steps, so that each may be one stroke with proper joins.
  constexpr std::size_t kShades = 128;
  const std::size_t pieces = path.size() > 1 ? path.size() - 1 : 0;
  for (std::size_t shade = 0; shade < kShades; ++shade) {
    canvas.colour(along_path((static_cast<double>(shade) + 0.5) / kShades));
    const std::size_t first = pieces * shade / kShades;
    const std::size_t end = pieces * (shade + 1) / kShades;
    stroke_path(canvas, layout, path, 2.6 * layout.unit,
                [&](std::size_t i) { return i >= first && i < end && joined(i); });
  }
}

MapLayout layout_of(const OccupancyGrid& grid, const MapPicture& picture) {
  const GraphPicture& graph = picture.graph;
  std::vector<Pose2> poses = picture.path;
  poses.insert(poses.end(), graph.nodes.begin(), graph.nodes.end());
  const int keys =
      int(!graph.nodes.empty()) + int(!graph.closures.empty()) + int(!graph.revoked.empty());
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
  double keys_end = layout.width - kMargin * unit;
  if (!picture.path.empty()) {
    draw_start(canvas, layout.pixel(picture.path.front().translation()), unit);
    draw_end(canvas, layout.pixel(picture.path.back().translation()), unit);
    const auto& flags = picture.degenerate;
    const bool with_degenerate = std::find(flags.begin(), flags.end(), true) != flags.end();
    keys_end = draw_path_keys(canvas, layout, with_degenerate);
  }
  draw_graph_keys(canvas, layout, picture.graph, keys_end);
  canvas.colour(kInk);
  canvas.text(picture.title, kMargin * unit, 48.0 * unit, 24.0 * unit, true, Align::kLeft);
  draw_scale_bar(canvas, layout);
  canvas.write_png(path);
}

}  // namespace adit
