// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
import { describe, expect, it } from "vitest";
import { Labels } from "../../src/map/labels";
import { Camera, roundStep } from "../../src/map/camera";
import { widthAt } from "../../src/map/width";
import { decodePlaybackState, encodePlaybackRequest } from "../../src/protocol/playback";
import { readRecords } from "../../src/protocol/embedded";
import { Chainage } from "../../src/state/chainage";
import { coverageAreas } from "../../src/state/grid";
import { countUpTo, sortedByScan } from "../../src/state/cloud";
import { memoized } from "../../src/state/memoized";
import { Model } from "../../src/state/model";
import { countWhile } from "../../src/state/search";
import { Series } from "../../src/state/series";
import { Timeline } from "../../src/state/timeline";
import { frontiersOf, hazardsOf } from "../../src/state/scene";
import { embeddedBytes } from "../synthetic/embed";
import { kDriftWidth_m, kDuration_s, kStart_s, kTunnelWidth_m, robotAt } from "../synthetic/mine";

const model = new Model();
readRecords(embeddedBytes(), model);
const kEnd_s = kStart_s + kDuration_s;

describe("a mission in a file", () => {
  it("is decoded by its advertised schemas", () => {
    expect(model.faultCount).toBe(0);
    expect([model.start_s, model.end_s]).toEqual([kStart_s, kEnd_s]);
    expect(model.history.length).toBe(kDuration_s + 1);
    expect(frontiersOf(model.frontiers.at(kEnd_s)!.value).map((f) => f.state)).toContain("too narrow");
    const water = hazardsOf(model.hazards.at(kEnd_s)!.value).find((h) => h.kind === "water")!;
    expect([water.x, water.value, water.unit]).toEqual([106, "0.45", "m"]);
    expect(model.volume.at(kEnd_s)!.value.count).toBe(30000);
  });
  it("has the robot where it was at each time", () => {
    for (const t of [0, 33.5, 99, 150]) expect(model.robotAt(kStart_s + t)!.x).toBeCloseTo(robotAt(t).x, 6);
  });
  it("is used up to a damaged end", () => {
    const part = new Model();
    readRecords(embeddedBytes().subarray(0, -7), part);
    expect(part.faultCount).toBe(1);
    expect(part.history.length).toBe(kDuration_s + 1);
  });
});

describe("width", () => {
  const grid = model.map.at(kEnd_s)!.value;
  it("is that of the tunnel, off its axis too", () => {
    // The mine is aligned with the cells, so no cell is lost; 1 degree of direction adds less than 1 mm.
    for (const y of [0.04, -1.3, 1.7]) expect(widthAt(grid, 30, y)!.width_m).toBeCloseTo(kTunnelWidth_m, 2);
    expect(widthAt(grid, 60.3, 20)!.width_m).toBeCloseTo(kDriftWidth_m, 2);
  });
  it("is that between the walls where posts stand in the tunnel", () => {
    for (const x of [42.05, 44.3, 45, 46.05, 48.1]) expect(widthAt(grid, x, 0)!.width_m).toBeCloseTo(kTunnelWidth_m, 2);
    expect(widthAt(grid, 44.1, 1.3)!.width_m).toBeCloseTo(kTunnelWidth_m, 2);
  });
  it("is none in walls and unknown ground", () => {
    expect(widthAt(grid, 30, 2.15)).toBeNull();
    expect(widthAt(grid, 30, 20)).toBeNull();
  });
});

describe("coverage", () => {
  it("is the area of the ground that is not wall", () => {
    const areas_m2 = coverageAreas(model.map.at(kEnd_s)!.value);
    expect(areas_m2[3]).toBeCloseTo(98, 0);  // 1 m wide, until 12 m before the end of the map at 110 m
    expect(areas_m2[1]).toBeCloseTo(20 * kDriftWidth_m, 0);  // of the drift from y = 10 m to 30 m
  });
});

describe("chainage", () => {
  const line = new Chainage(Float64Array.from([0, 0, 0, 10, 0, 0, 10, 5, 0]));
  it("goes along the line", () => {
    expect(line.length_m).toBe(15);
    expect(line.pointAt(12)).toEqual([10, 2]);
    expect(line.pointAt(16)).toBeNull();
  });
  it("finds the nearest point", () => {
    expect(line.nearest(11, 3)).toEqual({ distance_m: 13, offset_m: 1 });
  });
  it("is that of the first visit of a place", () => {
    const twice = new Chainage(Float64Array.from([0, 0, 0, 10, 0, 0, 4, 0, 0, 10.5, 0, 0]));
    expect(twice.nearest(12, 0)).toEqual({ distance_m: 10, offset_m: 2 });
  });
  it("does not count going to and fro", () => {
    const twice = new Chainage(Float64Array.from([0, 0, 0, 10, 0, 0, 4, 0, 0, 20, 0.2, 0]));
    expect(twice.length_m).toBeCloseTo(20, 1);
  });
  it("is the same in two branches, and goes the shorter way back from a dead end", () => {
    const branches = new Chainage(Float64Array.from([0, 0, 0, 10, 0, 0, 10, 6, 0, 10, 0, 0, 10, -8, 0]));
    expect(branches.length_m).toBeCloseTo(18, 0);  // the corner of the junction may be cut, by less than a step
    const [left, right] = branches.pointsAt(14);
    expect(left![1]).toBeCloseTo(4);
    expect(right![1]).toBeCloseTo(-4, 0);
  });
  it("tells levels apart", () => {
    const ramp = new Chainage(Float64Array.from([0, 0, 0, 20, 0, 0, 20, 20, -3, 10, 20, -5, 10, -5, -5]));
    expect(ramp.nearest(10, -5).distance_m).toBeCloseTo(75);
  });
});

describe("cloud", () => {
  const cloud = { count: 4, received: 4, xyz: Float32Array.from([3, 0, 0, 1, 0, 0, 2, 0, 0, 1.5, 0, 0]), scan: Uint16Array.from([3, 1, 2, 1]), clearance: Uint8Array.from([30, 10, 20, 15]) };
  it("is put in the order of its scans", () => {
    const sorted = sortedByScan(cloud);
    expect([[...sorted.scan!], [...sorted.clearance!], sorted.xyz[3]]).toEqual([[1, 1, 2, 3], [10, 15, 20, 30], 1.5]);
    expect([0, 1, 2, 9].map((scan) => countUpTo(sorted, scan))).toEqual([0, 2, 3, 4]);
  });
});

describe("search and derived values", () => {
  it("counts as a linear search does", () => {
    for (const numbers of [[], [1], [1, 1, 2], [0, 1, 1, 4, 9]]) {
      for (let limit = -1; limit <= 10; ++limit) {
        expect(countWhile(numbers.length, (i) => numbers[i]! <= limit)).toBe(numbers.filter((n) => n <= limit).length);
      }
    }
  });
  it("derives once for each message", () => {
    let calls = 0;
    const size = memoized((message: number[]) => { ++calls; return message.length; });
    const [a, b] = [[1, 2], [1, 2, 3]];
    expect([size(a), size(b), size(a)]).toEqual([2, 3, 2]);
    expect(calls).toBe(2);
  });
});

describe("timeline", () => {
  const bytes = (n: number) => new Uint8Array(n);
  it("stays within its budget and keeps first and last", () => {
    const timeline = new Timeline((data) => data.length, 1000, () => {});
    for (let t = 0; t < 500; ++t) timeline.add(t, bytes(100));
    expect(timeline.size).toBeLessThanOrEqual(1000);
    expect([timeline.first_s, timeline.last_s]).toEqual([0, 499]);
  });
  it("counts what cannot be decoded once and shows what precedes it", () => {
    let bad = 0;
    const timeline = new Timeline((data) => { if (data.length === 2) throw new Error(); return data.length; }, 1000, () => ++bad);
    timeline.add(1, bytes(1));
    timeline.add(2, bytes(2));
    expect([timeline.at(3)!.value, timeline.at(3)!.value, bad]).toEqual([1, 1, 1]);
    expect(timeline.at(0)).toBeNull();
  });
});

describe("series", () => {
  it("is bounded and keeps extremes of old samples", () => {
    const series = new Series(64);
    for (let t = 0; t < 1000; ++t) series.add(t, t === 7 ? 99 : t === 9 ? -99 : Math.sin(t));
    expect(series.t.length).toBeLessThanOrEqual(64);
    expect([Math.max(...series.v), Math.min(...series.v)]).toEqual([99, -99]);
    expect(series.t).toEqual([...series.t].sort((a, b) => a - b));
  });
});

describe("map", () => {
  it("zooms about the pointer", () => {
    const camera = new Camera();
    [camera.width, camera.height] = [800, 600];
    const before = camera.toMap(100, 50);
    camera.zoom(3, 100, 50);
    camera.toMap(100, 50).forEach((v, i) => expect(v).toBeCloseTo(before[i]!, 9));
  });
  it("places no label on another", () => {
    const labels = new Labels();
    expect([labels.take(0, 0, 10, 10), labels.take(5, 5, 10, 10), labels.take(10, 0, 10, 10)]).toEqual([true, false, true]);
  });
  it("places a text on another side of its symbol where the first is taken", () => {
    const labels = new Labels();
    labels.block(-5, -5, 10, 10);
    expect(labels.beside(0, 0, 40, 14, 8)).toEqual({ x: 8, y: -7 });
    expect(labels.beside(0, 0, 40, 14, 8)).toEqual({ x: -48, y: -7 });
  });
  it("steps in 1, 2, 5", () => { expect([roundStep(7), roundStep(0.3), roundStep(13)]).toEqual([5, 0.2, 10]); });
});

describe("playback", () => {
  it("has the bytes of the protocol", () => {
    const request = encodePlaybackRequest({ play: false, speed: 2, seek_s: 1.5, id: "a" });
    expect([...request]).toEqual([3, 1, 0, 0, 0, 64, 1, 0, 47, 104, 89, 0, 0, 0, 0, 1, 0, 0, 0, 97]);
    expect(decodePlaybackState(Uint8Array.from([5, 1, 0, 47, 104, 89, 0, 0, 0, 0, 0, 0, 0, 64, 0, 0, 0, 0]))).toEqual({ status: "paused", current_s: 1.5, speed: 2 });
    expect(() => decodePlaybackState(Uint8Array.from([5, 9]))).toThrow();
  });
});
