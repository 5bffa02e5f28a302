// The answer, as people read it: words first, then what was understood, then the other places.

import type { Answer, Evidence, Problem } from "./api";
import { fill, h } from "./dom";
import type { Place } from "./places";
import { count, likely, metres, percent, sentence, sentences, wind } from "./words";

export interface Acts {
  choose(place: number): void;
  light(mention: number | null): void;
  /** Flies to where a mention and the answer are both seen. */
  visit(mention: number): void;
  reply(question: string, choice: string): void;
  forget(question: string): void;
  ask(): void;
  unlock(key: string): void;
}

/** What was asked besides the text. */
export interface Given {
  replies: { question: string; choice: string }[];
  isInside: boolean; // an area alone is looked at
}

const FITS = 0.5; // as the service has it: from this probability on something explains what was said
const WEAK = 0.2;
const SIGNS = { solid: "✓", weak: "~", none: "✗" };

type Fit = keyof typeof SIGNS;

export function fitOf(evidence: Evidence): Fit {
  if (evidence.explained >= FITS) return "solid";
  return evidence.explained >= WEAK ? "weak" : "none";
}

export function showAnswer(into: Element, said: string, answer: Answer, places: Place[], chosen: number, asked: Given, acts: Acts): void {
  fill(
    into,
    headline(answer, places, asked, acts),
    told(said, answer, acts),
    answer.evidence.length > 0 && evidenceList(said, answer, acts),
    asked.replies.length > 0 && repliesList(asked.replies, acts),
    others(answer, places, chosen, acts),
    ...answer.warnings.map((warning) => h("p", { className: "warning" }, sentence(warning))),
  );
}

export function showWaiting(into: Element, said: string): void {
  fill(into, h("p", { className: "told" }, said), h("p", { className: "quiet", role: "status" }, "Looking …"));
}

export function showProblem(into: Element, problem: Problem, replies: { question: string; choice: string }[], acts: Acts): void {
  const needsKey = problem.code.startsWith("key_");
  const again = h("button", { type: "button", onclick: () => acts.ask() }, "Try again");
  if (problem.retryAfter && !needsKey) {
    again.disabled = true;
    let left = problem.retryAfter;
    const tick = () => {
      again.textContent = left > 0 ? `Try again in ${left} s` : "Try again";
      again.disabled = left > 0;
      if (left-- > 0 && again.isConnected) setTimeout(tick, 1000);
    };
    setTimeout(tick);
  }
  fill(
    into,
    h("div", { role: "alert" }, h("h2", { tabIndex: -1 }, problem.title), h("p", {}, problem.message)),
    needsKey ? keyForm(acts) : again,
    replies.length > 0 && repliesList(replies, acts),
    problem.requestId && h("p", { className: "small" }, `Request ${problem.requestId}`),
  );
}

function keyForm(acts: Acts): Element {
  const field = h("input", { type: "password", id: "key", autocomplete: "off", required: true });
  const submit = (event: Event) => {
    event.preventDefault();
    acts.unlock(field.value);
  };
  return h("form", { className: "row", onsubmit: submit }, h("label", { for: "key" }, "Key"), field, h("button", { className: "first" }, "Use it"));
}

function headline(answer: Answer, places: Place[], asked: Given, acts: Acts): Element {
  const { estimate, status } = answer;
  if (!estimate) {
    const [title, advice] = nothing(answer, asked.isInside);
    return h("div", {}, h("h2", { tabIndex: -1 }, title), h("p", {}, advice), question(answer, acts));
  }
  if (status === "ambiguous") {
    const fitting = places.filter((place) => place.fits).length;
    const held = places.reduce((sum, place) => sum + place.probability, 0);
    const few = fitting > 1 && held > 0.5 ? `${count(fitting)} places fit.` : "Many places fit.";
    return h("div", {}, h("h2", { tabIndex: -1 }, few), question(answer, acts), !answer.question && h("p", { className: "quiet" }, "Add one more thing you see."));
  }
  const here = places[0]?.probability ?? estimate.probability; // of the place; the service's is of a cell of 10 m
  const [street, ...beside] = (estimate.place ?? "here").split(", ");
  const spot = estimate.wgs84 ? `${estimate.wgs84.lat.toFixed(6)}, ${estimate.wgs84.lon.toFixed(6)}` : `${estimate.position[0].toFixed(1)}, ${estimate.position[1].toFixed(1)} m`;
  return h(
    "div",
    {},
    h("h2", { tabIndex: -1 }, sentence(street), estimate.place ? copy(estimate.place, "Copy the place") : null),
    beside.length > 0 && h("p", {}, beside.join(", ")),
    h("p", {}, `within ${metres(estimate.radius_m.p90)}, nine times out of ten`),
    h("p", { className: "quiet" }, `${percent(here)}: ${likely(here)}`, estimate.heading ? ` · you look ${wind(estimate.heading.mean_deg)}` : null),
    h("p", { className: "spot" }, spot, copy(spot, "Copy the coordinates")),
    question(answer, acts),
  );
}

/** Why there is no place, and what to do. */
function nothing(answer: Answer, isInside: boolean): [string, string] {
  if (answer.evidence.length) return ["Nothing of it was found on this map", "Is it the right map? Add one thing you see: a street's name, a shop, a colour."];
  if (isInside) return ["No place inside the area", "Move the area onto the map, or remove it."];
  return ["Nothing to go by", "Name things around you: a street, a shop, a tree to your north."];
}

function copy(text: string, label: string): Element {
  const button = h("button", { type: "button", className: "copy", "aria-label": label, title: label }, "Copy");
  button.addEventListener("click", async () => {
    await navigator.clipboard.writeText(text).then(() => (button.textContent = "Copied"), () => (button.textContent = "Not allowed"));
    setTimeout(() => (button.textContent = "Copy"), 1500);
  });
  return button;
}

function question(answer: Answer, acts: Acts): Element | null {
  const asked = answer.question;
  if (!asked) return null;
  return h(
    "div",
    { className: "question", role: "group", "aria-label": asked.text },
    h("p", {}, asked.text),
    h("div", { className: "row" }, ...asked.choices.map((choice) => h("button", { type: "button", onclick: () => acts.reply(asked.id, choice.value) }, choice.text))),
    asked.is_open && nameForm(asked.id, acts),
  );
}

/** A name that is not among those that are offered. */
function nameForm(id: string, acts: Acts): Element {
  const asked = id === "address" ? "Number and street" : "Another name";
  const field = h("input", { type: "text", autocomplete: "off", required: true, maxLength: 200, "aria-label": asked, placeholder: asked });
  const send = (event: Event) => {
    event.preventDefault();
    if (field.value.trim()) acts.reply(id, field.value.trim());
  };
  return h("form", { className: "row", onsubmit: send }, field, h("button", { type: "submit" }, "Send"));
}

/** The text, its mentions underlined by how well something explains them. */
function told(said: string, answer: Answer, acts: Acts): Element {
  const spans = answer.evidence
    .map((evidence, mention) => ({ evidence, mention, span: evidence.span }))
    .filter((row): row is typeof row & { span: [number, number] } => !!row.span && row.span[0] < row.span[1])
    .sort((a, b) => a.span[0] - b.span[0] || b.span[1] - a.span[1]);
  const element = h("p", { className: "told" });
  const letters = [...said]; // places count characters, not the halves of one
  let before = 0;
  for (const { evidence, mention, span } of spans) {
    if (span[0] < before) continue;
    const text = letters.slice(span[0], span[1]).join("");
    element.append(letters.slice(before, span[0]).join(""), mentionOf(text, evidence, mention, acts));
    before = span[1];
  }
  element.append(letters.slice(before).join(""));
  return element;
}

function mentionOf(text: string, evidence: Evidence, mention: number, acts: Acts): Element {
  return h(
    "button",
    {
      type: "button",
      className: `mention ${fitOf(evidence)} m${mention % 8}`,
      "data-mention": mention,
      "aria-label": evidence.fit,
      onclick: () => acts.visit(mention),
      onmouseenter: () => acts.light(mention),
      onmouseleave: () => acts.light(null),
      onfocus: () => acts.light(mention),
      onblur: () => acts.light(null),
    },
    text,
  );
}

function evidenceList(said: string, answer: Answer, acts: Acts): Element | null {
  const rows = answer.evidence.map((evidence, mention) => {
    const fit = fitOf(evidence);
    return h(
      "li",
      { className: fit, "data-evidence": mention, onmouseenter: () => acts.light(mention), onmouseleave: () => acts.light(null) },
      h("span", { className: `sign m${mention % 8}`, "aria-hidden": "true" }, SIGNS[fit]),
      h("span", {}, h("b", {}, evidence.text), (evidence.fit ?? "").slice(evidence.text.length)),
    );
  });
  return h("ul", { className: "evidence", "aria-label": "What was understood" }, ...rows, ...missed(said, answer));
}

/** The sentences in which nothing was understood. */
function missed(said: string, answer: Answer): Element[] {
  const spans = answer.evidence.flatMap((evidence) => (evidence.span ? [evidence.span] : []));
  const empty = sentences(said).filter(({ start, end }) => !spans.some(([from, to]) => from < end && to > start));
  return empty.map(({ text }) => h("li", { className: "none" }, h("span", { className: "sign", "aria-hidden": "true" }, "?"), h("span", {}, h("b", {}, `“${text}”`), " was not understood")));
}

/** What a question was about, of its id. */
function topic(id: string): string {
  const [kind, about] = id.split(":");
  return (about ?? kind).split("|")[0];
}

function repliesList(replies: { question: string; choice: string }[], acts: Acts): Element {
  return h("p", { className: "row small" }, "You answered:", ...replies.map(({ question: asked, choice }) => h("button", { type: "button", className: "chip", "aria-label": `Take back ${topic(asked)}: ${choice}`, onclick: () => acts.forget(asked) }, `${topic(asked)}: ${choice} ✕`)));
}

function others(answer: Answer, places: Place[], chosen: number, acts: Acts): Element | null {
  if (places.length < 2) return null;
  const rows = places.map((place, n) =>
    h(
      "li",
      {},
      h(
        "button",
        { type: "button", className: "place", "aria-pressed": n === chosen, onclick: () => acts.choose(n) },
        h("span", { className: "letter", "aria-hidden": "true" }, place.letter),
        placeName(place),
        h("span", { className: "share" }, percent(place.probability)),
      ),
      n > 0 && h("ul", { className: "fits" }, ...place.supports.map((fit) => fitRow("solid", fit)), ...place.contradicts.map((fit) => fitRow("none", fit))),
    ),
  );
  const elsewhere = 1 - places.reduce((sum, place) => sum + place.probability, 0);
  const rest = elsewhere > 0.005 ? h("li", { className: "small" }, `Elsewhere: ${percent(elsewhere)}`) : null;
  const list = h("ol", { className: "places" }, ...rows, rest);
  const amount = places.length === 2 ? "One other place" : `${count(places.length - 1)} other places`;
  return h("details", { className: "others", open: answer.status === "ambiguous" || chosen > 0 }, h("summary", {}, amount), list);
}

function placeName(place: Place): Element {
  const [street, ...beside] = (place.name ?? `Place ${place.letter}`).split(", ");
  return h("span", {}, sentence(street), beside.length > 0 && h("span", { className: "small" }, beside.join(", ")));
}

/** What speaks for a place, or against it. */
function fitRow(fit: Fit, text: string): Element {
  const about = { solid: "for it: ", weak: "", none: "against it: " }[fit];
  return h("li", { className: fit }, h("span", { className: "sign", "aria-hidden": "true" }, SIGNS[fit]), h("span", {}, h("span", { className: "heard" }, about), text));
}
