// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/plan_picture.hpp"

#include <algorithm>
#include <cmath>

#include "common/picture/canvas.hpp"
#include "common/picture/palette.hpp"
#include "common/picture/scale_bar.hpp"

namespace adit {
namespace {

constexpr int kCellPx = 3;
constexpr int kKernelCellPx = 4;
constexpr int kGapPx = 24;
constexpr int kHeaderPx = 70;
constexpr int kLabelPx = 40;
constexpr double kTextPx = 15.0;
constexpr double kOutlineEveryM = 1.0;
constexpr double kBlackM = 0.3;  // coefficient of terrain that is drawn black

constexpr RgbImage::Pixel kUnseen{0xd9, 0xd2, 0xc3};
constexpr RgbImage::Pixel kWater{0x7f, 0xb2, 0xd9};
constexpr RgbImage::Pixel kDrop{0x8d, 0x6f, 0xa8};

RgbImage::Pixel pixel_of(const TerrainCell& cell) {
  switch (cell.ground) {
    case Ground::kNoReturn:
      return kWater;
    case Ground::kBelowRay:
      return kDrop;
    case Ground::kNeverSeen:
    case Ground::kShadow:
      return kUnseen;
    case Ground::kSeen:
      break;
  }
  const double easy = 1.0 - std::min(cell.coefficient_m / kBlackM, 1.0);
  const auto grey = static_cast<std::uint8_t>(std::isnan(easy) ? 0.0 : 255.0 * easy);
  return {grey, grey, grey};
}

/// Cells as squares of pixels, the last row at the top.
template <class Pixel>
RgbImage enlarged(int columns, int rows, int cell_px, const Pixel& pixel) {
  RgbImage image(columns * cell_px, rows * cell_px);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      image.at(x, y) = pixel(x / cell_px, rows - 1 - y / cell_px);
    }
  }
  return image;
}

RgbImage enlarged(const GreyCells& cells, int cell_px) {
  return enlarged(cells.columns, cells.rows(), cell_px, [&](int column, int row) {
    const std::uint8_t grey =
        cells.grey[static_cast<std::size_t>(row) * static_cast<std::size_t>(cells.columns) +
                   static_cast<std::size_t>(column)];
    return RgbImage::Pixel{grey, grey, grey};
  });
}

/// A map of the size of the terrain somewhere on the sheet.
class Panel {
 public:
  Panel(const Canvas& canvas, const PlanPicture& picture, int left)
      : canvas_(canvas), picture_(picture), left_(left) {}

  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector2d& p_odom) const {
    const TerrainMap& terrain = picture_.terrain;
    const Eigen::Vector2d p = terrain.T_odom_level.inverse() * p_odom - terrain.p_level_corner;
    return {left_ + p.x() / terrain.cell_m * kCellPx,
            kHeaderPx + (terrain.rows - p.y() / terrain.cell_m) * kCellPx};
  }

  void draw(const RgbImage& image, const std::string& label) const {
    canvas_.image(image, left_, kHeaderPx);
    canvas_.colour(kInk);
    canvas_.text(label, left_, kHeaderPx - 8.0, kTextPx, false, Align::kLeft);
    canvas_.colour(kEnd);
    for (const BlockingCell& cell : picture_.path.blocking) mark(cell.p_odom);
    draw_way();
  }

 private:
  void mark(const Eigen::Vector2d& p_odom) const {
    const Eigen::Vector2d middle = pixel(p_odom);
    canvas_.fill_rectangle(middle.x() - kCellPx / 2.0, middle.y() - kCellPx / 2.0, kCellPx,
                           kCellPx);
  }

  void draw_way() const {
    const auto& points = picture_.path.points;
    cairo_set_line_width(canvas_.cairo(), 1.2);
    double way = kOutlineEveryM;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i > 0)
        way += between(points[i - 1].T_odom_body, points[i].T_odom_body).translation().norm();
      if (way < kOutlineEveryM && i + 1 < points.size()) continue;
      way = 0.0;
      canvas_.colour(along_path(static_cast<double>(i) / static_cast<double>(points.size())));
      draw_outline(points[i].T_odom_body);
    }
    canvas_.colour(kStart);
    for (const PathPoint& point : points) {
      const Eigen::Vector2d at = pixel(point.T_odom_body.translation());
      canvas_.disc(at.x(), at.y(), 1.5);
    }
  }

  void draw_outline(const Pose2& T_odom_body) const {
    const double x = picture_.length_m / 2.0;
    const double y = picture_.width_m / 2.0;
    cairo_new_path(canvas_.cairo());  // text leaves a point behind
    for (const Eigen::Vector2d& corner : {Eigen::Vector2d(-x, -y), Eigen::Vector2d(x, -y),
                                          Eigen::Vector2d(x, y), Eigen::Vector2d(-x, y)}) {
      const Eigen::Vector2d at = pixel(T_odom_body * corner);
      cairo_line_to(canvas_.cairo(), at.x(), at.y());
    }
    cairo_close_path(canvas_.cairo());
    cairo_stroke(canvas_.cairo());
  }

  const Canvas& canvas_;
  const PlanPicture& picture_;
  int left_;
};

int panel_width(const PlanPicture& picture) { return picture.terrain.columns * kCellPx + kGapPx; }

int kernels_top(const PlanPicture& picture) {
  return kHeaderPx + picture.terrain.rows * kCellPx + kGapPx + kLabelPx;
}

Canvas sheet(const PlanPicture& picture) {
  const int panels = 1 + static_cast<int>(picture.slices.size());
  int width = kGapPx;
  int height = 0;
  for (const GreyCells& kernel : picture.kernels) {
    width += kernel.columns * kKernelCellPx + kGapPx;
    height = std::max(height, kernel.rows() * kKernelCellPx + kGapPx);
  }
  return {std::max(width, kGapPx + panels * panel_width(picture)),
          kernels_top(picture) + kLabelPx + height};
}

void draw_kernels(const Canvas& canvas, const PlanPicture& picture) {
  int left = kGapPx;
  for (const GreyCells& kernel : picture.kernels) {
    canvas.image(enlarged(kernel, kKernelCellPx), left, kernels_top(picture) + kLabelPx);
    canvas.colour(kInk);
    canvas.text(kernel.label, left, kernels_top(picture) + kLabelPx - 8.0, kTextPx, false,
                Align::kLeft);
    left += kernel.columns * kKernelCellPx + kGapPx;
  }
}

}  // namespace

void write_plan_png(const PlanPicture& picture, const std::filesystem::path& path) {
  const Canvas canvas = sheet(picture);
  canvas.colour(kOpen);
  cairo_paint(canvas.cairo());
  canvas.colour(kInk);
  canvas.text(picture.title, kGapPx, 30.0, 20.0, true, Align::kLeft);
  const TerrainMap& terrain = picture.terrain;
  const RgbImage ground =
      enlarged(terrain.columns, terrain.rows, kCellPx,
               [&](int column, int row) { return pixel_of(terrain.at(column, row)); });
  int left = kGapPx;
  Panel(canvas, picture, left).draw(ground, "terrain");
  const double pixels_per_metre = kCellPx / terrain.cell_m;
  const double bar_m = scale_bar_m(terrain.columns * terrain.cell_m / 4.0);
  draw_scale_bar(canvas, left, kernels_top(picture) - kLabelPx - 8.0, bar_m, pixels_per_metre, 1.0);
  for (const GreyCells& slice : picture.slices) {
    left += panel_width(picture);
    Panel(canvas, picture, left).draw(enlarged(slice, kCellPx), slice.label);
  }
  draw_kernels(canvas, picture);
  canvas.write_png(path);
}

}  // namespace adit
