// The panel beside the map: the box, its chips, and what waits until it is wanted.

import { byId, fill, h } from "./dom";
import type { Info } from "./api";
import type { Example } from "./examples";
import { LANGUAGES, language, t, type Key } from "./language";
import type { State } from "./state";
import { HINTS, type Tool } from "./tools";
import { metres, sentence } from "./words";

interface Wishes {
  ask(said: string): void;
  surprise(): void;
  take(tool: Tool | null): void;
  change(change: Partial<State>): void;
  morePoints(): void;
  speak(language: string): void;
}

const AREAS: (Tool & Key)[] = ["near", "circle", "box"];
const STEPS = ["low", "half", "high"] as const; // heights of the sheet on a phone

export class Panel {
  readonly said = byId<HTMLTextAreaElement>("said");
  readonly answer = byId("answer");
  private readonly bar = byId("bar");
  private readonly chips = byId("chips");
  private readonly describe = byId<HTMLButtonElement>("describe");
  private readonly where = h("div", {});
  private readonly areas = AREAS.map((kind) => [kind, h("button", { type: "button", "aria-pressed": false, onclick: () => this.wishes.take(this.tool === kind ? null : kind) }, t(kind))] as const);
  private readonly heat = h("input", { type: "checkbox" });
  private readonly cells = h("input", { type: "checkbox" });
  private readonly many = h("select", { id: "many" }, ...[5, 10, 40].map((k) => h("option", { value: String(k) }, String(k))));
  private readonly points = h("button", { type: "button", hidden: true }, t("morePoints"));
  private tool: Tool | null = null;
  private waiting = 0;
  private mostCharacters = 4000; // until the service says its limit

  constructor(private readonly wishes: Wishes, ...tools: Element[]) {
    const form = byId<HTMLFormElement>("ask");
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      if (!this.isTooLong()) wishes.ask(this.said.value);
    });
    this.said.addEventListener("input", () => this.isTooLong());
    this.said.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" || event.shiftKey || event.isComposing) return;
      event.preventDefault();
      form.requestSubmit();
    });
    this.describe.addEventListener("click", () => wishes.take(this.tool === "describe" ? null : "describe"));
    this.heat.addEventListener("change", () => wishes.change({ heat: this.heat.checked }));
    this.cells.addEventListener("change", () => wishes.change({ cells: this.cells.checked }));
    this.many.addEventListener("change", () => wishes.change({ topK: Number(this.many.value) }));
    this.points.addEventListener("click", () => wishes.morePoints());
    const shown = h(
      "details",
      {},
      h("summary", {}, t("showMore")),
      h("label", { className: "check" }, this.heat, t("heat")),
      h("label", { className: "check" }, this.cells, t("cells")),
      h("div", { className: "row" }, h("label", { for: "many" }, t("candidates")), this.many, this.points),
    );
    byId("more").append(h("details", { id: "look" }, h("summary", {}, t("whereToLook")), h("div", { className: "row" }, ...this.areas.map(([, button]) => button)), this.where), shown, ...tools, this.languages());
    this.sheet();
  }

  /** What was asked, as the page knows it. */
  set(state: State, tool: Tool | null): void {
    this.tool = tool;
    this.describe.setAttribute("aria-pressed", String(tool === "describe"));
    [this.heat.checked, this.cells.checked] = [state.heat, state.cells];
    if (![...this.many.options].some((option) => option.value === String(state.topK))) this.many.append(h("option", { value: String(state.topK) }, String(state.topK)));
    this.many.value = String(state.topK);
    const { prior, within } = state;
    if (prior || within) byId<HTMLDetailsElement>("look").open = true;
    for (const [kind, button] of this.areas) button.setAttribute("aria-pressed", String(tool === kind));
    fill(
      this.where,
      prior && this.given(t("givenNear", { distance: metres(prior.sigma_m) }), { prior: null }),
      within && this.given("circle" in within ? t("givenCircle", { radius: metres(within.circle.radius_m) }) : t("givenBox", { width: metres(within.bbox[2] - within.bbox[0]), height: metres(within.bbox[3] - within.bbox[1]) }), { within: null }),
    );
    this.tell(tool && tool !== "correct" ? t(HINTS[tool]) : "");
  }

  /** What to do now, or what went wrong beside the answer. */
  tell(text: string): void {
    fill(byId("tip"), text);
    byId("tip").hidden = !text;
  }

  /** The answer in short, for who hears the page. */
  announce(): void {
    const [title, next] = [this.answer.querySelector("h2"), this.answer.querySelector("h2 ~ p")];
    byId("status").textContent = [title?.firstChild, next].map((part) => part?.textContent ?? "").join(". ");
  }

  /** What the service takes at most. */
  limit(limits: Info["limits"]): void {
    this.mostCharacters = limits.max_characters;
    for (const option of [...this.many.options]) if (Number(option.value) > limits.max_top_k) option.remove();
  }

  /** Whether the text is longer than the service takes; the page then says by how much. */
  private isTooLong(): boolean {
    const over = [...this.said.value].length - this.mostCharacters;
    const length = byId("length");
    length.hidden = over <= 0;
    length.textContent = over > 0 ? t("tooLong", { over, most: this.mostCharacters }) : "";
    return over > 0;
  }

  /** Three ways to begin; the first stands in the box in grey as well. */
  offer(examples: Example[]): void {
    if (examples.length) this.said.placeholder = examples[0].description;
    const chips = examples.slice(0, 2).map((example) => h("button", { type: "button", className: "chip", title: example.description, onclick: () => this.wishes.ask(example.description) }, short(example)));
    fill(this.chips, ...chips, h("button", { type: "button", className: "chip", onclick: () => this.wishes.surprise() }, t("surprise")));
  }

  offerPoints(more: boolean): void {
    this.points.hidden = !more;
  }

  /** A thin bar, from 300 ms on. */
  wait(waits: boolean): void {
    clearTimeout(this.waiting);
    if (waits) this.waiting = window.setTimeout(() => (this.bar.hidden = false), 300);
    else this.bar.hidden = true;
    this.answer.setAttribute("aria-busy", String(waits));
  }

  /** On a phone the answer takes the place of the form, which is a finger's move away. */
  reveal(): void {
    if (isSheet()) this.answer.scrollIntoView({ block: "start" });
  }

  private given(text: string, without: Partial<State>): Element {
    return h("p", { className: "row small" }, text, h("button", { type: "button", className: "chip", onclick: () => this.wishes.change(without) }, t("remove")));
  }

  /** The choice of the page's language. */
  private languages(): Element {
    const options = Object.entries(LANGUAGES).map(([tag, name]) => h("option", { value: tag, lang: tag, selected: tag === language }, name));
    const select = h("select", { id: "language", onchange: () => this.wishes.speak(select.value) }, ...options);
    return h("div", { className: "row small" }, h("label", { for: "language" }, t("language")), select);
  }

  /** On a phone the panel is a sheet of three heights. */
  private sheet(): void {
    const [grip, panel] = [byId("grip"), byId("panel")];
    const set = (step: number) => {
      panel.dataset.height = STEPS[Math.max(0, Math.min(STEPS.length - 1, step))];
      grip.setAttribute("aria-label", t("sheetHeight", { height: t(panel.dataset.height as (typeof STEPS)[number]) }));
    };
    const now = () => STEPS.indexOf(panel.dataset.height as (typeof STEPS)[number]);
    let from = 0;
    let moved = false;
    grip.addEventListener("pointerdown", (event) => {
      [from, moved] = [event.clientY, false];
      grip.setPointerCapture(event.pointerId);
    });
    grip.addEventListener("pointermove", (event) => {
      if (!grip.hasPointerCapture(event.pointerId) || Math.abs(event.clientY - from) < 60) return;
      set(now() + (event.clientY < from ? 1 : -1));
      [from, moved] = [event.clientY, true];
    });
    grip.addEventListener("click", () => moved || set((now() + 1) % STEPS.length));
    grip.addEventListener("keydown", (event) => {
      if (event.key === "ArrowUp") set(now() + 1);
      if (event.key === "ArrowDown") set(now() - 1);
    });
    set(1);
  }
}

export function isSheet(): boolean {
  return matchMedia("(max-width: 640px)").matches;
}

/** A chip's few words for an example. */
function short(example: Example): string {
  return sentence(example.place ?? example.description).split(/[,.]/)[0];
}
