// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/terrain_svg.hpp"

#include "tools/report/data_uri.hpp"
#include "tools/report/indexed_png.hpp"
#include "tools/report/svg_parts.hpp"
#include "tools/report/terrain_overlay.hpp"
#include "tools/report/text.hpp"

namespace adit {
namespace {

constexpr double kAroundM = 0.6;
constexpr double kLeastSideM = 6.0;

RgbImage cut(const RgbImage& image, const CellBox& box) {
  RgbImage part(box.size().x(), box.size().y());
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x) {
      part.at(x, y) = image.at(box.from.x() + x, image.height - box.to.y() + y);
    }
  }
  return part;
}

}  // namespace

CellBox box_to_show(const ScanToDraw& scan) {
  const TerrainMap& terrain = *scan.terrain;
  const Eigen::Vector2i size(terrain.columns, terrain.rows);
  CellBox box{size, {0, 0}};
  const auto include = [&](const Eigen::Vector2d& p_level, double around_m) {
    const Eigen::Vector2d around = Eigen::Vector2d::Constant(around_m);
    const auto cell = [&](const Eigen::Vector2d& p) {
      return Eigen::Vector2i(
          ((p - terrain.p_level_corner) / terrain.cell_m).array().floor().cast<int>());
    };
    box.from = box.from.cwiseMin(cell(p_level - around));
    box.to = box.to.cwiseMax(cell(p_level + around) + Eigen::Vector2i(1, 1));
  };
  include(Eigen::Vector2d::Zero(), kLeastSideM / 2.0);
  for (int row = 0; row < terrain.rows; ++row) {
    for (int column = 0; column < terrain.columns; ++column) {
      if (terrain.at(column, row).count > 0) include(terrain.centre(column, row), kAroundM);
    }
  }
  box.from = box.from.cwiseMax(Eigen::Vector2i(0, 0));
  box.to = box.to.cwiseMin(size);
  return box.empty() ? CellBox{{0, 0}, size} : box;
}

std::string terrain_svg(const ScanToDraw& scan, const RgbImage& cells, const CellBox& box,
                        const Vehicle& vehicle, const std::string& label) {
  const CellView view(*scan.terrain, box);
  const std::string width = std::to_string(box.size().x());
  const std::string height = std::to_string(box.size().y());
  std::string svg = "<svg class=\"cells\" viewBox=\"0 0 " + width + " " + height +
                    "\" role=\"img\" aria-label=\"" + escaped(label) + "\"><image width=\"" +
                    width + "\" height=\"" + height + "\" href=\"" +
                    data_uri("image/png", indexed_png(cut(cells, box))) + "\"/>";
  if (scan.goal) svg += svg_goal(view, *scan.goal);
  if (scan.path) svg += svg_path(view, *scan.path, vehicle) + svg_blocking(view, *scan.path);
  svg += svg_outline(view, {}, vehicle, "robot");
  const Eigen::Vector2d ahead = view.at(Eigen::Vector2d(0.4 * vehicle.length_m, 0.0));
  const Eigen::Vector2d left = view.at(Eigen::Vector2d(0.0, 0.35 * vehicle.width_m));
  const Eigen::Vector2d right = view.at(Eigen::Vector2d(0.0, -0.35 * vehicle.width_m));
  svg += std::string("<polygon class=\"ahead\" points=\"") + svg_point(ahead) + " " +
         svg_point(left) + " " + svg_point(right) + "\"/></svg>";
  return svg;
}

}  // namespace adit
