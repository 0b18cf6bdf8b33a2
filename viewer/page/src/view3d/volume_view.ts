// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** The 3D scans as points: orbit, colour, clip height, coordinates of a clicked point, distance of two. */
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { eastNorth, el, fixed, setText } from "../dom";
import { countUpTo, sortedByScan, type Cloud } from "../state/cloud";
import type { Model } from "../state/model";
import { colour, themeGeneration } from "../theme";
import { coloursOf, kColourings, legendOf, type Colouring } from "./colours";
import { pick } from "./picking";

const kClick_px = 5;
/** Drawn while the view moves; every n-th point of a larger cloud, so that software rendering follows the hand. */
const kMovingPoints = 300_000;

export class VolumeView {
  readonly #renderer: THREE.WebGLRenderer | null;
  readonly #scene = new THREE.Scene();
  readonly #camera = new THREE.PerspectiveCamera(55, 1, 0.1, 3000);
  readonly #clip = new THREE.Plane(new THREE.Vector3(0, 0, -1), Infinity);
  readonly #line = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: 0xff2090, depthTest: false }));
  readonly #colouring = el("select", { "aria-label": "colour" }, ...kColourings.map((name) => el("option", { value: name }, name)));
  readonly #source = el("select", { "aria-label": "cloud" }, el("option", { value: "volume" }, "all 3D scans"), el("option", { value: "cloud" }, "newest 3D scan"));
  readonly #height = el("input", { type: "range", min: "0", max: "1", step: "0.001", value: "1", "aria-label": "clip height" });
  readonly #status = el("span", { role: "status", id: "volume-status" });
  readonly #legend = el("span", { class: "soft" });
  #controls: OrbitControls | null = null;
  #points: THREE.Points<THREE.BufferGeometry, THREE.PointsMaterial> | null = null;
  #received: Cloud | null = null;
  #cloud: Cloud | null = null;
  #count = 0;
  #key = "";
  #isFitted = false;
  #isMoving = false;
  #picked: THREE.Vector3[] = [];
  #dirty = true;
  #frames_ms: number[] = [];

  constructor(private readonly host: HTMLElement, private readonly model: Model) {
    this.#renderer = this.#createRenderer();
    if (!this.#renderer) return;
    const canvas = this.#renderer.domElement;
    canvas.tabIndex = 0;
    host.append(canvas, el("div", { class: "bar" }, this.#source, this.#colouring, el("label", {}, "up to ", this.#height), this.#status, this.#legend));
    this.#renderer.localClippingEnabled = true;
    this.#camera.up.set(0, 0, 1);
    this.#controls = new OrbitControls(this.#camera, canvas);
    this.#controls.addEventListener("change", () => { this.#dirty = true; });
    this.#controls.addEventListener("start", () => this.#setMoving(true));
    this.#controls.addEventListener("end", () => this.#setMoving(false));
    this.#line.renderOrder = 1;
    this.#scene.add(this.#line);
    new ResizeObserver(() => { this.#dirty = true; }).observe(host);
    for (const input of [this.#colouring, this.#source, this.#height]) input.addEventListener("input", () => { this.#dirty = true; });
    let down: [number, number] = [0, 0];
    canvas.addEventListener("pointerdown", (event) => { down = [event.offsetX, event.offsetY]; });
    canvas.addEventListener("click", (event) => {
      if (Math.hypot(event.offsetX - down[0], event.offsetY - down[1]) < kClick_px) this.#pick(event.offsetX, event.offsetY);
    });
  }

  draw(time_s: number): void {
    if (!this.#renderer || this.host.hidden) return;
    const cloud = this.#cloudAt(time_s);
    const key = `${this.#colouring.value} ${themeGeneration()}`;
    if (cloud !== this.#received || key !== this.#key) this.#load(cloud, key);
    this.#showUpTo(time_s);
    if (!this.#dirty) return;
    this.#dirty = false;
    const { clientWidth: w, clientHeight: h } = this.host;
    this.#renderer.setPixelRatio(devicePixelRatio || 1);
    this.#renderer.setSize(w, h);
    this.#camera.aspect = w / Math.max(1, h);
    this.#camera.updateProjectionMatrix();
    const [low_m, high_m] = this.#range();
    const share = Number(this.#height.value);
    this.#clip.constant = share >= 1 ? 1e9 : low_m + share * (high_m - low_m);
    this.#renderer.render(this.#scene, this.#camera);
    this.#showStatus(share < 1);
  }

  #createRenderer(): THREE.WebGLRenderer | null {
    try {
      return new THREE.WebGLRenderer({ antialias: false });
    } catch {
      this.host.append(el("p", { class: "bar" }, "This browser has no WebGL, which the 3D view needs."));
      return null;
    }
  }

  /** The newest volume, of which the time shown selects scans; or the 3D scan of that time. */
  #cloudAt(time_s: number): Cloud | null {
    if (this.#source.value === "volume") return this.model.volume.last()?.value ?? null;
    return (this.model.cloud.at(time_s) ?? this.model.cloud.first())?.value ?? null;
  }

  /** Shows the points of the scans up to a time; all if none of them is known. */
  #showUpTo(time_s: number): void {
    if (!this.#cloud || !this.#points) return;
    const past = this.model.scansUntil(time_s);
    const isComplete = past.length === this.model.scans.size || this.#source.value === "cloud";
    const count = isComplete ? this.#cloud.count : countUpTo(this.#cloud, past.at(-1)?.number ?? 0);
    if (count === this.#count) return;
    this.#count = count;
    this.#setRange();
  }

  #setMoving(isMoving: boolean): void {
    this.#isMoving = isMoving;
    this.#setRange();
  }

  #setRange(): void {
    const geometry = this.#points?.geometry;
    if (!geometry) return;
    const stride = this.#isMoving ? Math.ceil(this.#count / kMovingPoints) : 1;
    const isThinned = stride > 1;
    if (isThinned) geometry.setIndex(new THREE.BufferAttribute(Uint32Array.from({ length: Math.floor(this.#count / stride) }, (_, i) => i * stride), 1));
    else geometry.setIndex(null);
    geometry.setDrawRange(0, isThinned ? Math.floor(this.#count / stride) : this.#count);
    this.#dirty = true;
  }

  #showStatus(isClipped: boolean): void {
    const now_ms = performance.now();
    this.#frames_ms = [...this.#frames_ms.filter((t) => now_ms - t < 1000), now_ms];
    const [a, b] = this.#picked;
    const parts = [`${this.#count} points`, `${this.#frames_ms.length} frames/s`];
    if (isClipped) parts.push(`below ${this.#clip.constant.toFixed(2)} m`);
    if (a) parts.push(`${eastNorth(a.x, a.y, 2)}, height ${a.z.toFixed(2)} m`);
    if (a && b) parts.push(`distance ${fixed(a.distanceTo(b), 2, "m")}`);
    setText(this.#status, parts.join(" · "));
  }

  /** Lowest and highest z, metres. */
  #range(): [number, number] {
    const box = this.#points?.geometry.boundingBox;
    return box ? [box.min.z, box.max.z] : [0, 1];
  }

  #load(cloud: Cloud | null, key: string): void {
    this.#received = cloud;
    this.#cloud = cloud && sortedByScan(cloud);
    this.#key = key;
    this.#dirty = true;
    this.#scene.background = new THREE.Color(colour("page"));
    this.#unload();
    if (!this.#cloud || this.#cloud.count === 0) return;
    const by = this.#colouring.value as Colouring;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(this.#cloud.xyz, 3));
    geometry.computeBoundingBox();
    const box = geometry.boundingBox!;
    geometry.setAttribute("color", new THREE.BufferAttribute(coloursOf(this.#cloud, by, box.min.z, box.max.z), 3));
    setText(this.#legend, legendOf(by, box.min.z, box.max.z));
    this.#points = new THREE.Points(geometry, new THREE.PointsMaterial({ size: 2, sizeAttenuation: false, vertexColors: true, clippingPlanes: [this.#clip] }));
    this.#scene.add(this.#points);
    if (!this.#isFitted) this.#fit(box);
  }

  #unload(): void {
    this.#count = 0;
    if (!this.#points) return;
    this.#scene.remove(this.#points);
    this.#points.geometry.dispose();
    this.#points.material.dispose();
    this.#points = null;
  }

  #fit(box: THREE.Box3): void {
    this.#isFitted = true;
    const centre = box.getCenter(new THREE.Vector3());
    const size_m = box.getSize(new THREE.Vector3()).length();
    this.#controls!.target.copy(centre);
    this.#camera.position.set(centre.x - 0.15 * size_m, centre.y - 0.5 * size_m, centre.z + 0.45 * size_m);
    this.#controls!.update();
  }

  /** A third point begins another line. */
  #pick(px: number, py: number): void {
    if (!this.#cloud) return;
    const size = { width: this.host.clientWidth, height: this.host.clientHeight };
    const found = pick(this.#cloud, this.#count, this.#clip.constant, this.#camera, size, px, py);
    this.#picked = found ? [...(this.#picked.length >= 2 ? [] : this.#picked), found] : [];
    this.#line.geometry.dispose();
    this.#line.geometry = new THREE.BufferGeometry().setFromPoints(this.#picked.length === 2 ? this.#picked : []);
    this.#dirty = true;
  }
}
