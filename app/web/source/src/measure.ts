// Evaluations: start one, follow it, look at its report; or open one that was saved.

import * as api from "./api";
import { fill, h } from "./dom";
import { t } from "./language";
import { readReport, showReport, measurementsOf, type Measurement, type Report } from "./report";

export class Measure {
  readonly element = h("details", {});
  private readonly result = h("div", { className: "report", "aria-live": "polite" });
  private readonly data = h("select", { id: "data" });
  private readonly split = h("input", { id: "split", placeholder: t("wholeSet"), size: 8 });
  private readonly named = h("div", { className: "row", hidden: true }, h("label", { for: "data" }, t("data")), this.data, h("label", { for: "split" }, t("split")), this.split);
  private readonly own = h("textarea", { id: "own", rows: 3, placeholder: '[{"description": "…", "position": [x, y]}]' });
  private readonly start = h("button", { type: "submit" }, t("measure"));
  private running: AbortController | null = null;

  constructor(private readonly show: (measured: Measurement[]) => void, private readonly isHere: (report: Report) => boolean) {
    const file = h("input", { type: "file", accept: "application/json,.json", onchange: () => this.open(file.files?.[0]) });
    const form = h(
      "form",
      { onsubmit: (event: Event) => (event.preventDefault(), void this.run()) },
      this.named,
      h("label", { for: "own", className: "small" }, t("ownDescriptions")),
      this.own,
      h("div", { className: "row" }, this.start, h("label", { className: "button" }, t("openReport"), file)),
    );
    this.element.append(h("summary", {}, t("measureTitle")), form, this.result);
  }

  offer(sets: string[]): void {
    fill(this.data, h("option", { value: "" }, t("chooseData")), ...sets.map((name) => h("option", { value: name }, name)));
    this.named.hidden = !sets.length;
  }

  private async run(): Promise<void> {
    if (this.running) return this.running.abort();
    const running = (this.running = new AbortController());
    this.start.textContent = t("cancel");
    let job: string | null = null;
    try {
      let ended = false;
      for await (const state of api.evaluate(this.asked(), running.signal, (accepted) => (job = accepted))) {
        ended = ["done", "failed", "cancelled", "interrupted"].includes(state.status);
        if (state.status === "done") this.report(state.report as unknown as Report);
        else if (state.status === "failed") this.say(state.error?.detail ?? t("failed"));
        else if (state.status === "cancelled") this.say(t("cancelled"));
        else if (state.status === "interrupted") this.say(t("interrupted"));
        else this.progress(state);
      }
      if (!ended) this.say(t("disconnected"));
    } catch (error) {
      if (running.signal.aborted) {
        if (job) await api.cancel(job).catch(() => null);
        this.say(t("cancelled"));
      } else this.say(api.describeError(error));
    } finally {
      this.running = null;
      this.start.textContent = t("measure");
    }
  }

  private asked(): api.Measured {
    if (this.data.value) return { data: this.data.value, ...(this.split.value && { split: this.split.value }) } as api.Measured;
    if (!this.own.value.trim()) throw new Error(this.named.hidden ? t("giveDescriptions") : t("chooseOrGive"));
    try {
      const own = JSON.parse(this.own.value);
      return (Array.isArray(own) ? { queries: own } : own) as api.Measured; // or the whole of a request
    } catch {
      throw new Error(t("ownNotJson"));
    }
  }

  private progress({ progress }: api.JobState): void {
    const bar = h("progress", { "aria-label": t("progress") });
    if (progress.total) Object.assign(bar, { max: progress.total, value: progress.done });
    fill(this.result, bar, h("p", { className: "small" }, progress.total ? t("progressOf", { ...progress }) : progress.stage));
  }

  private async open(file: File | undefined): Promise<void> {
    if (!file) return;
    try {
      this.report(readReport(await file.text()));
    } catch (error) {
      this.say((error as Error).message);
    }
  }

  private report(report: Report): void {
    const here = this.isHere(report) && measurementsOf(report).length > 0;
    const toggle = (shown: boolean) => this.show(shown ? measurementsOf(report) : []);
    showReport(this.result, report, here ? { shown: true, toggle } : null);
    toggle(here);
  }

  private say(message: string): void {
    fill(this.result, h("p", { role: "alert" }, message));
  }
}
