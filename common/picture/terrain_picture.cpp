// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/terrain_picture.hpp"

#include "common/picture/map_panel.hpp"
#include "common/picture/palette.hpp"
#include "common/picture/sheet.hpp"

namespace adit {
namespace {

constexpr double kWidth = 800.0;

}  // namespace

void write_terrain_png(const TerrainMap& map, const std::filesystem::path& path,
                       TerrainLayer layer) {
  write_sheet(path, kWidth, [&](const Canvas& canvas, double left, double top) {
    const MapPanel panel(canvas, map, left, top, kWidth);
    panel.draw(terrain_image(map, layer), title_of(layer));
    const Eigen::Vector2d body = panel.pixel({0.0, 0.0});
    canvas.colour(kOpen);
    canvas.disc(body.x(), body.y(), 9.0);
    canvas.colour(kStart);
    canvas.disc(body.x(), body.y(), 7.0);
    Legend legend = legend_of(layer);
    legend.push_back({kStart, "the robot", {}});
    return panel.finish(legend);
  });
}

}  // namespace adit
