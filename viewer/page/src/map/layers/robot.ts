// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Layers of the present: the robot and the returns of its lasers. */
import type { Laser } from "../../state/model";
import { apply, poseInMap, yawOf, type Pose } from "../../state/pose";
import { colour } from "../../theme";
import type { Brush } from "../brush";
import type { Layer } from "./layer";

const kScanAge_s = 2.5;  // older returns do not show what is around the robot now
const kTransformAge_s = 0.3;

function drawReturns(brush: Brush, laser: Laser, T_map_laser: Pose): void {
  const { ranges, start_rad, end_rad } = laser;
  const step_rad = ranges.length > 1 ? (end_rad - start_rad) / (ranges.length - 1) : 0;
  brush.context.fillStyle = colour("laser");
  ranges.forEach((range_m, i) => {
    if (range_m <= 0 || !Number.isFinite(range_m)) return;
    const angle_rad = start_rad + i * step_rad;
    const [x, y] = apply(T_map_laser, range_m * Math.cos(angle_rad), range_m * Math.sin(angle_rad), 0);
    const [px, py] = brush.camera.toScreen(x, y);
    brush.context.fillRect(px - 1, py - 1, 2, 2);
  });
}

export const kLasers: Layer = {
  key: "lasers", label: "lasers now", swatch: "laser", on: true,
  draw({ brush, model, time_s }) {
    for (const timeline of [model.laserFront, model.laserRear]) {
      const found = timeline.at(time_s);
      if (!found || time_s - found.time_s > kScanAge_s) continue;
      const transforms = model.tf.at(found.time_s + kTransformAge_s);
      const T_map_laser = transforms && found.time_s - transforms.time_s < kTransformAge_s ? poseInMap(transforms.value, found.value.frame) : null;
      if (T_map_laser) drawReturns(brush, found.value, T_map_laser);
    }
  },
};

export const kRobot: Layer = {
  key: "robot", label: "robot now", swatch: "robot", on: true,
  draw({ brush, model, time_s }) {
    const robot = model.robotAt(time_s);
    if (robot) brush.symbol(robot.x, robot.y, yawOf(robot), [[13, 0], [-9, 8], [-5, 0], [-9, -8]], colour("robot"));
  },
};
