// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/plan_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/picture/canvas.hpp"
#include "common/picture/map_panel.hpp"
#include "common/picture/palette.hpp"
#include "common/picture/terrain_picture.hpp"

namespace adit {
namespace {

constexpr double kOutlineEveryM = 1.0;
constexpr double kGoalRadiusPx = 9.0;
constexpr Colour kReached = rgb(0x3fb56b);
constexpr double kReachedShare = 0.4;
constexpr Colour kGoal = rgb(0x0b5fff);

struct ReasonColour {
  Colour colour;
  const char* name;
};
/// In the order of BlockingCell::Reason, of which kDrop is the last.
constexpr std::array<ReasonColour, 7> kReasons = {{{rgb(0xff00b8), "a step"},
                                                   {rgb(0xe0182d), "too high to drive over"},
                                                   {rgb(0x7b1fa2), "the roof"},
                                                   {rgb(0xf2c200), "not observed"},
                                                   {rgb(0x1560bd), "water?"},
                                                   {rgb(0x7a4a21), "too steep"},
                                                   {rgb(0x008b8b), "a drop"}}};

static_assert(kReasons.size() == static_cast<std::size_t>(BlockingCell::Reason::kDrop) + 1);

const ReasonColour& reason_of(const BlockingCell& cell) {
  return kReasons[static_cast<std::size_t>(cell.reason)];
}

Pose2 in_level(const MapPanel& panel, const Pose2& T_odom) {
  return between(panel.terrain().T_odom_level, T_odom);
}

void draw_blocking(const MapPanel& panel, const PlannedPath& path) {
  const double side = std::max(panel.cell_px(), 3.0);
  for (const BlockingCell& cell : path.blocking) {
    const Eigen::Vector2d at = panel.pixel(panel.terrain().T_odom_level.inverse() * cell.p_odom);
    panel.canvas().colour(reason_of(cell).colour);
    panel.canvas().fill_rectangle(at.x() - side / 2.0, at.y() - side / 2.0, side, side);
  }
}

void draw_outlines(const MapPanel& panel, const PlanPicture& picture) {
  const auto& points = picture.path.points;
  cairo_set_line_width(panel.canvas().cairo(), 1.4);
  double since_outline_m = kOutlineEveryM;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) {
      since_outline_m +=
          between(points[i - 1].T_odom_body, points[i].T_odom_body).translation().norm();
    }
    if (since_outline_m < kOutlineEveryM && i + 1 < points.size()) continue;
    since_outline_m = 0.0;
    panel.canvas().colour(along_path(static_cast<double>(i) / static_cast<double>(points.size())));
    panel.outline(in_level(panel, points[i].T_odom_body), picture.outline);
  }
}

/// In pixels, to the end of the goal: its route, or a straight line along its direction; of a goal
/// pose only its place.
std::vector<Eigen::Vector2d> line_to(const MapPanel& panel, const PlanGoal& goal) {
  std::vector<Eigen::Vector2d> line;
  const Pose2 T_level_odom = panel.terrain().T_odom_level.inverse();
  for (const Eigen::Vector2d& p_odom : goal.route_odom)
    line.push_back(panel.pixel(T_level_odom * p_odom));
  if (!line.empty()) return line;
  const Pose2 T_level_goal = T_level_odom * goal.T_odom_goal;
  line.push_back(panel.pixel(T_level_goal.translation()));
  if (goal.kind == PlanGoal::Kind::kAlong)
    line.push_back(panel.pixel(T_level_goal * Eigen::Vector2d(goal.distance_m, 0.0)));
  return line;
}

/// A dashed line to the goal and a ring at its end.
void draw_goal(const MapPanel& panel, const PlanGoal& goal) {
  cairo_t* const cairo = panel.canvas().cairo();
  const std::vector<Eigen::Vector2d> line = line_to(panel, goal);
  panel.canvas().colour(kGoal);
  cairo_set_line_width(cairo, 2.0);
  const std::array<double, 2> dashes{4.0, 6.0};
  cairo_set_dash(cairo, dashes.data(), 2, 0.0);
  cairo_new_path(cairo);
  for (const Eigen::Vector2d& p : line) cairo_line_to(cairo, p.x(), p.y());
  cairo_stroke(cairo);
  cairo_set_dash(cairo, nullptr, 0, 0.0);
  cairo_arc(cairo, line.back().x(), line.back().y(), kGoalRadiusPx, 0.0, 6.3);
  cairo_stroke(cairo);
}

void tint(RgbImage::Pixel& pixel) {
  const Colour was{pixel[0] / 255.0, pixel[1] / 255.0, pixel[2] / 255.0};
  pixel = rgb_pixel(blend(was, kReached, kReachedShare));
}

/// The terrain in grey, and the reached region over it if there is no path.
RgbImage reached_image(const PlanPicture& picture) {
  RgbImage image = terrain_image(picture.terrain);
  if (picture.reached.size() != picture.terrain.cells.size()) return image;
  for (std::size_t i = 0; i < picture.reached.size(); ++i) {
    if (picture.reached[i] == 0) continue;
    const int row = static_cast<int>(i) / image.width;
    tint(image.at(static_cast<int>(i) % image.width, image.height - 1 - row));
  }
  return image;
}

/// Draws the path of the vehicle's centre only: for small maps.
void draw_path_line(const MapPanel& panel, const PlannedPath& path) {
  panel.canvas().colour(kStart);
  const double radius = std::clamp(panel.cell_px() / 2.0, 1.0, 2.0);
  for (const PathPoint& point : path.points) {
    const Eigen::Vector2d at = panel.pixel(in_level(panel, point.T_odom_body).translation());
    panel.canvas().disc(at.x(), at.y(), radius);
  }
}

/// Draws on a terrain map: the goal, the path with the outline of the vehicle every metre, the
/// blocking cells in the colour of their reason, and the robot.
void draw_plan(const MapPanel& panel, const PlanPicture& picture) {
  panel.clip();
  if (picture.goal) draw_goal(panel, *picture.goal);
  draw_outlines(panel, picture);
  draw_path_line(panel, picture.path);
  draw_blocking(panel, picture.path);
  panel.draw_vehicle({}, picture.outline);
  panel.unclip();
}

Legend plan_legend(const PlanPicture& picture) {
  Legend legend{{kStart, "the robot", {}}};
  if (picture.goal) legend.push_back({kGoal, "the goal", {}});
  if (!picture.path.points.empty()) {
    legend.push_back({along_path(0.0), "outline along the path", along_path(1.0)});
  }
  if (!picture.reached.empty()) {
    legend.push_back({kReached, "reachable by its centre", {}});
  }
  std::array<bool, kReasons.size()> named{};
  for (const BlockingCell& cell : picture.path.blocking) {
    bool& done = named[static_cast<std::size_t>(cell.reason)];
    if (!done)
      legend.push_back(
          {reason_of(cell).colour, std::string("blocked by: ") + reason_of(cell).name, {}});
    done = true;
  }
  return legend;
}

constexpr double kGap = 24.0;
constexpr double kSheet = 1440.0;  // width of a sheet
constexpr double kPathWidth = 800.0;
constexpr TextStyle kTitle{.size = 21.0, .line = 30.0, .bold = true};
constexpr TextStyle kFact{.size = 17.0, .line = 26.0};
constexpr double kLabel = 22.0;
constexpr double kLabelText = 15.0;

Colour grey(std::uint8_t value) { return {value / 255.0, value / 255.0, value / 255.0}; }

double draw_title(const Canvas& canvas, const std::string& title, double left, double top,
                  double width) {
  canvas.colour(kInk);
  return draw_text_block(canvas, title, left, top, width, kTitle) + kGap / 2.0;
}

double draw_path(const Canvas& canvas, const PlanPicture& picture, double left, double top,
                 double width, const Legend& more) {
  const MapPanel panel(canvas, picture.terrain, left, top, width);
  panel.draw(reached_image(picture),
             picture.path.points.empty() ? "What blocks the path" : "The path");
  draw_plan(panel, picture);
  Legend legend = plan_legend(picture);
  legend.insert(legend.end(), more.begin(), more.end());
  return panel.finish(legend);
}

double draw_layer(const Canvas& canvas, const PlanPicture& picture, TerrainLayer layer, double left,
                  double top, double width) {
  const MapPanel panel(canvas, picture.terrain, left, top, width);
  panel.draw(terrain_image(picture.terrain, layer), title_of(layer));
  panel.draw_vehicle({}, picture.outline);
  return panel.finish(legend_of(layer));
}

double draw_slices(const Canvas& canvas, const PlanPicture& picture, double left, double top,
                   int columns) {
  const double width = (kSheet - (columns - 1) * kGap) / columns;
  double bottom = top;
  for (std::size_t i = 0; i < picture.slices.size(); ++i) {
    const auto place = static_cast<int>(i) % columns;
    if (place == 0) top = bottom;
    const MapPanel panel(canvas, picture.terrain, left + place * (width + kGap), top, width);
    panel.draw(grey_image(picture.slices[i]), picture.slices[i].label);
    draw_path_line(panel, picture.path);
    bottom = std::max(bottom, panel.bottom() + kGap / 2.0);
  }
  const Legend legend{
      {grey(PlanPicture::kFlatGrey), "even to rough", grey(PlanPicture::kCostlyGrey)},
      {grey(PlanPicture::kUnknownGrey), "too much unobserved ground", {}},
      {grey(PlanPicture::kLethalGrey), "not passable at this heading", {}},
      {kStart, "the path", {}}};
  return draw_legend(canvas, legend, left, bottom, kSheet) + kGap / 2.0;
}

double draw_kernels(const Canvas& canvas, const PlanPicture& picture, double left, double top) {
  const auto count = static_cast<double>(std::max<std::size_t>(picture.kernels.size(), 1));
  const double side = (kSheet - (count - 1.0) * kGap) / count;
  double x = left;
  for (const GreyCells& kernel : picture.kernels) {
    canvas.colour(kInk);
    canvas.text(kernel.label, x, top + kLabelText, kLabelText, false, Align::kLeft);
    canvas.fill_rectangle(x - 1.0, top + kLabel - 1.0, side + 2.0, side + 2.0);
    canvas.image(grey_image(kernel), x, top + kLabel, side, side);
    x += side + kGap;
  }
  const Legend legend{
      {grey(PlanPicture::kWheelGrey), "under the wheels: most of the weight", {}},
      {grey(PlanPicture::kBetweenGrey), "between them: little", {}},
      {grey(PlanPicture::kMarginGrey), "no weight, but no obstacle may be there", {}}};
  return draw_legend(canvas, legend, left, top + kLabel + side + kGap / 2.0, kSheet);
}

double draw_scan(const Canvas& canvas, const PlanPicture& picture, double left, double top,
                 double width) {
  canvas.colour(kInk);
  top = draw_text_block(canvas, "The scan, from behind the robot", left, top, width, kFact);
  const double height = width * picture.scan->height / picture.scan->width;
  canvas.image(*picture.scan, left, top, width, height);
  top += height + kGap;
  canvas.colour(kInk);
  for (const std::string& fact : picture.facts) {
    top = draw_text_block(canvas, fact, left, top, width, kFact);
  }
  return top;
}

/// The 3D scan, or the terrain if there is no view of it, beside the path; the layers below.
double draw_maps(const Canvas& canvas, const PlanPicture& picture, double left, double top) {
  const double half = (kSheet - kGap) / 2.0;
  const double third = (kSheet - 2.0 * kGap) / 3.0;
  double bottom = draw_path(canvas, picture, left + half + kGap, top, half, {});
  if (picture.scan) {
    bottom = std::max(bottom, draw_scan(canvas, picture, left, top, half));
  } else {
    const double end = draw_layer(canvas, picture, TerrainLayer::kCoefficient, left, top, half);
    bottom = std::max(bottom, end);
  }
  top = bottom + kGap;
  for (const TerrainLayer layer :
       {TerrainLayer::kCoefficient, TerrainLayer::kClearance, TerrainLayer::kKnowledge}) {
    bottom = std::max(bottom, draw_layer(canvas, picture, layer, left, top, third));
    left += third + kGap;
  }
  return bottom + kGap;
}

}  // namespace

RgbImage grey_image(const GreyCells& cells) {
  RgbImage image(cells.grey.columns(), cells.grey.rows());
  for (std::size_t i = 0; i < cells.grey.size(); ++i) {
    const Eigen::Vector2i cell = cells.grey.cell(i) - cells.grey.box().from;
    const std::uint8_t value = cells.grey[i];
    image.at(cell.x(), image.height - 1 - cell.y()) = {value, value, value};
  }
  return image;
}

void write_path_png(const PlanPicture& picture, const std::filesystem::path& path) {
  write_sheet(path, kPathWidth, [&](const Canvas& canvas, double left, double top) {
    top = draw_title(canvas, picture.title, left, top, kPathWidth);
    return draw_path(canvas, picture, left, top, kPathWidth, legend_of(TerrainLayer::kCoefficient));
  });
}

void write_slices_png(const PlanPicture& picture, const std::filesystem::path& path) {
  write_sheet(path, kSheet, [&](const Canvas& canvas, double left, double top) {
    return draw_slices(canvas, picture, left, top, 4);
  });
}

void write_kernels_png(const PlanPicture& picture, const std::filesystem::path& path) {
  write_sheet(path, kSheet, [&](const Canvas& canvas, double left, double top) {
    return draw_kernels(canvas, picture, left, top);
  });
}

void write_plan_png(const PlanPicture& picture, const std::filesystem::path& path) {
  write_sheet(path, kSheet, [&](const Canvas& canvas, double left, double top) {
    top = draw_title(canvas, picture.title, left, top, kSheet);
    top = draw_maps(canvas, picture, left, top);
    top = draw_slices(canvas, picture, left, top, 8);
    return draw_kernels(canvas, picture, left, top);
  });
}

}  // namespace adit
