// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Of a finished mission: what happened, figures, files, configuration. */
import { el, table } from "../dom";
import type { Model } from "../state/model";
import { list, raw, str } from "../state/values";
import { idOf, Panel } from "./panel";

export class SummaryPanel extends Panel {
  constructor(private readonly model: Model) { super("panel-summary", "Summary"); }

  show(): void {
    const summary = this.model.summary.at(Infinity)?.value ?? null;
    this.update(idOf(summary), () => {
      if (!summary) return [];
      const files = list(summary.files).map((file) => [str(raw(file).name), str(raw(file).note)]);
      const configuration = str(summary.configuration, "", Infinity);
      return [
        ...list(summary.paragraphs).map((text) => el("p", {}, str(text))),
        ...list(summary.warnings).map((text) => el("p", { class: "warn" }, str(text))),
        table([], list(summary.metrics).map((metric) => [str(raw(metric).label), str(raw(metric).value)])),
        files.length > 0 ? el("details", { class: "screen" }, el("summary", {}, "Files beside this page"), table([], files)) : null,
        configuration ? el("details", { class: "screen" }, el("summary", {}, "Configuration"), el("pre", {}, configuration)) : null,
      ];
    });
  }
}
