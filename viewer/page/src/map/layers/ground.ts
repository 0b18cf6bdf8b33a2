// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** The occupancy map below all layers, in the colours of occupancy or of coverage. */
import type { Grid } from "../../state/grid";
import type { Brush } from "../brush";
import type { Raster, Shading } from "../raster";

export function drawGround(brush: Brush, grid: Grid, raster: Raster, shading: Shading): void {
  const cell_px = grid.cell_m * brush.camera.scale;
  const { image, factor } = raster.at(grid, shading, cell_px);
  const size_px = cell_px * factor;
  const rows = Math.ceil(grid.height / factor);
  brush.at(grid.x, grid.y, Math.atan2(grid.sin, grid.cos), (context) => {
    context.imageSmoothingEnabled = size_px < 1;
    context.drawImage(image, 0, -rows * size_px, image.width * size_px, rows * size_px);
  });
}
