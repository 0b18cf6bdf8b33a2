// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** The panels beside the map: mission, processes, hazards, frontiers, scans, events, summary. */
import { clock, el, fixed, kNone, setText, table, type Child } from "../dom";
import type { Model } from "../state/model";
import { frontiersOf, hazardsOf, kFrontierStates } from "../state/scene";
import { list, num, numOrNull, raw, str } from "../state/values";

export interface PanelActions {
  centre(x: number, y: number): void;
  call(service: string, request: Record<string, string>): Promise<unknown>;
}

const kListLimit = 400;

class Panel {
  readonly body = el("div");
  readonly section: HTMLElement;
  #key = "";
  constructor(id: string, title: string, scroll = false) {
    if (scroll) this.body.className = "scroll";
    this.section = el("section", { id }, el("h2", {}, title), this.body);
  }
  /** Builds the content only when what it shows changed. */
  update(key: string, build: () => Child[]): void {
    if (key === this.#key) return;
    this.#key = key;
    const children = build().filter((child): child is Node | string => child !== null);
    this.section.hidden = children.length === 0;
    this.body.replaceChildren(...children);
  }
}

function button(text: string, action: () => void): HTMLButtonElement {
  const element = el("button", { type: "button" }, text);
  element.addEventListener("click", action);
  return element;
}

export class Panels {
  readonly #summary = new Panel("panel-summary", "Summary");
  readonly #mission = new Panel("panel-mission", "Mission");
  readonly #orders = el("section", { id: "panel-orders", class: "live" });
  readonly #hazards = new Panel("panel-hazards", "Hazards", true);
  readonly #frontiers = new Panel("panel-frontiers", "Frontiers", true);
  readonly #scans = new Panel("panel-scans", "3D scans", true);
  readonly #card = new Panel("panel-card", "Card of the scan");
  readonly #processes = new Panel("panel-processes", "Processes and stages", true);
  readonly #events = new Panel("panel-events", "Events", true);
  readonly #token = el("input", { type: "password", placeholder: "token", "aria-label": "token of orders", autocomplete: "off" });
  readonly #answer = el("p", { role: "status", id: "answer" });
  #ordersKey = "";
  #openScan: number | null = null;
  #ids = new WeakMap<object, number>();
  #nextId = 1;

  constructor(host: HTMLElement, private readonly model: Model, private readonly actions: PanelActions) {
    host.append(this.#summary.section, this.#mission.section, this.#orders, this.#hazards.section, this.#frontiers.section,
      this.#card.section, this.#scans.section, this.#processes.section, this.#events.section);
  }

  openScan(number: number): void {
    this.#openScan = number;
    this.#updateCard();
    this.#card.section.scrollIntoView({ block: "nearest" });
  }

  update(time_s: number): void {
    const model = this.model;
    const at = (t: number) => clock(t - model.start_s);
    const summary = model.summary.at(Infinity)?.value ?? null;
    this.#summary.update(this.#id(summary), () => summary ? [
      ...list(summary.paragraphs).map((text) => el("p", {}, str(text))),
      ...list(summary.warnings).map((text) => el("p", { class: "warn" }, str(text))),
      table(["metric", "value"], list(summary.metrics).map((m) => [str(raw(m).label), str(raw(m).value)])),
      el("h2", {}, "Files"), table(["file", "content"], list(summary.files).map((f) => [str(raw(f).name), str(raw(f).note)])),
    ] : []);
    const mission = model.mission.at(time_s)?.value ?? null;
    this.#mission.update(this.#id(mission), () => {
      if (!mission) return [el("p", { class: "soft" }, "No mission message yet.")];
      const share = (value: unknown, digits: number) => fixed(num(value) * 100, digits, "%");
      const rows: [string, string][] = [
        ["outcome", str(mission.outcome, kNone)], ["driving", `${str(mission.driving)} ${str(mission.driving_reason)}`],
        ["decision", str(mission.decision_reason, kNone)], ["speed", fixed(num(mission.speed_m_s), 2, "m/s")],
        ["battery", share(mission.battery_share, 0)], ["methane", share(mission.methane_share, 2)], ["oxygen", share(mission.oxygen_share, 1)],
        ["carbon monoxide", fixed(num(mission.carbon_monoxide_share) * 1e6, 0, "ppm")],
        ["position sd", fixed(numOrNull(mission.position_sd_m), 2, "m")], ["match quality", fixed(numOrNull(mission.match_quality), 2)],
        ["driven", fixed(num(mission.distance_travelled_m), 1, "m")], ["explored", fixed(num(mission.explored_m), 1, "m")],
        ["budget left", fixed(num(mission.remaining_m), 1, "m")],
        ["returning home", mission.returning_home === true ? `yes: ${str(mission.return_home_reason)}` : "no"],
      ];
      return [table(["", ""], rows)];
    });
    this.#updateOrders();
    const hazards = model.hazards.at(time_s)?.value ?? [];
    this.#hazards.update(this.#id(hazards), () => {
      const rows = hazardsOf(hazards).sort((a, b) => a.kind.localeCompare(b.kind)).slice(0, kListLimit);
      if (rows.length === 0) return [el("p", { class: "soft" }, "None observed up to this time.")];
      return [table(["kind", "value", "E, N, height (m)", "evidence", "time", ""], rows.map((h) => [h.kind, `${h.value} ${h.unit}`,
        `${h.x.toFixed(1)}, ${h.y.toFixed(1)}, ${h.z.toFixed(1)}`, h.evidence, at(h.time_s), button("show", () => this.actions.centre(h.x, h.y))]))];
    });
    const frontiers = model.frontiers.at(time_s)?.value ?? [];
    this.#frontiers.update(this.#id(frontiers), () => {
      const rank = (state: string) => (kFrontierStates.indexOf(state) + 99) % 99;
      const rows = frontiersOf(frontiers).sort((a, b) => rank(a.state) - rank(b.state)).slice(0, kListLimit);
      if (rows.length === 0) return [el("p", { class: "soft" }, "None up to this time.")];
      return [table(["no.", "state", "evidence", "width", "E, N (m)", ""], rows.map((f) => [f.id, f.state, f.evidence, fixed(f.width_m, 1, "m"),
        `${f.x.toFixed(1)}, ${f.y.toFixed(1)}`, button("show", () => this.actions.centre(f.x, f.y))]))];
    });
    const scans = [...model.scans.values()].filter((scan) => scan.time_s <= time_s).sort((a, b) => a.number - b.number).slice(-kListLimit);
    this.#scans.update(scans.map((scan) => `${scan.number}${this.#id(scan)}`).join(), () => scans.length === 0 ? [el("p", { class: "soft" }, "None up to this time.")]
      : [table(["no.", "time", "points", "plan", ""], scans.map((scan) => {
        const plans = list(scan.raw.plans);
        return [String(scan.number), at(scan.time_s), str(scan.raw.points), str(raw(plans[plans.length - 1]).outcome, kNone), button("open", () => this.openScan(scan.number))];
      }))]);
    this.#updateCard();
    this.#updateProcesses(time_s);
    const events = model.events.filter((event) => event.time_s <= time_s).slice(-kListLimit).reverse();
    this.#events.update(`${events.length} ${events[0]?.time_s} ${events[0]?.message}`, () => events.length === 0 ? [el("p", { class: "soft" }, "None up to this time.")]
      : [table(["time", "from", "event"], events.map((e) => [at(e.time_s), e.name, el("span", e.level >= 3 ? { class: "warn" } : {}, e.message)]))]);
  }

  #id(value: object | null): string {
    if (!value) return "none";
    if (!this.#ids.has(value)) this.#ids.set(value, this.#nextId++);
    return String(this.#ids.get(value));
  }

  #updateCard(): void {
    const scan = this.#openScan === null ? undefined : this.model.scans.get(this.#openScan);
    this.#card.update(this.#id(scan ?? null), () => {
      if (!scan) return [];
      // Only images inside the message are shown; an address could load something.
      const pictures = Object.entries(raw(scan.raw.pictures)).filter(([, url]) => /^data:image\/(png|jpeg);base64,/.test(String(url)));
      return [
        el("p", {}, `Scan ${scan.number}, ${str(scan.raw.points)} points, at ${scan.x.toFixed(1)} E, ${scan.y.toFixed(1)} N${scan.raw.complete === false ? ", incomplete" : ""}`),
        table(["plan", "reason", "reached", "length", "clearance"], list(scan.raw.plans).map((p) => [str(raw(p).outcome), str(raw(p).reason),
          fixed(num(raw(p).reached_m), 1, "m"), fixed(num(raw(p).length_m), 1, "m"), fixed(num(raw(p).clearance_m), 2, "m")])),
        ...pictures.map(([name, url]) => el("figure", {}, el("img", { src: String(url), alt: name }), el("figcaption", {}, name))),
        button("close", () => { this.#openScan = null; this.#updateCard(); }),
      ];
    });
  }

  #updateProcesses(time_s: number): void {
    const message = this.model.processes.at(time_s)?.value ?? null;
    const orders = this.#hasOrders("adit/process");
    this.#processes.update(`${this.#id(message)} ${orders}`, () => {
      if (!message) return [];
      const rows = list(message.computers).flatMap((computer) => list(raw(computer).processes).map((entry): Child[] => {
        const p = raw(entry);
        const name = str(p.name);
        const buttons = orders ? el("span", {}, ...["start", "stop", "restart"].map((action) => button(action, () => this.#order("adit/process", { process: name, action }, `${action} ${name}`)))) : null;
        return [name, str(p.group), p.running === true ? "running" : `ended (${str(p.exit_code, "?")})`, str(p.pid, kNone),
          fixed(num(p.cpu_share) * 100, 0, "%"), fixed(num(p.memory_bytes) / 1048576, 0, "MB"), str(p.restarts), buttons];
      }));
      const stages = list(message.stages).map((entry): Child[] => {
        const s = raw(entry);
        const level = str(s.level);
        return [str(s.name), el("span", level === "ok" ? {} : { class: "warn" }, `${level} ${str(s.reason)}`), str(s.handled), str(s.rejected), str(s.dropped), fixed(num(s.age_s), 1, "s")];
      });
      return [table(["process", "group", "state", "pid", "CPU", "memory", "restarts", ""], rows),
        table(["stage", "health", "handled", "rejected", "dropped", "age"], stages)];
    });
  }

  #hasOrders(service: string): boolean {
    return this.model.info?.orders === true && this.model.services.some((known) => known.name === service);
  }

  #updateOrders(): void {
    const orders = this.#hasOrders("adit/order");
    const key = `${orders} ${this.model.info?.source}`;
    if (key === this.#ordersKey) return;
    this.#ordersKey = key;
    this.#orders.hidden = this.model.info?.source !== "live";
    if (!orders) { this.#orders.replaceChildren(el("span", { class: "soft" }, "read-only")); return; }
    const kOrders = [["pause", "Pause"], ["resume", "Resume"], ["return_home", "Return home"], ["stop", "Stop"]];
    this.#orders.replaceChildren(el("h2", {}, "Orders"), this.#token, ...kOrders.map(([order, label]) =>
      button(label!, () => this.#order("adit/order", { order: order! }, label!.toLowerCase()))), this.#answer);
  }

  #order(service: string, request: Record<string, string>, what: string): void {
    const dialog = el("dialog", {}, el("p", {}, `Send the order "${what}" to the robot?`));
    const close = () => { dialog.close(); dialog.remove(); };
    const confirm = button("Send", () => {
      close();
      setText(this.#answer, `${what}: sent`);
      this.actions.call(service, { ...request, token: this.#token.value })
        .then(() => setText(this.#answer, `${what}: accepted`), (error: Error) => setText(this.#answer, `${what}: rejected, ${error.message}`));
    });
    dialog.append(confirm, button("Cancel", close));
    document.body.append(dialog);
    dialog.showModal();
  }
}
