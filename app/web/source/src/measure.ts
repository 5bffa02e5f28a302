// Evaluations: start one, follow it, look at its report; or open one that was saved.

import * as api from "./api";
import { fill, h } from "./dom";
import { readReport, showReport, measurementsOf, type Measurement, type Report } from "./report";

export class Measure {
  readonly element = h("details", {});
  private readonly result = h("div", { className: "report", "aria-live": "polite" });
  private readonly data = h("select", { id: "data" });
  private readonly split = h("input", { id: "split", placeholder: "all of it", size: 8 });
  private readonly named = h("div", { className: "row", hidden: true }, h("label", { for: "data" }, "Data"), this.data, h("label", { for: "split" }, "Split"), this.split);
  private readonly own = h("textarea", { id: "own", rows: 3, placeholder: '[{"description": "…", "position": [x, y]}]' });
  private readonly start = h("button", { type: "submit" }, "Measure");
  private running: AbortController | null = null;

  constructor(private readonly show: (measured: Measurement[]) => void, private readonly isHere: (report: Report) => boolean) {
    const file = h("input", { type: "file", accept: "application/json,.json", onchange: () => this.open(file.files?.[0]) });
    const form = h(
      "form",
      { onsubmit: (event: Event) => (event.preventDefault(), void this.run()) },
      this.named,
      h("label", { for: "own", className: "small" }, "Descriptions of your own, with where they were said"),
      this.own,
      h("div", { className: "row" }, this.start, h("label", { className: "button" }, "Open a saved report", file)),
    );
    this.element.append(h("summary", {}, "Measure how well it does"), form, this.result);
  }

  offer(sets: string[]): void {
    fill(this.data, h("option", { value: "" }, "choose …"), ...sets.map((name) => h("option", { value: name }, name)));
    this.named.hidden = !sets.length;
  }

  private async run(): Promise<void> {
    if (this.running) return this.running.abort();
    const running = (this.running = new AbortController());
    this.start.textContent = "Cancel";
    let job: string | null = null;
    try {
      let ended = false;
      for await (const state of api.evaluate(this.asked(), running.signal, (accepted) => (job = accepted))) {
        ended = ["done", "failed", "cancelled", "interrupted"].includes(state.status);
        if (state.status === "done") this.report(state.report as unknown as Report);
        else if (state.status === "failed") this.say(state.error?.detail ?? "It failed.");
        else if (state.status === "cancelled") this.say("Cancelled.");
        else if (state.status === "interrupted") this.say("The service ended meanwhile; measure again.");
        else this.progress(state);
      }
      if (!ended) this.say("The service ended the connection; ask again.");
    } catch (error) {
      if (running.signal.aborted) {
        if (job) await api.cancel(job).catch(() => null);
        this.say("Cancelled.");
      } else this.say(error instanceof api.Problem ? `${error.title}. ${error.message}` : String((error as Error).message));
    } finally {
      this.running = null;
      this.start.textContent = "Measure";
    }
  }

  private asked(): api.Measured {
    if (this.data.value) return { data: this.data.value, ...(this.split.value && { split: this.split.value }) } as api.Measured;
    if (!this.own.value.trim()) throw new Error(this.named.hidden ? "Give descriptions, with where they were said." : "Choose a data set, or give descriptions of your own.");
    try {
      const own = JSON.parse(this.own.value);
      return (Array.isArray(own) ? { queries: own } : own) as api.Measured; // or the whole of a request
    } catch {
      throw new Error("Your descriptions are not JSON; give a list as in the example.");
    }
  }

  private progress({ progress }: api.JobState): void {
    const bar = h("progress", { "aria-label": "Progress" });
    if (progress.total) Object.assign(bar, { max: progress.total, value: progress.done });
    fill(this.result, bar, h("p", { className: "small" }, progress.total ? `${progress.stage}: ${progress.done} of ${progress.total}` : progress.stage));
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
