// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/graph_overlay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "common/picture/palette.hpp"

namespace adit {
namespace {

using Edge = GraphPicture::Edge;

struct Pen {
  Colour colour;
  double width;  // units
  double end;    // radius of a dot at either end, units
  bool dashed = false;
};

constexpr double kNodeRadius = 3.4;  // units
constexpr Pen kSequentialPen{kGraph, 1.2, 0.0};
constexpr Pen kClosurePen{kClosure, 3.2, 4.2};
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

/// Edges in pixels; those that stand out have a pale rim, so that they show on walls and path.
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

/// How much finer than in the key the graph is drawn, so that nodes at the usual distance stay
/// apart: 1 or less.
double fineness(const MapLayout& layout, const std::vector<Pose2>& nodes) {
  constexpr double kFinest = 0.4;
  std::vector<double> gaps;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    gaps.push_back((nodes[i].translation() - nodes[i - 1].translation()).norm());
  }
  if (gaps.empty()) return 1.0;
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  const double wanted_radius = 0.12 * *middle * layout.pixels_per_metre;
  return std::clamp(wanted_radius / (kNodeRadius * layout.unit), kFinest, 1.0);
}

}  // namespace

void draw_graph(const Canvas& canvas, const MapLayout& layout, const GraphPicture& graph) {
  const double unit = fineness(layout, graph.nodes) * layout.unit;
  draw_edges(canvas, on_sheet(layout, graph.sequential), kSequentialPen, unit);
  for (const Pose2& node : graph.nodes) {
    draw_node(canvas, layout.pixel(node.translation()), kNodeRadius * unit);
  }
  // What matters most stays readable longest.
  const double unit_of_closures = std::sqrt(unit * layout.unit);
  draw_edges(canvas, on_sheet(layout, graph.revoked), kRevokedPen, unit_of_closures);
  draw_edges(canvas, on_sheet(layout, graph.closures), kClosurePen, unit_of_closures);
}

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
  if (!graph.closures.empty()) key("closures", kClosurePen, false);
  if (!graph.nodes.empty()) key("local maps", kSequentialPen, true);
}

}  // namespace adit
