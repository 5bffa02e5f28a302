// The answer, as people read it: words first, then what was understood, then the other places.

import type { Answer, Evidence, Problem } from "./api";
import { fill, h } from "./dom";
import { count, direction, t } from "./language";
import type { Place } from "./places";
import { likely, metres, percent, sentence, sentences } from "./words";

export interface Acts {
  choose(place: number): void;
  light(mention: number | null): void;
  /** Flies to where a mention and the answer are both seen. */
  visit(mention: number): void;
  reply(question: string, choice: string): void;
  forget(question: string): void;
  ask(): void;
  unlock(key: string): void;
  /** Stores where it is: at the pin, or else at the chosen place. */
  correct(): void;
  movePin(): void;
  saveAnswer(): void;
}

export interface Reply {
  question: string;
  choice: string;
}

/** What was asked besides the text. */
export interface Given {
  replies: Reply[];
  isInside: boolean; // an area alone is looked at
  correction: Correction | null; // null if the service stores none
}

export interface Correction {
  hasPin: boolean;
  isPinning: boolean;
  isDone: boolean;
  message: string;
}

const MOST_MISSED = 3; // sentences that are listed; more wait until they are wanted
const FITS = 0.5; // as the service has it: from this probability on something explains what was said
const WEAK = 0.2;
const questions = new Map<string, NonNullable<Answer["question"]>>(); // that were shown, by id
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
    others(answer, places, chosen, asked.correction !== null, acts),
    actions(places, chosen, asked.correction, acts),
    ...answer.warnings.map((warning) => h("p", { className: "warning" }, sentence(warning))),
  );
}

export function showWaiting(into: Element, said: string): void {
  fill(into, h("p", { className: "told", dir: "auto" }, said), h("p", { className: "quiet", role: "status" }, t("looking")));
}

export function showProblem(into: Element, problem: Problem, replies: Reply[], acts: Acts): void {
  const needsKey = problem.code.startsWith("key_");
  const again = h("button", { type: "button", onclick: () => acts.ask() }, t("tryAgain"));
  if (problem.retryAfter && !needsKey) {
    again.disabled = true;
    let left = problem.retryAfter;
    const tick = () => {
      again.textContent = left > 0 ? t("tryAgainIn", { seconds: left }) : t("tryAgain");
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
    problem.requestId && h("p", { className: "small" }, t("request", { id: problem.requestId })),
  );
}

function keyForm(acts: Acts): Element {
  const field = h("input", { type: "password", id: "key", autocomplete: "off", required: true });
  const submit = (event: Event) => {
    event.preventDefault();
    acts.unlock(field.value);
  };
  return h("form", { className: "row", onsubmit: submit }, h("label", { for: "key" }, t("key")), field, h("button", { className: "first" }, t("useKey")));
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
    const few = fitting > 1 && held > 0.5 ? sentence(t("placesFit", { count: count(fitting) })) : t("manyPlacesFit");
    return h("div", {}, h("h2", { tabIndex: -1 }, few), question(answer, acts), !answer.question && h("p", { className: "quiet" }, t("addOneThing")));
  }
  const here = places[0]?.probability ?? estimate.probability; // of the place; the service's is of a cell of 10 m
  const [street, ...beside] = (estimate.place ?? t("here")).split(", ");
  const spot = estimate.wgs84 ? `${estimate.wgs84.lat.toFixed(6)}, ${estimate.wgs84.lon.toFixed(6)}` : `${estimate.position[0].toFixed(1)}, ${estimate.position[1].toFixed(1)} m`;
  return h(
    "div",
    {},
    h("h2", { tabIndex: -1 }, h("span", {}, sentence(street)), estimate.place ? copy(estimate.place, t("copyPlace")) : null),
    beside.length > 0 && h("p", {}, beside.join(", ")),
    h("p", {}, t("within", { distance: metres(estimate.radius_m.p90) })),
    h("p", { className: "quiet" }, `${percent(here)}: ${likely(here)}`, estimate.heading ? ` · ${t("facing", { direction: direction(estimate.heading.mean_deg) })}` : null),
    h("p", { className: "spot" }, spot, copy(spot, t("copyCoordinates"))),
    question(answer, acts),
  );
}

/** Why there is no place, and what to do. */
function nothing(answer: Answer, isInside: boolean): [string, string] {
  if (answer.evidence.length) return [t("notOnMap"), t("notOnMapAdvice")];
  if (isInside) return [t("emptyArea"), t("emptyAreaAdvice")];
  return [t("nothingToGoBy"), t("nothingToGoByAdvice")];
}

function copy(text: string, label: string): Element {
  const button = h("button", { type: "button", className: "copy", "aria-label": label, title: label }, t("copy"));
  button.addEventListener("click", async () => {
    await navigator.clipboard.writeText(text).then(() => (button.textContent = t("copied")), () => (button.textContent = t("copyRefused")));
    setTimeout(() => (button.textContent = t("copy")), 1500);
  });
  return button;
}

function question(answer: Answer, acts: Acts): Element | null {
  const asked = answer.question;
  if (!asked) return null;
  questions.set(asked.id, asked);
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
  const asked = id === "address" ? t("addressField") : t("nameField");
  const field = h("input", { type: "text", autocomplete: "off", required: true, maxLength: 200, "aria-label": asked, placeholder: asked });
  const send = (event: Event) => {
    event.preventDefault();
    if (field.value.trim()) acts.reply(id, field.value.trim());
  };
  return h("form", { className: "row", onsubmit: send }, field, h("button", { type: "submit" }, t("send")));
}

/** The text, its mentions underlined by how well something explains them. */
function told(said: string, answer: Answer, acts: Acts): Element {
  const spans = answer.evidence
    .map((evidence, mention) => ({ evidence, mention, span: evidence.span }))
    .filter((row): row is typeof row & { span: [number, number] } => !!row.span && row.span[0] < row.span[1])
    .sort((a, b) => a.span[0] - b.span[0] || b.span[1] - a.span[1]);
  const element = h("p", { className: "told", dir: "auto" });
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
      h("span", {}, h("b", {}, evidence.text), fitText(evidence)),
    );
  });
  return h("ul", { className: "evidence", "aria-label": t("understood") }, ...rows, ...missed(said, answer));
}

/** What the fit of a mention says after its text. */
function fitText({ text, fit }: Evidence): string {
  if (!fit) return "";
  return fit.startsWith(text) ? fit.slice(text.length) : `: ${fit}`;
}

/** The sentences in which nothing was understood. */
function missed(said: string, answer: Answer): Element[] {
  const spans = answer.evidence.flatMap((evidence) => (evidence.span ? [evidence.span] : []));
  const empty = sentences(said).filter(({ start, end }) => !spans.some(([from, to]) => from < end && to > start));
  const rows = empty.map(({ text }) => h("li", { className: "none" }, h("span", { className: "sign", "aria-hidden": "true" }, "?"), h("span", {}, h("b", {}, `“${text}”`), ` ${t("notUnderstood")}`)));
  if (rows.length <= MOST_MISSED) return rows;
  return [h("li", {}, h("details", {}, h("summary", {}, t("manyNotUnderstood", { count: rows.length })), h("ul", { className: "evidence" }, ...rows)))];
}

/** A reply in words: those of the question and the choice if they were shown, else those in the address. */
function replyText({ question, choice }: Reply): string {
  const shown = questions.get(question);
  const [kind, about] = question.split(":");
  const topic = shown?.text ?? `${(about ?? kind).split("|")[0]}:`;
  return `${topic} ${shown?.choices.find(({ value }) => value === choice)?.text ?? choice}`;
}

function repliesList(replies: Reply[], acts: Acts): Element {
  const chips = replies.map((reply) => h("button", { type: "button", className: "chip", "aria-label": t("takeBack", { reply: replyText(reply) }), onclick: () => acts.forget(reply.question) }, `${replyText(reply)} ✕`));
  return h("p", { className: "row small" }, t("youAnswered"), ...chips);
}

function others(answer: Answer, places: Place[], chosen: number, isCorrected: boolean, acts: Acts): Element | null {
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
  const rest = elsewhere > 0.005 ? h("li", { className: "small" }, t("elsewhere", { share: percent(elsewhere) })) : null;
  const list = h("ol", { className: "places" }, ...rows, rest);
  const amount = places.length === 2 ? t("otherPlace") : sentence(t("otherPlaces", { count: count(places.length - 1) }));
  return h("details", { className: "others", open: answer.status === "ambiguous" || chosen > 0 || isCorrected }, h("summary", {}, amount), list);
}

/** What an operator does with an answer. */
function actions(places: Place[], chosen: number, correction: Correction | null, acts: Acts): Element {
  const here = correction?.hasPin ? t("itIsAtPin") : places.length > 1 ? t("itIsAt", { letter: places[chosen].letter }) : t("itIsHere");
  const canCorrect = correction && (correction.hasPin || places.length > 0);
  return h(
    "div",
    { className: "actions" },
    h(
      "div",
      { className: "row" },
      canCorrect && h("button", { type: "button", id: "correct", disabled: correction.isDone, onclick: () => acts.correct() }, here),
      correction && h("button", { type: "button", id: "move-pin", "aria-pressed": correction.isPinning, onclick: () => acts.movePin() }, t("movePin")),
      h("button", { type: "button", id: "save", onclick: () => acts.saveAnswer() }, t("saveAnswer")),
    ),
    correction && h("p", { className: "small", role: "status" }, correction.isPinning ? t("hintCorrect") : correction.message),
  );
}

function placeName(place: Place): Element {
  const [street, ...beside] = (place.name ?? t("place", { letter: place.letter })).split(", ");
  return h("span", {}, sentence(street), beside.length > 0 && h("span", { className: "small" }, beside.join(", ")));
}

/** What speaks for a place, or against it. */
function fitRow(fit: Fit, text: string): Element {
  const about = { solid: t("supports"), weak: "", none: t("contradicts") }[fit];
  return h("li", { className: fit }, h("span", { className: "sign", "aria-hidden": "true" }, SIGNS[fit]), h("span", {}, h("span", { className: "heard" }, about), text));
}
