// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** The 3D scans as points: orbit, colour, clip height, coordinates of a clicked point, distance of two. */
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { el, fixed } from "../dom";
import { kClearanceUnit_m, type Cloud } from "../state/cloud";
import type { Model } from "../state/model";
import { colour, themeGeneration } from "../theme";

type Colouring = "height" | "scan" | "clearance";
const kPick_px = 8;

/** Blue over green to yellow; share from 0 to 1. */
function ramp(share: number): [number, number, number] {
  const s = Math.min(1, Math.max(0, share));
  return [0.2 + 0.75 * s * s, 0.25 + 0.6 * s, 0.75 - 0.6 * s];
}

function coloursOf(cloud: Cloud, by: Colouring, low: number, high: number): Float32Array {
  const colours = new Float32Array(3 * cloud.count);
  for (let i = 0; i < cloud.count; ++i) {
    let c: [number, number, number];
    if (by === "scan" && cloud.scan) c = ramp((cloud.scan[i]! * 0.381966) % 1);
    else if (by === "clearance" && cloud.clearance) {
      const value = cloud.clearance[i]!;
      c = value === 255 ? [0.5, 0.5, 0.5] : ramp(value * kClearanceUnit_m / 3);
    } else c = ramp((cloud.xyz[3 * i + 2]! - low) / Math.max(0.1, high - low));
    colours.set(c, 3 * i);
  }
  return colours;
}

export class VolumeView {
  #renderer: THREE.WebGLRenderer | null = null;
  #scene = new THREE.Scene();
  #camera = new THREE.PerspectiveCamera(55, 1, 0.1, 3000);
  #controls: OrbitControls | null = null;
  #points: THREE.Points<THREE.BufferGeometry, THREE.PointsMaterial> | null = null;
  #clip = new THREE.Plane(new THREE.Vector3(0, 0, -1), Infinity);
  #cloud: Cloud | null = null;
  #key = "";
  #fitted = false;
  #picked: THREE.Vector3[] = [];
  #line = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: 0xff2090, depthTest: false }));
  #dirty = true;
  #frames: number[] = [];
  readonly #colouring = el("select", { "aria-label": "colour" }, ...["height", "scan", "clearance"].map((v) => el("option", { value: v }, v)));
  readonly #source = el("select", { "aria-label": "cloud" }, el("option", { value: "volume" }, "all scans"), el("option", { value: "cloud" }, "newest scan"));
  readonly #height = el("input", { type: "range", min: "0", max: "1", step: "0.001", value: "1", "aria-label": "clip height" });
  readonly #status = el("span", { role: "status", id: "volume-status" });

  constructor(private readonly host: HTMLElement, private readonly model: Model) {
    try {
      this.#renderer = new THREE.WebGLRenderer({ antialias: false });
    } catch {
      host.append(el("p", { class: "bar" }, "This browser has no WebGL, which the 3D view needs."));
      return;
    }
    const canvas = this.#renderer.domElement;
    canvas.tabIndex = 0;
    host.append(canvas, el("div", { class: "bar" }, this.#source, this.#colouring, el("label", {}, "up to ", this.#height), this.#status));
    this.#renderer.localClippingEnabled = true;
    this.#camera.up.set(0, 0, 1);
    this.#controls = new OrbitControls(this.#camera, canvas);
    this.#controls.addEventListener("change", () => { this.#dirty = true; });
    this.#line.renderOrder = 1;
    this.#scene.add(this.#line);
    new ResizeObserver(() => { this.#dirty = true; }).observe(host);
    for (const input of [this.#colouring, this.#source, this.#height]) input.addEventListener("input", () => { this.#dirty = true; });
    let down: [number, number] = [0, 0];
    canvas.addEventListener("pointerdown", (event) => { down = [event.offsetX, event.offsetY]; });
    canvas.addEventListener("click", (event) => {
      if (Math.hypot(event.offsetX - down[0], event.offsetY - down[1]) < 5) this.#pick(event.offsetX, event.offsetY);
    });
  }

  draw(time_s: number): void {
    if (!this.#renderer || this.host.hidden) return;
    const timeline = this.#source.value === "cloud" ? this.model.cloud : this.model.volume;
    const cloud = (timeline.at(time_s) ?? timeline.first())?.value ?? null;
    const key = `${this.#colouring.value} ${themeGeneration()}`;
    if (cloud !== this.#cloud || key !== this.#key) this.#load(cloud, key);
    if (!this.#dirty) return;
    this.#dirty = false;
    const { clientWidth: w, clientHeight: h } = this.host;
    this.#renderer.setPixelRatio(devicePixelRatio || 1);
    this.#renderer.setSize(w, h);
    this.#camera.aspect = w / Math.max(1, h);
    this.#camera.updateProjectionMatrix();
    const [low, high] = this.#range();
    const top = Number(this.#height.value) >= 1 ? Infinity : low + Number(this.#height.value) * (high - low);
    this.#clip.constant = Number.isFinite(top) ? top : 1e9;
    this.#renderer.render(this.#scene, this.#camera);
    const now = performance.now();
    this.#frames = [...this.#frames.filter((t) => now - t < 1000), now];
    const [a, b] = this.#picked;
    const place = a ? ` · ${a.x.toFixed(2)}, ${a.y.toFixed(2)}, ${a.z.toFixed(2)} m` : "";
    const distance = a && b ? ` · distance ${fixed(a.distanceTo(b), 2, "m")}` : "";
    this.#status.textContent = `${this.#cloud?.count ?? 0} points · ${this.#frames.length} frames/s${Number.isFinite(top) ? ` · below ${top.toFixed(2)} m` : ""}${place}${distance}`;
  }

  /** Lowest and highest z, metres. */
  #range(): [number, number] {
    const box = this.#points?.geometry.boundingBox;
    return box ? [box.min.z, box.max.z] : [0, 1];
  }

  #load(cloud: Cloud | null, key: string): void {
    this.#cloud = cloud;
    this.#key = key;
    this.#dirty = true;
    this.#scene.background = new THREE.Color(colour("page"));
    if (this.#points) {
      this.#scene.remove(this.#points);
      this.#points.geometry.dispose();
      this.#points.material.dispose();
      this.#points = null;
    }
    if (!cloud || cloud.count === 0) return;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(cloud.xyz, 3));
    geometry.computeBoundingBox();
    const box = geometry.boundingBox!;
    geometry.setAttribute("color", new THREE.BufferAttribute(coloursOf(cloud, this.#colouring.value as Colouring, box.min.z, box.max.z), 3));
    const material = new THREE.PointsMaterial({ size: 2, sizeAttenuation: false, vertexColors: true, clippingPlanes: [this.#clip] });
    this.#points = new THREE.Points(geometry, material);
    this.#scene.add(this.#points);
    if (this.#fitted || !this.#controls) return;
    this.#fitted = true;
    const centre = box.getCenter(new THREE.Vector3());
    const size = box.getSize(new THREE.Vector3()).length();
    this.#controls.target.copy(centre);
    this.#camera.position.set(centre.x - 0.2 * size, centre.y - 0.5 * size, centre.z + 0.45 * size);
    this.#controls.update();
  }

  #pick(px: number, py: number): void {
    const cloud = this.#cloud;
    if (!cloud) return;
    const { clientWidth: w, clientHeight: h } = this.host;
    const point = new THREE.Vector3();
    let best: THREE.Vector3 | null = null;
    let bestCost = Infinity;
    for (let i = 0; i < cloud.count; ++i) {
      const z = cloud.xyz[3 * i + 2]!;
      if (z > this.#clip.constant) continue;
      point.set(cloud.xyz[3 * i]!, cloud.xyz[3 * i + 1]!, z).project(this.#camera);
      if (point.z > 1) continue;
      const distance = Math.hypot((point.x + 1) * w / 2 - px, (1 - point.y) * h / 2 - py);
      const cost = distance + 1e3 * point.z;  // of those below the pointer, the nearest to the eye
      if (distance > kPick_px || cost >= bestCost) continue;
      bestCost = cost;
      best = new THREE.Vector3(cloud.xyz[3 * i]!, cloud.xyz[3 * i + 1]!, z);
    }
    this.#picked = best ? [...(this.#picked.length >= 2 ? [] : this.#picked), best] : [];
    this.#line.geometry.dispose();
    this.#line.geometry = new THREE.BufferGeometry().setFromPoints(this.#picked.length === 2 ? this.#picked : []);
    this.#dirty = true;
  }
}
