// A report of an evaluation: recalls in a table, the curve of errors, and where the errors are.

import { fill, h } from "./dom";
import { decimal, t } from "./language";
import { metres } from "./words";

/** A query of an evaluation; `estimate` and `error_m` are null where nothing was found. */
export interface Measurement {
  truth: [number, number];
  estimate: [number, number] | null;
  error_m: number | null;
}

/** What the page reads of `report.json`. */
export interface Report {
  data: string;
  split: string;
  model: string;
  method: string;
  queries: number;
  cells: number;
  retrieval: Record<string, number>;
  localization: Record<string, Record<string, number>>;
  places?: { truth: [number, number][]; estimate: ([number, number] | null)[] };
}

const SVG = "http://www.w3.org/2000/svg";
const LONGEST = 100; // metres, where the curve of errors ends
const [WIDE, HIGH, LEFT, FOOT] = [320, 150, 42, 22];

/** A report that was saved, checked as far as the page needs it. */
export function readReport(text: string): Report {
  let report: Report;
  try {
    report = JSON.parse(text);
  } catch {
    throw new Error(t("fileNotJson"));
  }
  if (!report || typeof report !== "object" || typeof report.retrieval !== "object" || typeof report.localization !== "object") {
    throw new Error(t("fileNoReport"));
  }
  return report;
}

export function measurementsOf(report: Report): Measurement[] {
  const { truth, estimate } = report.places ?? { truth: [], estimate: [] };
  return truth.map((at, n) => {
    const found = estimate[n];
    return { truth: at, estimate: found, error_m: found && Math.hypot(at[0] - found[0], at[1] - found[1]) };
  });
}

export function showReport(into: Element, report: Report, map: { shown: boolean; toggle: (shown: boolean) => void } | null): void {
  const errors = measurementsOf(report).map((each) => each.error_m ?? Infinity).sort((a, b) => a - b);
  const toggle = map && h("input", { type: "checkbox", checked: map.shown, onchange: (event: Event) => map.toggle((event.target as HTMLInputElement).checked) });
  fill(
    into,
    h("h3", {}, `${report.data}, ${report.split}`),
    h("p", { className: "small" }, t("reportSize", { queries: report.queries, cells: report.cells, model: report.model, method: report.method })),
    table(report),
    errors.length > 0 && curve(errors),
    errors.length > 0 && h("p", { className: "small" }, t("reportErrors", { half: far(errors, 0.5), most: far(errors, 0.9) })),
    toggle && h("label", { className: "check" }, toggle, t("errorsOnMap")),
    map && h("p", { className: "small legend" }, h("span", { className: "m2" }, `● ${t("within5")} `), h("span", { className: "m4" }, `● ${t("from5To15")} `), h("span", { className: "far" }, `■ ${t("over15")}`)),
  );
}

function far(errors: number[], share: number): string {
  const error = errors[Math.min(errors.length - 1, Math.ceil(share * errors.length) - 1)];
  return Number.isFinite(error) ? metres(error) : t("noDistance");
}

function table(report: Report): Element {
  const [ranks, radii] = [Object.keys(report.localization), Object.keys(Object.values(report.localization)[0] ?? {})];
  const head = h("tr", {}, h("td", {}), ...radii.map((radius) => h("th", { scope: "col" }, `${radius} m`)));
  const rows = ranks.map((rank) => h("tr", {}, h("th", { scope: "row" }, `k = ${rank}`), ...radii.map((radius) => h("td", {}, share(report.localization[rank][radius])))));
  const cells = Object.entries(report.retrieval).map(([rank, value]) => `R@${rank} ${share(value)}`);
  return h("div", {}, h("table", {}, h("caption", {}, t("recallTable")), h("thead", {}, head), h("tbody", {}, ...rows)), h("p", { className: "small" }, t("cellRecall", { recalls: cells.join(", ") })));
}

function share(value: number): string {
  return decimal(value, 3);
}

/** How many are within how many metres. */
function curve(errors: number[]): Element {
  const x = (error: number) => LEFT + ((WIDE - LEFT - 8) * error) / LONGEST;
  const y = (part: number) => HIGH - FOOT - (HIGH - FOOT - 8) * part;
  const points = [`${x(0)},${y(0)}`];
  errors.forEach((error, n) => {
    if (error > LONGEST) return;
    points.push(`${x(error)},${y(n / errors.length)}`, `${x(error)},${y((n + 1) / errors.length)}`);
  });
  points.push(`${x(LONGEST)},${y(errors.filter((error) => error <= LONGEST).length / errors.length)}`);
  const svg = draw("svg", { viewBox: `0 0 ${WIDE} ${HIGH}`, class: "curve", role: "img", "aria-label": t("errorCurve") });
  for (const part of [0, 0.5, 1]) {
    svg.append(draw("line", { x1: LEFT, x2: WIDE - 8, y1: y(part), y2: y(part), class: "grid" }), text(LEFT - 6, y(part) + 4, `${100 * part} %`, "end"));
  }
  for (const error of [0, 25, 50, 75, 100]) svg.append(text(x(error), HIGH - 5, `${error} m`, error === 100 ? "end" : "middle"));
  svg.append(draw("polyline", { points: points.join(" "), class: "line" }));
  return svg as unknown as Element;
}

function draw(tag: string, attributes: Record<string, string | number>): SVGElement {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  return element;
}

function text(x: number, y: number, said: string, anchor: string): SVGElement {
  const element = draw("text", { x, y, "text-anchor": anchor });
  element.textContent = said;
  return element;
}
