// The page: what was asked, what was answered, and the map, kept together.

import { showAnswer, showProblem, showWaiting, type Acts } from "./answer";
import * as api from "./api";
import { byId, save } from "./dom";
import { examples } from "./examples";
import { store, t, translatePage } from "./language";
import { Measure } from "./measure";
import { paint, type Shown } from "./overlay";
import { isSheet, Panel } from "./panel";
import { boxOf, boxRound, placesOf } from "./places";
import { pointer, type Hand } from "./pointer";
import { readScenery, type Scenery, type Shape } from "./scenery";
import { read, write, type State } from "./state";
import { Table } from "./table";
import type { Tool } from "./tools";
import { View } from "./view";
import { legend } from "./legend";

const DRAFT = "hereabouts-draft"; // what was typed, while the page is loaded in another language
const BESIDE = 25; // metres of map around what is visited

class Page implements Acts {
  private state: State = read(location.hash);
  private readonly shown: Shown = { said: "", answer: null, places: [], chosen: 0, mention: null, pin: null, right: null, asked: null, measured: [] };
  private readonly objects = new Map<string, Shape>();
  private readonly view = new View(byId("map"), pointer(this.hand()));
  private readonly measure = new Measure((measured) => this.redraw({ measured }), (report) => report.split === "index" && report.data === this.info?.index?.provenance.map);
  private readonly table = new Table(() => this.info?.limits);
  private readonly panel = new Panel(this.wishes(), this.table.element, this.measure.element);
  private info: api.Info | null = null;
  private sceneries: Scenery[] = [];
  private parts = 1;
  private tool: Tool | null = null;
  private asking = new AbortController();
  private describing = new AbortController();
  private loading: Promise<void> | null = null;
  private described = ""; // the words for the pin
  private stays = this.state.pose !== null; // a link that says where to look is heeded once
  private kept = 0;
  private correction = { isDone: false, message: "" };

  async start(): Promise<void> {
    this.panel.said.value = sessionStorage.getItem(DRAFT) ?? this.state.said;
    sessionStorage.removeItem(DRAFT);
    this.panel.set(this.state, null);
    this.panel.offer([]);
    this.view.overlay = (pen, camera, look, taken) => {
      if (this.sceneries.length) this.keep();
      return paint(pen, camera, look, taken, this.shown, this.state, this.objects);
    };
    legend(this.view, () => this.info);
    this.view.covered = () => [byId("panel"), byId("legend")].map((element) => {
      const { left, top, right, bottom } = element.getBoundingClientRect();
      return [left, top, right, bottom];
    });
    this.fit();
    addEventListener("resize", () => this.fit());
    addEventListener("hashchange", () => this.goTo(read(location.hash)));
    new ResizeObserver(() => this.fit()).observe(byId("panel"));
    await this.load();
  }

  async ask(): Promise<void> {
    if (!this.sceneries.length) return this.load();
    this.asking.abort();
    const asking = (this.asking = new AbortController());
    const { said, prior, within, answers, topK } = this.state;
    this.redraw({ said, answer: null, places: [], chosen: 0, mention: null });
    this.pin(null, false);
    if (!said.trim()) return this.clear();
    showWaiting(this.panel.answer, said);
    this.panel.wait(true);
    try {
      const asked = { description: said, top_k: topK, heat_map: true, ...(prior && { prior }), ...(within && { within }), ...(answers.length && { answers }) } as api.Asked;
      const answer = await api.localize(asked, asking.signal);
      this.redraw({ asked, answer, places: placesOf(answer) });
      this.showAnswer();
      this.panel.reveal();
      const box = boxOf(answer, this.shown.places);
      if (box && !this.stays) this.view.camera.frame(box);
      this.stays = false;
    } catch (error) {
      if (!asking.signal.aborted) this.fail(error);
    } finally {
      if (this.asking === asking) this.panel.wait(false);
    }
  }

  choose(place: number): void {
    this.redraw({ chosen: place });
    this.pin(null, true);
    const [x, y] = this.shown.places[place].at;
    this.view.camera.fly({ x, y, distance: Math.min(this.view.camera.pose.distance, 350) });
  }

  light(mention: number | null): void {
    if (mention === this.shown.mention) return;
    for (const lit of document.querySelectorAll(".lit")) lit.classList.remove("lit");
    if (mention !== null) for (const words of document.querySelectorAll(`[data-mention="${mention}"], [data-evidence="${mention}"]`)) words.classList.add("lit");
    this.redraw({ mention });
  }

  visit(mention: number): void {
    const { answer } = this.shown;
    const at = answer?.evidence[mention].at;
    if (answer?.estimate && at) this.view.camera.frame(boxRound([answer.estimate.position, at], BESIDE));
  }

  reply(question: string, choice: string): void {
    this.change({ answers: [...this.state.answers.filter((answer) => answer.question !== question), { question, choice }] });
    void this.ask();
  }

  forget(question: string): void {
    this.change({ answers: this.state.answers.filter((answer) => answer.question !== question) });
    void this.ask();
  }

  async correct(): Promise<void> {
    const { asked, places, chosen, right } = this.shown;
    this.take(null);
    const correction = (this.correction = { isDone: true, message: "" });
    this.showAnswer();
    try {
      await api.correct({ request: asked!, position: right ?? places[chosen].at, crs: "map", place_rank: right ? null : chosen + 1 });
      correction.message = t("correctionStored");
    } catch (error) {
      Object.assign(correction, { isDone: false, message: api.describeError(error) });
    }
    if (this.correction === correction) this.showAnswer();
  }

  /** The pin of a correction begins at the chosen place, or in the middle of the map. */
  movePin(): void {
    const { right, places, chosen } = this.shown;
    this.take(this.tool === "correct" ? null : "correct");
    this.pin(right ?? places[chosen]?.at ?? this.view.camera.ground(...this.view.camera.middle), false);
    this.showAnswer();
  }

  saveAnswer(): void {
    const { asked, answer } = this.shown;
    if (answer) save(`hereabouts-${answer.request_id}.json`, "application/json", JSON.stringify({ record_version: 1, request: asked, answer }, null, 1));
  }

  private pin(position: [number, number] | null, done: boolean): void {
    this.redraw({ right: position });
    if (!position && this.tool === "correct") this.take(null);
    this.correction = { isDone: false, message: "" };
    if (done) (this.take(null), this.showAnswer());
  }

  async unlock(key: string): Promise<void> {
    api.setKey(key);
    await this.load();
  }

  /** What the service has, and then what the page was opened with; once, however often it is asked for. */
  private load(): Promise<void> {
    this.loading ??= this.loadAll().finally(() => (this.loading = null));
    return this.loading;
  }

  private async loadAll(): Promise<void> {
    this.panel.wait(true);
    try {
      this.info = await api.info();
      const index = this.info.index;
      if (!index) throw new api.Problem(t("mapLoading"), t("mapLoadingAdvice"), "not_ready", null, 2);
      this.measure.offer(this.info.data_sets);
      this.panel.limit(this.info.limits);
      if (!this.sceneries.length) await this.loadMap(index.provenance.map, 0);
      this.parts = index.scenery_parts;
      this.panel.offerPoints(this.sceneries.length < this.parts);
    } catch (error) {
      return this.fail(error);
    } finally {
      this.panel.wait(false);
    }
    if (this.state.said) await this.ask();
    else this.clear();
    this.panel.offer(await examples(this.sceneries[0], 2).catch(() => []));
  }

  /** Nothing is asked. */
  private clear(): void {
    this.panel.wait(false);
    this.panel.answer.replaceChildren();
    this.panel.said.focus();
  }

  private async loadMap(name: string, part: number): Promise<void> {
    const scenery = readScenery(await api.points(name, part));
    this.sceneries.push(scenery);
    if (scenery.kind === "shapes") for (const shape of scenery.shapes) if (shape.source) this.objects.set(shape.source, shape);
    if (part === 0) {
      this.view.camera.frame(scenery.box, true);
      if (this.state.pose) this.view.camera.set(this.state.pose);
    }
    this.view.show(this.sceneries);
  }

  private wishes() {
    return {
      ask: (said: string) => {
        this.change({ said, answers: [] });
        if (said !== this.described) this.redraw({ pin: null });
        this.panel.said.value = said;
        void this.ask();
      },
      surprise: () => void this.surprise(),
      take: (tool: Tool | null) => this.take(tool),
      change: (change: Partial<State>) => {
        this.change(change);
        if (("prior" in change || "within" in change || "topK" in change) && this.state.said) void this.ask();
      },
      morePoints: () => void this.morePoints(),
      speak: (language: string) => this.speak(language),
    };
  }

  private async morePoints(): Promise<void> {
    this.panel.offerPoints(false);
    try {
      await this.loadMap(this.info!.index!.provenance.map, this.sceneries.length);
    } catch (error) {
      this.panel.tell(api.describeError(error));
    }
    this.panel.offerPoints(this.sceneries.length < this.parts);
  }

  /** Loads the page again in a language; what was typed and asked stays. */
  private speak(language: string): void {
    store(language);
    sessionStorage.setItem(DRAFT, this.panel.said.value);
    if (this.sceneries.length) this.state.pose = { ...this.view.camera.pose };
    history.replaceState(null, "", write(this.state));
    location.reload();
  }

  private async surprise(): Promise<void> {
    try {
      const [example] = await examples(this.sceneries[0], 1);
      example ? this.wishes().ask(example.description) : this.panel.tell(t("noExample"));
    } catch (error) {
      this.panel.tell(api.describeError(error));
    }
  }

  private async describe(position: [number, number]): Promise<void> {
    this.describing.abort();
    const describing = (this.describing = new AbortController());
    this.redraw({ pin: position });
    try {
      this.described = (await api.describe(position, describing.signal)).description;
      this.panel.said.value = this.described;
      this.panel.said.focus();
    } catch (error) {
      if (describing.signal.aborted) return;
      this.redraw({ pin: null });
      this.panel.tell(api.describeError(error));
    }
  }

  private take(tool: Tool | null): void {
    this.tool = tool;
    byId("map").classList.toggle("aims", tool !== null);
    this.panel.set(this.state, tool);
  }

  private hand(): Hand {
    const page = this;
    return {
      get camera() { return page.view.camera; },
      get shown() { return page.shown; },
      get tool() { return page.tool; },
      describe: (position) => {
        this.take(null);
        void this.describe(position);
      },
      pin: (position, done) => this.pin(position, done),
      drawn: (area, done) => {
        if (done) {
          this.take(null);
          this.wishes().change(area);
        } else {
          this.state = { ...this.state, ...area };
          this.view.draw();
        }
      },
      choose: (place) => this.choose(place),
      light: (mention) => this.light(mention),
    };
  }

  private goTo(state: State): void {
    if (write({ ...state, pose: null }) === write({ ...this.state, pose: null })) return;
    this.state = state;
    this.panel.said.value = state.said;
    this.panel.set(state, this.tool);
    void this.ask();
  }

  private change(change: Partial<State>): void {
    this.state = { ...this.state, ...change };
    this.panel.set(this.state, this.tool);
    this.keep();
    this.view.draw();
  }

  /** The URL says what is seen, a moment after it stands still. */
  private keep(): void {
    clearTimeout(this.kept);
    this.kept = window.setTimeout(() => {
      this.state.pose = { ...this.view.camera.pose };
      history.replaceState(null, "", write(this.state));
    }, 200);
  }

  private redraw(change: Partial<Shown>): void {
    Object.assign(this.shown, change);
    this.view.draw();
  }

  private showAnswer(): void {
    const { answer, places, chosen } = this.shown;
    if (!answer) return;
    const correction = this.info?.corrections ? { ...this.correction, hasPin: this.shown.right !== null, isPinning: this.tool === "correct" } : null;
    const [focused, hadFocus] = [document.activeElement?.id, this.panel.answer.contains(document.activeElement)];
    showAnswer(this.panel.answer, this.shown.said, answer, places, chosen, { replies: this.state.answers, isInside: this.state.within !== null, correction }, this);
    this.panel.announce();
    if (hadFocus) (this.panel.answer.querySelector<HTMLElement>(focused ? `#${focused}:enabled` : "none") ?? this.panel.answer.querySelector<HTMLElement>('.place[aria-pressed="true"]') ?? this.panel.answer.querySelector("h2"))?.focus();
  }

  private fail(error: unknown): void {
    const known = error instanceof api.Problem ? error : new api.Problem(t("pageFault"), api.describeError(error), "page");
    this.redraw({ answer: null, places: [], mention: null });
    showProblem(this.panel.answer, known, this.state.answers, this);
  }

  /** The panel covers a part of the map; what is looked at stands in the rest. */
  private fit(): void {
    const panel = byId("panel").getBoundingClientRect();
    this.view.camera.cover(isSheet() ? { left: 0, bottom: Math.min(innerHeight / 2, innerHeight - panel.top) } : { left: panel.right, bottom: 0 });
  }
}

translatePage();
void new Page().start();
