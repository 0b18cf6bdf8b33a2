// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/exploration_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/grid/grid2.hpp"
#include "common/picture/canvas.hpp"
#include "common/picture/legend.hpp"
#include "common/picture/palette.hpp"

namespace adit {
namespace {

using PictureCell = ExplorationPicture::Cell;

/// The box of the observed cells.
CellBox observed_box(const Grid2<Occupancy>& known) {
  CellBox box{known.box().to, known.box().from};
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] == Occupancy::kUnseen) continue;
    box.from = box.from.cwiseMin(known.cell(i));
    box.to = box.to.cwiseMax(known.cell(i) + Eigen::Vector2i(1, 1));
  }
  return box.empty() ? CellBox{{0, 0}, {1, 1}} : box;
}

PictureCell cell_of_picture(const DrivableSpace& space, const Eigen::Vector2i& cell) {
  const Occupancy known = space.known.get(cell, Occupancy::kUnseen);
  if (known == Occupancy::kUnseen) return PictureCell::kUnseen;
  if (known == Occupancy::kWall) return PictureCell::kWall;
  return space.access.get(cell) == Access::kReachable ? PictureCell::kDrivable : PictureCell::kFree;
}

constexpr int kMarginPx = 24;
constexpr int kHeadPx = 44;
constexpr int kFootPx = 84;
constexpr int kSidePxMax = 4;  // per cell
constexpr int kWidthPxMax = 3200;
constexpr int kWidthPxMin = 640;

constexpr Colour kCannotStand = rgb(0xf1ece0);
constexpr Colour kCorridor = rgb(0x2f6fc1);
constexpr Colour kDeadEnd = rgb(0x33373d);

constexpr std::array<std::pair<const char*, Colour>, 8> kStates{{{"open", rgb(0xe0483e)},
                                                                 {"explored", rgb(0x9fd3b4)},
                                                                 {"blocked", rgb(0x8a4bc0)},
                                                                 {"too narrow", rgb(0xa98d5d)},
                                                                 {"beyond budget", rgb(0xf07800)},
                                                                 {"unobservable", rgb(0x1a9a8f)},
                                                                 {"outside mine", rgb(0x808890)},
                                                                 {"unconfirmed", rgb(0xd45fa8)}}};

Colour colour_of(FrontierState state) { return kStates.at(static_cast<std::size_t>(state)).second; }

class Sheet {
 public:
  explicit Sheet(const ExplorationPicture& picture)
      : picture_(picture),
        columns_(std::max(1, picture.columns)),
        rows_(static_cast<int>(picture.cells.size()) / columns_),
        side_px_(std::clamp(kWidthPxMax / columns_, 1, kSidePxMax)),
        canvas_(std::max(kWidthPxMin, columns_ * side_px_ + 2 * kMarginPx),
                rows_ * side_px_ + kHeadPx + kFootPx) {
    canvas_.colour(kPaper);
    cairo_paint(canvas_.cairo());
  }

  [[nodiscard]] const Canvas& canvas() const { return canvas_; }
  [[nodiscard]] double pixels_per_metre() const { return side_px_ / picture_.cell_m; }
  [[nodiscard]] double foot() const { return kHeadPx + rows_ * side_px_ + kFootPx / 3.0; }

  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector2d& p_map) const {
    const Eigen::Vector2d cells = (p_map - picture_.p_map_corner) / picture_.cell_m;
    return {kMarginPx + side_px_ * cells.x(), kHeadPx + side_px_ * (rows_ - cells.y())};
  }

  void draw_cells() const {
    for (std::size_t i = 0; i < picture_.cells.size(); ++i) {
      const PictureCell cell = picture_.cells[i];
      if (cell == PictureCell::kUnseen) continue;
      canvas_.colour(cell == PictureCell::kWall       ? kWall
                     : cell == PictureCell::kDrivable ? kOpen
                                                      : kCannotStand);
      const auto columns = static_cast<std::size_t>(columns_);
      canvas_.fill_rectangle(kMarginPx + side_px_ * static_cast<int>(i % columns),
                             kHeadPx + side_px_ * (rows_ - 1 - static_cast<int>(i / columns)),
                             side_px_, side_px_);
    }
  }

  void line(const std::vector<Eigen::Vector2d>& points, const Colour& colour, double width) const {
    canvas_.colour(colour);
    cairo_set_line_width(canvas_.cairo(), width);
    for (const Eigen::Vector2d& p : points) {
      const Eigen::Vector2d at = pixel(p);
      cairo_line_to(canvas_.cairo(), at.x(), at.y());
    }
    cairo_stroke(canvas_.cairo());
  }

  void disc(const Eigen::Vector2d& p_map, const Colour& colour, double radius) const {
    const Eigen::Vector2d at = pixel(p_map);
    canvas_.colour(kRim);
    canvas_.disc(at.x(), at.y(), radius + 1.0);
    canvas_.colour(colour);
    canvas_.disc(at.x(), at.y(), radius);
  }

 private:
  const ExplorationPicture& picture_;
  int columns_;
  int rows_;
  int side_px_;
  Canvas canvas_;
};

void draw_corridors(const Sheet& sheet, const CorridorGraph& graph) {
  for (const Corridor& corridor : graph.corridors) sheet.line(corridor.points, kCorridor, 2.5);
  for (const CorridorNode& node : graph.nodes) {
    if (node.kind == CorridorNode::Kind::kOpenEnd) continue;
    const bool junction = node.kind == CorridorNode::Kind::kJunction;
    sheet.disc(node.p_map, junction ? kCorridor : kDeadEnd, junction ? 5.0 : 4.0);
  }
}

/// Draws open frontiers over closed ones.
void draw_frontiers(const Sheet& sheet, const std::vector<Frontier>& frontiers) {
  for (const bool closed : {true, false}) {
    for (const Frontier& frontier : frontiers) {
      if (is_closed(frontier.state) != closed) continue;
      const Colour colour = colour_of(frontier.state);
      const bool explored = frontier.state == FrontierState::kExplored;
      if (!explored)
        sheet.line({frontier.p_map, frontier.p_map + 2.5 * frontier.direction_map}, colour, 3.0);
      sheet.disc(frontier.p_map, colour, explored ? 3.0 : 6.0);
    }
  }
}

void draw_keys(const Sheet& sheet) {
  double x = kMarginPx;
  for (const auto& [name, colour] : kStates) {
    sheet.canvas().colour(colour);
    sheet.canvas().disc(x + 5.0, sheet.foot() - 4.0, 5.0);
    sheet.canvas().colour(kInk);
    sheet.canvas().text(name, x + 14.0, sheet.foot(), 12.0, false, Align::kLeft);
    x += 110.0;
  }
}

}  // namespace

ExplorationPicture exploration_picture(const std::string& title, const Exploration& exploration,
                                       std::vector<Eigen::Vector2d> traversed_path) {
  const DrivableSpace& space = exploration.space();
  const Grid2<PictureCell> cells(observed_box(space.known));
  ExplorationPicture picture;
  picture.title = title;
  picture.cell_m = space.resolution_m;
  picture.p_map_corner = space.resolution_m * cells.box().from.cast<double>();
  picture.columns = cells.box().size().x();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    picture.cells.push_back(cell_of_picture(space, cells.cell(i)));
  }
  picture.report = exploration.report();
  picture.traversed_path = std::move(traversed_path);
  return picture;
}

void write_exploration_png(const ExplorationPicture& picture, const std::filesystem::path& path) {
  const Sheet sheet(picture);
  sheet.draw_cells();
  sheet.line(picture.traversed_path, kStart, 1.0);
  draw_corridors(sheet, picture.report.corridors);
  draw_frontiers(sheet, picture.report.frontiers);
  sheet.canvas().colour(kInk);
  sheet.canvas().text(picture.title, kMarginPx, kHeadPx - 18.0, 16.0, true, Align::kLeft);
  draw_keys(sheet);
  draw_scale_bar(sheet.canvas(), kMarginPx, sheet.foot() + 12.0,
                 scale_bar_m(kWidthPxMin / 4.0 / sheet.pixels_per_metre()),
                 sheet.pixels_per_metre(), 0.8);
  sheet.canvas().write_png(path);
}

}  // namespace adit
