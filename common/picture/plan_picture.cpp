// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/plan_picture.hpp"

#include <algorithm>

#include "common/picture/palette.hpp"
#include "common/picture/plan_overlay.hpp"
#include "common/picture/sheet.hpp"
#include "common/picture/terrain_layer.hpp"
#include "common/picture/text_block.hpp"

namespace adit {
namespace {

constexpr double kGap = 24.0;
constexpr double kSheet = 1440.0;  // width, as of the slices
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

/// The last row at the top.
RgbImage image_of(const GreyCells& cells) {
  RgbImage image(cells.columns, cells.rows());
  for (std::size_t i = 0; i < cells.grey.size(); ++i) {
    const int row = static_cast<int>(i) / cells.columns;
    image.at(static_cast<int>(i) % cells.columns, image.height - 1 - row) = {
        cells.grey[i], cells.grey[i], cells.grey[i]};
  }
  return image;
}

double draw_path(const Canvas& canvas, const PlanPicture& picture, double left, double top,
                 double width, const Legend& more) {
  const MapPanel panel(canvas, picture.terrain, left, top, width);
  panel.draw(reached_image(picture),
             picture.path.points.empty() ? "What is in the way" : "The path");
  draw_plan(panel, picture);
  Legend legend = plan_legend(picture);
  legend.insert(legend.end(), more.begin(), more.end());
  return panel.finish(legend);
}

double draw_layer(const Canvas& canvas, const PlanPicture& picture, TerrainLayer layer, double left,
                  double top, double width) {
  const MapPanel panel(canvas, picture.terrain, left, top, width);
  panel.draw(terrain_image(picture.terrain, layer), title_of(layer));
  panel.draw_vehicle({}, picture.length_m, picture.width_m);
  return panel.finish(legend_of(layer));
}

double draw_slices(const Canvas& canvas, const PlanPicture& picture, double left, double top,
                   int in_a_row) {
  const double width = (kSheet - (in_a_row - 1) * kGap) / in_a_row;
  double bottom = top;
  for (std::size_t i = 0; i < picture.slices.size(); ++i) {
    const auto place = static_cast<int>(i) % in_a_row;
    if (place == 0) top = bottom;
    const MapPanel panel(canvas, picture.terrain, left + place * (width + kGap), top, width);
    panel.draw(image_of(picture.slices[i]), picture.slices[i].label);
    draw_way(panel, picture.path);
    bottom = std::max(bottom, panel.bottom() + kGap / 2.0);
  }
  const Legend legend{{grey(PlanPicture::kEvenGrey), "even to rough", grey(PlanPicture::kDearGrey)},
                      {grey(PlanPicture::kUnseenGrey), "too much that is not seen", {}},
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
    canvas.image(image_of(kernel), x, top + kLabel, side, side);
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

/// The scan, or the terrain where there is no view of it, beside the path; below, the layers.
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
